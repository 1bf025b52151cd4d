#include "loads/total_force.hpp"

#include "base/sizes.hpp"

namespace cdcr {

void total_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, const Wrenches& wrenches,
                 VectorRef force) noexcept {
  assert(detail::of_coordinates(model, q, qd, force) && detail::of_cables(model, command));
  assert(check_wrenches(model, wrenches) == Status::ok);
  detail::total_force(model, q.data(), qd.data(), command.data(), wrenches, force.data());
}

}  // namespace cdcr
