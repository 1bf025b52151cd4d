#include "robot_file/values.hpp"

#include <charconv>
#include <cmath>

namespace cdcr::robot_file {
namespace {

std::string kind(const toml::node& node) {
  if (node.is_table()) return "table";
  if (node.is_array()) return "array";
  if (node.is_string()) return "string";
  if (node.is_integer()) return "integer";
  if (node.is_floating_point()) return "float";
  if (node.is_boolean()) return "boolean";
  return "date or time";
}

std::string number_text(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number < 0.0 ? "-inf" : "inf";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  std::string found(text.data(), end);
  return found.find_first_of(".e") == std::string::npos ? found + ".0" : found;
}

std::string text(const toml::node& node) {
  if (const auto* array = node.as_array()) {
    std::string all;
    for (const toml::node& one : *array) all += (all.empty() ? "" : ", ") + text(one);
    return "[" + all + "]";
  }
  if (const auto* table = node.as_table()) {
    std::string all;
    for (const auto& [key, one] : *table) {
      all += (all.empty() ? "'" : ", '") + std::string(key.str()) + "': " + text(one);
    }
    return "{" + all + "}";
  }
  if (const auto word = node.value_exact<std::string>()) return "'" + *word + "'";
  if (const auto whole = node.value_exact<std::int64_t>()) return std::to_string(*whole);
  if (const auto number = node.value_exact<double>()) return number_text(*number);
  if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
  return "one";
}

}  // namespace

Refusal take_order(const toml::node& node, int& item) {
  if (node.value_exact<std::string>() == "locked") {
    item = locked;
    return {};
  }
  int order = 0;
  if (take(node, 1.0, order) || order < 0 || order > max_order) return Wrong{&node, {}};
  item = order;
  return {};
}

Refusal take_section(const toml::node& node, int& item) {
  int number = 0;
  if (take(node, 1.0, number) || number < 1) return Wrong{&node, {}};
  item = number - 1;
  return {};
}

Refusal take_taper(const toml::node& node, double& base, std::optional<double>& tip) {
  if (!node.is_array()) return take(node, 1.0, base);
  std::array<double, 2> ends{};
  if (take(node, 1.0, ends)) return Wrong{&node, {}};
  base = ends[0];
  tip = ends[1];
  return {};
}

Refusal take_route(const toml::node& node, double unit, double& even,
                   std::vector<std::array<double, 2>>& pairs) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return take(node, unit, even);
  if (array->empty()) return Wrong{&node, {}};
  const bool wrong = array->front().is_array() ? take(node, unit, pairs).has_value()
                                               : take(node, unit, pairs.emplace_back()).has_value();
  return wrong ? Refusal(Wrong{&node, {}}) : std::nullopt;
}

std::string shown(const toml::node& node) {
  constexpr std::size_t most = 60;
  std::string value = text(node);
  if (value.size() > most) value = value.substr(0, most - 3) + "...";
  return value + " (" + kind(node) + ")";
}

}  // namespace cdcr::robot_file
