#include "setup_file.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <variant>
#include <vector>

#include "robot_file/fields.hpp"

namespace cdcr::fmu {
namespace {

using Values = std::vector<double>;

void need(const Values& values, std::size_t count) {
  if (values.size() != count) {
    throw std::invalid_argument(std::to_string(count) + " number(s) are needed there");
  }
}
void put(const Values& values, double& item) {
  need(values, 1);
  item = values[0];
}
void put(const Values& values, int& item) {
  need(values, 1);
  item = static_cast<int>(values[0]);
}
void put(const Values& values, std::optional<double>& item) {
  if (values.empty()) return;
  need(values, 1);
  item = values[0];
}
void put(const Values& values, std::optional<int>& item) {
  if (values.empty()) return;
  need(values, 1);
  item = static_cast<int>(values[0]);
}
void put(const Values& values, std::vector<double>& item) {
  item = values;
}
void put(const Values& values, std::array<double, 2>& item) {
  need(values, 2);
  item = {values[0], values[1]};
}
void put(const Values& values, std::vector<std::array<double, 2>>& item) {
  if (values.size() % 2 != 0) throw std::invalid_argument("pairs of numbers are needed there");
  item.clear();
  for (std::size_t k = 0; k < values.size(); k += 2) item.push_back({values[k], values[k + 1]});
}
void put(const Values& values, Vector3d& item) {
  need(values, 3);
  item = Eigen::Map<const Vector3d>(values.data());
}
template <int n, int options>
void put(const Values& values, Eigen::Matrix<double, n, n, options>& item) {  // by rows
  need(values, static_cast<std::size_t>(item.size()));
  item = Eigen::Map<const Eigen::Matrix<double, n, n>>(values.data()).transpose();
}

template <typename T>
bool read_field(const std::vector<robot_file::Field<T>>& fields, const std::string& key,
                const Values& values, T& thing) {
  for (const robot_file::Field<T>& field : fields) {
    if (field.name != key) continue;
    std::visit([&](auto member) { put(values, thing.*member); }, field.member);
    return true;
  }
  return false;
}

/// Numbers are written as 0x1ap-4: exact, and without a point, which not every locale has.
Values numbers(std::istream& words) {
  Values values;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    values.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0') throw std::invalid_argument("'" + word + "' is no number");
  }
  return values;
}

void read_line(const std::string& line, std::string& block, Setup& setup) {
  std::istringstream words(line);
  std::string key;
  words >> key;
  Robot& robot = setup.robot;
  if (key == "token") {
    words >> setup.token;
    return;
  }
  if (key == "section" || key == "cable") {
    block = key;
    if (key == "section") robot.sections.emplace_back();
    if (key == "cable") robot.cables.emplace_back();
    return;
  }
  const Values values = numbers(words);
  if (block.empty() && key == "rk4_step") {
    setup.method = Method::rk4;
    put(values, setup.options.step);
    return;
  }
  const bool known =
      block == "section"
          ? read_field(robot_file::section_fields(), key, values, robot.sections.back())
      : block == "cable" ? read_field(robot_file::cable_fields(), key, values, robot.cables.back())
                         : read_field(robot_file::robot_fields(), key, values, robot);
  if (!known) throw std::invalid_argument("this version of cdcr knows no such key");
}

}  // namespace

Setup read_setup(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(path + ": there is no such file, or it cannot be read");
  Setup setup;
  std::string line, block;
  for (int number = 1; std::getline(file, line); ++number) {
    try {
      read_line(line, block, setup);
    } catch (const std::invalid_argument& error) {
      std::ostringstream sentence;
      sentence << path << ", line " << number << ": '" << line << "': " << error.what();
      throw std::invalid_argument(sentence.str());
    }
  }
  return setup;
}

}  // namespace cdcr::fmu
