// Robot files read in C++ and in Python give the same robots and the same refusals: the folder
// tests/data/robot_files holds what Python says, tests/python/test_robot_file_core.py holds Python
// to it.
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "cdcr/dynamics.hpp"
#include "cdcr/robot_file.hpp"
#include "robot_file/fields.hpp"
#include "robot_file/toml.hpp"
#include "setup_file.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

const std::string folder = CDCR_TEST_DATA "/robot_files/";

template <typename T>
bool same_fields(const std::vector<robot_file::Field<T>>& fields, const T& a, const T& b) {
  bool same = true;
  for (const robot_file::Field<T>& field : fields) {
    std::visit(
        [&](auto member) {
          INFO(field.name);
          const bool equal = a.*member == b.*member;
          CHECK(equal);
          same = same && equal;
        },
        field.member);
  }
  return same;
}

/// Accelerations at some state, or of a robot without mass the force on it.
VectorXd motion(const Robot& robot) {
  const Model model(robot);
  Data data(model);
  const Index d = model.num_coordinates();
  const VectorXd q = VectorXd::LinSpaced(d, 0.02, 0.03), qd = VectorXd::LinSpaced(d, -0.4, 0.5);
  VectorXd tension = VectorXd::Constant(model.num_cables(), 2.0);
  for (Index j = 0; j < tension.size(); ++j) {
    if (model.cables()[static_cast<std::size_t>(j)].length_driven()) tension[j] = 0.1;
  }
  VectorXd found(d);
  if (model.has_inertia()) {
    forward_dynamics(model, data, q, qd, tension, found);
  } else {
    inverse_dynamics(model, data, q, qd, qd, found);
  }
  return found;
}

/// Without the lines of the file, which Python finds in another way.
std::string without_lines(const std::string& text) {
  std::string found = text;
  for (std::size_t at = 0; (at = found.find(", line ", at)) != std::string::npos;) {
    found.erase(at, found.find(':', at) - at);
  }
  return found;
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(robot_from_toml(text, "robot.toml"));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST_SUITE_BEGIN("robot_file");

TEST_CASE("a robot is the one that Python reads, to the last bit of its accelerations") {
  for (const std::string name : {"amouri2020", "rao2021", "three_sections", "rods", "every_key"}) {
    CAPTURE(name);
    const Robot read = load_robot(folder + name + ".toml");
    const Robot given = fmu::read_setup(folder + name + ".fields").robot;
    CHECK(same_fields(robot_file::robot_fields(), read, given));
    REQUIRE(read.sections.size() == given.sections.size());
    for (std::size_t i = 0; i < read.sections.size(); ++i) {
      CHECK(same_fields(robot_file::section_fields(), read.sections[i], given.sections[i]));
    }
    REQUIRE(read.cables.size() == given.cables.size());
    for (std::size_t j = 0; j < read.cables.size(); ++j) {
      CHECK(same_fields(robot_file::cable_fields(), read.cables[j], given.cables[j]));
    }
    const VectorXd found = motion(read);
    CHECK(found.allFinite());
    CHECK((found.array() == motion(given).array()).all());
  }
}

TEST_CASE("what Python refuses is refused in its words") {
  const toml::table file = toml::parse_file(folder + "refused.toml");
  const auto base = file["base"].value<std::string>();
  REQUIRE(base);
  REQUIRE(static_cast<bool>(robot_from_toml(*base).sections.size()));
  std::size_t count = 0;
  for (const toml::node& node : *file["refused"].as_array()) {
    const toml::table& one = *node.as_table();
    const std::string old = *one["old"].value<std::string>();
    std::string text = *base, wanted;
    text.replace(text.find(old), old.size(), *one["new"].value<std::string>());
    for (const toml::node& sentence : *one["sentences"].as_array()) {
      wanted += (wanted.empty() ? "" : "\n") + ("robot.toml: " + *sentence.value<std::string>());
    }
    CHECK(without_lines(refusal(text)) == wanted);
    ++count;
  }
  CHECK(count > 30);
}

TEST_CASE("a refusal names the line of the key, and of what is no TOML") {
  const std::string section =
      "[[sections]]\nlength = 'long'\nbackbone_mass = 0.1\nbackbone_diameter = 0.01\n"
      "youngs_modulus = 1e9\n";
  CHECK_THROWS_SENTENCE(robot_from_toml(section),
                        "robot, line 2: section 1: length must be a number > 0 m and finite, got "
                        "'long' (string)");
  const std::string broken = refusal("payload = 1\n[[sections]\n");
  CHECK(broken.rfind("robot.toml, line 2, column ", 0) == 0);
  // What toml++ itself believes cannot be.
  for (const char* odd : {"[.", "payload = 0.\xD0\xA4\n"}) {
    CHECK(refusal(odd).rfind("robot.toml, line 1, column ", 0) == 0);
  }
  CHECK_THROWS_SENTENCE(
      load_robot(folder + "none.toml"),
      (folder + "none.toml: there is no such file, or it cannot be read").c_str());
  CHECK_THROWS_SENTENCE(robot_from_toml("t_end = 1.0"),
                        "robot is a scenario file: `cdcr run` and `cdcr view` take it");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
