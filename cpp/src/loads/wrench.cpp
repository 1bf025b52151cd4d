#include "cdcr/wrench.hpp"

#include "base/arguments.hpp"
#include "base/sizes.hpp"
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
    detail::require(detail::is_section(model, w.section), item, "section must be 0 to ",
                    model.num_sections() - 1, ", got ", w.section);
    detail::require(detail::is_fraction(w.fraction), item, "fraction must be 0 to 1, got ",
                    w.fraction);
    detail::require(w.force.allFinite(), item, "force must be three finite numbers of N, got [",
                    w.force.transpose(), "]");
    detail::require(w.moment.allFinite(), item, "moment must be three finite numbers of N m, got [",
                    w.moment.transpose(), "]");
  }
}

Status check_wrenches(const Model& model, const Wrenches& wrenches) noexcept {
  for (const Wrench& w : wrenches) {
    const bool sound = detail::is_section(model, w.section) && detail::is_fraction(w.fraction) &&
                       w.force.allFinite() && w.moment.allFinite();
    if (!sound) return Status::invalid_wrench;
  }
  return Status::ok;
}

void add_wrench_force(const Model& model, const ConstVectorRef& q, const Wrenches& wrenches,
                      VectorRef force) noexcept {
  assert(detail::of_coordinates(model, q, force));
  assert(check_wrenches(model, wrenches) == Status::ok);
  detail::add_wrench_force<double>(detail::chain_of(model), q.data(), wrenches, force.data());
}

}  // namespace cdcr
