#include "variables.hpp"

#include <algorithm>
#include <stdexcept>

namespace cdcr::fmu {

Variables::Variables(const Model& model) : first_{0} {
  const Index d = model.num_coordinates(), m = model.num_cables();
  for (const Index count : {Index{1}, Index{3}, d, d, m, d, d, d, Index{3}, Index{9}, m, m}) {
    first_.push_back(first_.back() + count);
  }
  for (const Cable& cable : model.cables()) length_driven_.push_back(cable.length_driven());
}

Variable Variables::find(std::uint32_t reference) const {
  const Index index = reference;
  if (index >= first_.back()) {
    throw std::invalid_argument("there is no variable of value reference " +
                                std::to_string(reference));
  }
  const auto end = std::upper_bound(first_.begin(), first_.end(), index);
  const auto kind = static_cast<Kind>(end - first_.begin() - 1);
  return {kind, index - first(kind)};
}

std::string Variables::name(Variable variable) const {
  static constexpr const char* names[] = {
      "time",         "gravity",         "q_start",      "qd_start",     "", "q", "qd", "qdd",
      "tip.position", "tip.orientation", "cable_length", "cable_tension"};
  const Index i = variable.i;
  std::string name = names[static_cast<int>(variable.kind)];
  if (variable.kind == Kind::time) return name;
  if (variable.kind == Kind::command) name = length_driven_[i] ? "length" : "tension";
  const auto number = [](Index k) { return std::to_string(k + 1); };
  if (variable.kind == Kind::tip_rotation)
    return name + "[" + number(i / 3) + "," + number(i % 3) + "]";
  return name + "[" + number(i) + "]";
}

}  // namespace cdcr::fmu
