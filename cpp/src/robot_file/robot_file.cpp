#include "cdcr/robot_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <stdexcept>

#include "base/arguments.hpp"
#include "robot_file/fields.hpp"
#include "robot_file/values.hpp"

namespace cdcr {
namespace {

using robot_file::Field;
using robot_file::Refusal;
using robot_file::shown;

constexpr double degree = 3.14159265358979323846 / 180.0;

template <typename T>
Refusal take_field(const toml::node& node, double unit, const Field<T>& field, T& thing) {
  return std::visit([&](auto member) { return robot_file::take(node, unit, thing.*member); },
                    field.member);
}

Refusal read(const toml::node& node, double unit, const Field<Section>& field, Section& section) {
  const std::string name = field.name;
  if (name == "backbone_diameter") {
    return robot_file::take_taper(node, section.backbone_diameter, section.backbone_tip_diameter);
  }
  const std::string end = "_order";
  if (name.size() > end.size() && name.substr(name.size() - end.size()) == end) {
    return robot_file::take_order(node, section.*std::get<int Section::*>(field.member));
  }
  return take_field(node, unit, field, section);
}

Refusal read(const toml::node& node, double unit, const Field<Cable>& field, Cable& cable) {
  const std::string name = field.name;
  if (name == "radius") return robot_file::take_route(node, unit, cable.radius, cable.radii);
  if (name == "angle") return robot_file::take_route(node, unit, cable.angle, cable.angles);
  if (name == "end_section" || name == "start_section") {
    return robot_file::take_section(node, cable.*std::get<int Cable::*>(field.member));
  }
  return take_field(node, unit, field, cable);
}

Refusal read(const toml::node& node, double unit, const Field<Robot>& field, Robot& robot) {
  return take_field(node, unit, field, robot);
}

bool is_angle(const std::string& requirement) {
  return requirement.find("[rad]") != std::string::npos;
}

std::string in_degrees(std::string requirement) {
  return requirement.replace(requirement.find("[rad]"), 5, "[deg]");
}

/// Sentences about a file, in the words of python/cdcr/robot/schema.py.
class Sentences {
 public:
  explicit Sentences(std::string where) : where_(std::move(where)) {}

  void add(const std::string& sentence, const toml::node* node = nullptr) {
    const toml::source_index line = node != nullptr ? node->source().begin.line : 0;
    text_ += text_.empty() ? "" : "\n";
    text_ += where_ + (line > 0 ? ", line " + std::to_string(line) : "") + ": " + sentence;
  }
  void must_be(const std::string& what, const std::string& requirement, const toml::node& got) {
    add(what + " must be " + requirement + ", got " + shown(got), &got);
  }
  /// Throws what there is.
  void refuse() const {
    if (!text_.empty()) throw std::invalid_argument(text_);
  }

 private:
  std::string where_, text_;
};

/// A key whose value is tables, which others read, and its place among the known ones.
struct TablesKey {
  std::ptrdiff_t place;
  const char* name;
};

/// Reads the fields that a table has; `in` is "section 1" or nothing.
template <typename T>
class TableReader {
 public:
  TableReader(const toml::table& table, std::string in, const std::vector<Field<T>>& fields,
              Sentences& sentences)
      : table_(table), in_(std::move(in)), fields_(fields), sentences_(sentences) {}

  void read_into(T& thing, std::initializer_list<TablesKey> tables = {}) {
    for (const Field<T>& field : fields_) {
      if (field.requirement != nullptr) read_field(field, thing);
    }
    for (const TablesKey& key : tables) known_.insert(known_.begin() + key.place, key.name);
    // toml++ sorts keys; people read from above.
    std::vector<const toml::key*> unknown;
    for (const auto& [key, value] : table_) {
      if (std::find(known_.begin(), known_.end(), key.str()) == known_.end()) {
        unknown.push_back(&key);
      }
    }
    std::sort(unknown.begin(), unknown.end(), [](const toml::key* a, const toml::key* b) {
      return a->source().begin < b->source().begin;
    });
    for (const toml::key* key : unknown) refuse_key(*key);
  }

 private:
  void read_field(const Field<T>& field, T& thing) {
    const std::string name = field.name, degrees = name + "_deg", requirement = field.requirement;
    const bool angle = is_angle(requirement);
    known_.push_back(name);
    const toml::node* node = table_.get(name);
    if (node != nullptr) read_value(name, *node, 1.0, requirement, field, thing);
    const toml::node* twin = angle ? table_.get(degrees) : nullptr;
    if (angle) known_.push_back(degrees);
    if (twin != nullptr) read_value(degrees, *twin, degree, in_degrees(requirement), field, thing);
    if (node != nullptr && twin != nullptr) {
      sentences_.add(in_ + " must have " + name + " or " + degrees + ", not both", twin);
    }
    if (!field.required || node != nullptr || twin != nullptr) return;
    if (angle) {
      sentences_.add(in_ + " must have " + name + " [rad] or " + degrees + " [deg]", &table_);
    } else {
      sentences_.add(path(name) + " is missing; it must be " + requirement, &table_);
    }
  }

  void read_value(const std::string& name, const toml::node& node, double unit,
                  const std::string& requirement, const Field<T>& field, T& thing) {
    const Refusal wrong = read(node, unit, field, thing);
    if (!wrong) return;
    const std::string place = wrong->place.empty() ? "" : " at " + name + wrong->place;
    sentences_.add(path(name) + " must be " + requirement + ", got " + shown(*wrong->node) + place,
                   wrong->node);
  }

  void refuse_key(const toml::key& key) {
    std::string all;
    for (const std::string& one : known_) all += (all.empty() ? "" : ", ") + one;
    sentences_.add(path(std::string(key.str())) + " is not a known key. Known keys: " + all,
                   table_.get(key.str()));
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return in_.empty() ? name : in_ + ": " + name;
  }

  const toml::table& table_;
  std::string in_;
  const std::vector<Field<T>>& fields_;
  Sentences& sentences_;
  std::vector<std::string> known_;
};

/// The tables [[name]] of a robot; null where there are none.
const toml::array* tables_of(const toml::table& table, const std::string& name,
                             const std::string& one, Sentences& sentences) {
  const toml::node* node = table.get(name);
  if (node == nullptr) return nullptr;
  if (!node->is_array()) {
    sentences.must_be(name, "one [[" + name + "]] table for each " + one, *node);
  }
  return node->as_array();
}

template <typename T>
void read_tables(const toml::array* tables, const std::vector<Field<T>>& fields,
                 const std::string& before, const std::string& after, std::vector<T>& things,
                 Sentences& sentences) {
  if (tables == nullptr) return;
  for (const toml::node& node : *tables) {
    const std::string in = detail::sentence(before, things.size() + 1, after);
    T& thing = things.emplace_back();
    if (const toml::table* table = node.as_table()) {
      TableReader<T>(*table, in, fields, sentences).read_into(thing);
    } else {
      sentences.must_be(in, "a table", node);
    }
  }
}

/// What a cable's sections must be beside numbers from 1.
void check_ends(const toml::array& tables, const Robot& robot, Sentences& sentences) {
  const auto num_sections = static_cast<int>(robot.sections.size());
  for (std::size_t j = 0; j < robot.cables.size(); ++j) {
    const Cable& cable = robot.cables[j];
    const toml::table& table = *tables.get_as<toml::table>(j);
    const std::string in = "cable " + std::to_string(j + 1) + " of cables: ";
    if (cable.end_section >= num_sections) {
      sentences.must_be(in + "end_section",
                        "the number of a section, 1 to " + std::to_string(num_sections),
                        *table.get("end_section"));
    } else if (cable.start_section > cable.end_section) {
      const toml::node& start = *table.get("start_section");
      sentences.add(in + "start_section must be at most end_section, " +
                        std::to_string(cable.end_section + 1) + ", got " +
                        std::to_string(cable.start_section + 1),
                    &start);
    }
  }
}

Robot read_robot(const toml::table& table, const std::string& where) {
  Robot robot;
  Sentences about_robot(where);
  if (!table.contains("sections")) {
    about_robot.add("sections is missing; it must be one [[sections]] table for each section");
  }
  const toml::array* sections = tables_of(table, "sections", "section", about_robot);
  const toml::array* cables = tables_of(table, "cables", "cable", about_robot);
  TableReader<Robot>(table, "", robot_file::robot_fields(), about_robot)
      .read_into(robot, {{0, "sections"}, {3, "cables"}});
  about_robot.refuse();

  Sentences about_parts(where);
  read_tables(sections, robot_file::section_fields(), "section ", "", robot.sections, about_parts);
  read_tables(cables, robot_file::cable_fields(), "cable ", " of cables", robot.cables,
              about_parts);
  about_parts.refuse();
  if (cables != nullptr) check_ends(*cables, robot, about_parts);
  about_parts.refuse();

  Sentences about_ranges(where);
  for (const std::string& sentence : violations(robot)) about_ranges.add(sentence);
  about_ranges.refuse();
  for (Section& section : robot.sections) {
    if (!section.disk_positions.empty()) {
      section.num_disks = static_cast<int>(section.disk_positions.size());
    }
  }
  return robot;
}

}  // namespace

Robot robot_from_toml(std::string_view text, const std::string& where) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    const toml::source_position place = error.source().begin;
    throw std::invalid_argument(where + ", line " + std::to_string(place.line) + ", column " +
                                std::to_string(place.column) + ": " +
                                std::string(error.description()));
  }
  if (!table.contains("sections") && (table.contains("robot") || table.contains("t_end"))) {
    throw std::invalid_argument(where + " is a scenario file: `cdcr run` and `cdcr view` take it");
  }
  return read_robot(table, where);
}

Robot load_robot(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) {
    throw std::invalid_argument(path + ": there is no such file, or it cannot be read");
  }
  return robot_from_toml(text, path);
}

}  // namespace cdcr
