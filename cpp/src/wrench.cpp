#include "cdcr/wrench.hpp"

#include <sstream>
#include <stdexcept>

#include "wrench_force.hpp"

namespace cdcr {

const Wrenches& no_wrenches() noexcept {
  static const Wrenches none;
  return none;
}

void validate(const Model& model, const Wrenches& wrenches) {
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    const Wrench& w = wrenches[i];
    std::ostringstream text;
    text << "wrenches[" << i << "].";
    if (w.section < 0 || w.section >= model.num_sections()) {
      text << "section must be 0 to " << model.num_sections() - 1 << ", got " << w.section;
    } else if (!(w.fraction >= 0.0 && w.fraction <= 1.0)) {
      text << "fraction must be 0 to 1, got " << w.fraction;
    } else if (!w.force.allFinite()) {
      text << "force must be three finite numbers of N, got [" << w.force.transpose() << "]";
    } else if (!w.moment.allFinite()) {
      text << "moment must be three finite numbers of N m, got [" << w.moment.transpose() << "]";
    } else {
      continue;
    }
    throw std::invalid_argument(text.str());
  }
}

void add_wrench_force(const Model& model, const ConstVectorRef& q, const Wrenches& wrenches,
                      VectorRef force) noexcept {
  detail::add_wrench_force<double>(model.chain(), q.data(), wrenches, force.data());
}

}  // namespace cdcr
