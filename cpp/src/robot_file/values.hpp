#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cdcr/robot.hpp"
#include "robot_file/toml.hpp"

// Values of a TOML file into fields. Each function gives back what is wrong, or nothing.

namespace cdcr::robot_file {

/// The part of a value that is wrong, and where in the value it stands, such as "[1]".
struct Wrong {
  const toml::node* node;
  std::string place;
};
using Refusal = std::optional<Wrong>;

inline Refusal at(Refusal inner, std::size_t k) {
  if (inner) inner->place = "[" + std::to_string(k) + "]" + inner->place;
  return inner;
}

/// Numbers are multiplied by `unit`: that of an angle in degrees [rad].
inline Refusal take(const toml::node& node, double unit, double& item) {
  if (const auto whole = node.value_exact<std::int64_t>()) {
    item = unit * static_cast<double>(*whole);
  } else if (const auto number = node.value_exact<double>()) {
    item = *number * unit;
  } else {
    return Wrong{&node, {}};
  }
  return {};
}

inline Refusal take(const toml::node& node, double /*unit*/, int& item) {
  using Limits = std::numeric_limits<int>;
  const auto whole = node.value_exact<std::int64_t>();
  if (!whole || *whole < Limits::min() || *whole > Limits::max()) return Wrong{&node, {}};
  item = static_cast<int>(*whole);
  return {};
}

template <typename T>
Refusal take(const toml::node& node, double unit, std::optional<T>& item) {
  return take(node, unit, item.emplace());
}

inline Refusal take(const toml::node& node, double unit, std::array<double, 2>& item);

/// `put(k)` is where number or row k of an array goes.
template <typename Put>
Refusal take_each(const toml::node& node, double unit, Put put) {
  std::size_t k = 0;
  for (const toml::node& one : *node.as_array()) {
    if (Refusal wrong = take(one, unit, put(k))) return at(wrong, k);
    ++k;
  }
  return {};
}

inline bool is_array(const toml::node& node, std::size_t size) {
  return node.is_array() && node.as_array()->size() == size;
}

inline Refusal take(const toml::node& node, double unit, std::array<double, 2>& item) {
  if (!is_array(node, 2)) return Wrong{&node, {}};
  return take_each(node, unit, [&](std::size_t k) -> double& { return item[k]; });
}

template <typename T>
Refusal take(const toml::node& node, double unit, std::vector<T>& item) {
  if (!node.is_array()) return Wrong{&node, {}};
  item.clear();
  return take_each(node, unit, [&](std::size_t) -> T& { return item.emplace_back(); });
}

inline Refusal take(const toml::node& node, double unit, Vector3d& item) {
  if (!is_array(node, 3)) return Wrong{&node, {}};
  return take_each(node, unit,
                   [&](std::size_t k) -> double& { return item[static_cast<Index>(k)]; });
}

/// By rows.
template <int n, int options>
Refusal take(const toml::node& node, double unit, Eigen::Matrix<double, n, n, options>& item) {
  if (!node.is_array()) return Wrong{&node, {}};
  std::size_t i = 0;
  for (const toml::node& row : *node.as_array()) {
    if (!is_array(row, n)) return at(Wrong{&row, {}}, i);
    double beyond = 0.0;
    const auto number = [&](std::size_t j) -> double& {
      return i < n ? item(static_cast<Index>(i), static_cast<Index>(j)) : beyond;
    };
    if (Refusal wrong = take_each(row, unit, number)) return at(wrong, i);
    ++i;
  }
  return i == n ? std::nullopt : Refusal(Wrong{&node, {}});
}

/// The order of a strain, or "locked".
Refusal take_order(const toml::node& node, int& item);
/// The number of a section, from 1, as its index.
Refusal take_section(const toml::node& node, int& item);
/// The diameter of a backbone, or that at base and tip of a taper.
Refusal take_taper(const toml::node& node, double& base, std::optional<double>& tip);
/// A number for a cable that runs straight, or (base, tip) of each section passed, of which one may
/// stand by itself.
Refusal take_route(const toml::node& node, double unit, double& even,
                   std::vector<std::array<double, 2>>& pairs);

/// A value as a refusal prints it: short, with its kind in TOML's words.
std::string shown(const toml::node& node);

}  // namespace cdcr::robot_file
