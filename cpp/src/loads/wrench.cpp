#include "cdcr/wrench.hpp"

#include "base/arguments.hpp"
#include "dynamics/parts.hpp"
#include "loads/wrench_force.hpp"

namespace cdcr {

const Wrenches& no_wrenches() noexcept {
  static const Wrenches none;
  return none;
}

void validate(const Model& model, const Wrenches& wrenches) {
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    const Wrench& w = wrenches[i];
    const std::string item = detail::sentence("wrenches[", i, "].");
    detail::require(w.section >= 0 && w.section < model.num_sections(), item,
                    "section must be 0 to ", model.num_sections() - 1, ", got ", w.section);
    detail::require(w.fraction >= 0.0 && w.fraction <= 1.0, item, "fraction must be 0 to 1, got ",
                    w.fraction);
    detail::require(w.force.allFinite(), item, "force must be three finite numbers of N, got [",
                    w.force.transpose(), "]");
    detail::require(w.moment.allFinite(), item, "moment must be three finite numbers of N m, got [",
                    w.moment.transpose(), "]");
  }
}

void add_wrench_force(const Model& model, const ConstVectorRef& q, const Wrenches& wrenches,
                      VectorRef force) noexcept {
  detail::add_wrench_force<double>(detail::chain_of(model), q.data(), wrenches, force.data());
}

}  // namespace cdcr
