#pragma once

#include "cdcr/total_force.hpp"
#include "dynamics/parts.hpp"
#include "loads/cable_force.hpp"
#include "loads/friction_memory.hpp"
#include "loads/wrench_force.hpp"

namespace cdcr::detail {

/// cdcr::total_force on any scalar.
template <class S>
void total_force(const Model& model, const S* q, const S* qd, const S* command,
                 const Wrenches& wrenches, S* force) {
  cable_force(model, q, qd, command, force);
  add_wrench_force(chain_of(model), q, wrenches, force);
}

/// The same where friction remembers, and the rates of the deflections (num_cables).
template <class S>
void total_force(const Model& model, const S* q, const S* qd, const S* command, const S* deflection,
                 const Wrenches& wrenches, S* force, S* rate) {
  memory_force(model, q, qd, command, deflection, force, rate);
  add_wrench_force(chain_of(model), q, wrenches, force);
}

}  // namespace cdcr::detail
