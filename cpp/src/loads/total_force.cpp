#include "loads/total_force.hpp"

namespace cdcr {

void total_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, const Wrenches& wrenches,
                 VectorRef force) noexcept {
  detail::total_force(model, q.data(), qd.data(), command.data(), wrenches, force.data());
}

}  // namespace cdcr
