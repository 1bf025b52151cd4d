#include "setup_file.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <variant>
#include <vector>

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
using Member = std::variant<double T::*, int T::*, std::optional<double> T::*,
                            std::optional<int> T::*, std::vector<double> T::*,
                            std::array<double, 2> T::*, std::vector<std::array<double, 2>> T::*,
                            Vector3d T::*, Matrix3d T::*, Transform T::*>;
template <typename T>
using Fields = std::map<std::string, Member<T>>;

const Fields<Section>& section_fields() {
  static const Fields<Section> fields = {
      {"length", &Section::length},
      {"backbone_mass", &Section::backbone_mass},
      {"backbone_diameter", &Section::backbone_diameter},
      {"youngs_modulus", &Section::youngs_modulus},
      {"disk_mass", &Section::disk_mass},
      {"disk_diameter", &Section::disk_diameter},
      {"num_disks", &Section::num_disks},
      {"disk_positions", &Section::disk_positions},
      {"disk_masses", &Section::disk_masses},
      {"disk_diameters", &Section::disk_diameters},
      {"cable_radius", &Section::cable_radius},
      {"cable_angles", &Section::cable_angles},
      {"cable_stiffness", &Section::cable_stiffness},
      {"cable_damping", &Section::cable_damping},
      {"cable_friction", &Section::cable_friction},
      {"cable_entry_friction", &Section::cable_entry_friction},
      {"cable_sheath_friction", &Section::cable_sheath_friction},
      {"cable_viscosity", &Section::cable_viscosity},
      {"cable_pretension", &Section::cable_pretension},
      {"cable_backlash", &Section::cable_backlash},
      {"damping", &Section::damping},
      {"bending_order", &Section::bending_order},
      {"twist_order", &Section::twist_order},
      {"stretch_order", &Section::stretch_order},
      {"backbone_tip_diameter", &Section::backbone_tip_diameter},
      {"backbone_inner_diameter", &Section::backbone_inner_diameter},
      {"shear_modulus", &Section::shear_modulus},
      {"bending_stiffness", &Section::bending_stiffness},
      {"twist_stiffness", &Section::twist_stiffness},
      {"stretch_stiffness", &Section::stretch_stiffness},
      {"twist_damping", &Section::twist_damping},
      {"stretch_damping", &Section::stretch_damping},
      {"material_damping", &Section::material_damping},
      {"rest_bending", &Section::rest_bending},
      {"rest_twist", &Section::rest_twist},
      {"nodes", &Section::nodes},
  };
  return fields;
}

const Fields<Cable>& cable_fields() {
  static const Fields<Cable> fields = {
      {"radius", &Cable::radius},
      {"angle", &Cable::angle},
      {"end_section", &Cable::end_section},
      {"stiffness", &Cable::stiffness},
      {"damping", &Cable::damping},
      {"friction", &Cable::friction},
      {"entry_friction", &Cable::entry_friction},
      {"sheath_friction", &Cable::sheath_friction},
      {"viscosity", &Cable::viscosity},
      {"pretension", &Cable::pretension},
      {"backlash", &Cable::backlash},
      {"radii", &Cable::radii},
      {"angles", &Cable::angles},
      {"start_section", &Cable::start_section},
  };
  return fields;
}

const Fields<Robot>& robot_fields() {
  static const Fields<Robot> fields = {
      {"gravity", &Robot::gravity},
      {"payload", &Robot::payload},
      {"base_orientation", &Robot::base_orientation},
      {"base_position", &Robot::base_position},
      {"payload_position", &Robot::payload_position},
      {"payload_inertia", &Robot::payload_inertia},
      {"sliding_speed", &Robot::sliding_speed},
      {"tool", &Robot::tool},
      {"presliding_stiffness", &Robot::presliding_stiffness},
  };
  return fields;
}

template <typename T>
bool read_field(const Fields<T>& fields, const std::string& key, const Values& values, T& thing) {
  const auto found = fields.find(key);
  if (found == fields.end()) return false;
  std::visit([&](auto member) { put(values, thing.*member); }, found->second);
  return true;
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
      block == "section" ? read_field(section_fields(), key, values, robot.sections.back())
      : block == "cable" ? read_field(cable_fields(), key, values, robot.cables.back())
                         : read_field(robot_fields(), key, values, robot);
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
