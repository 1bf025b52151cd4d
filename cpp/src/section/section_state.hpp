#pragma once

#include <Eigen/Geometry>

#include "cdcr/types.hpp"

// What a chain asks of a kind of section, and the frames between sections.
//
// A kind is a struct template K<S> on the scalar (double for motion, a dual number for
// derivatives) that holds one section in one state. All vectors are expressed in the base frame of
// the robot; omega and v are those of the section's own base, "tip" is its other end.
//
//   m                                          number of coordinates q of the section
//   component_names                            what they are called after its number
//   update_position(parameters, base, q)       everything below that q alone decides
//   update_velocity<turns>(parameters, omega, qd)   the rest; where the base does not turn
//                                              (turns = false) moment and force may stay unset
//   end()                                      frame of the tip; turning_rate(): its omega
//   r                                          from base to tip (3)
//   J_omega, J_v (3 x m)                       omega_tip = omega + J_omega qd,
//                                              v_tip = v + omega x r + J_v qd
//   tip_angular_bias, tip_linear_bias (3)      accelerations of the tip from velocities alone
//   first_moment() (3), second_moment() (3x3)  of mass, about the base
//   linear_coupling(), angular_coupling()      momenta of qd (3 x m)
//   own_mass() (m x m)                         kinetic energy qd^T own_mass qd / 2 on a fixed base
//   moment, force (3), bias (m)                inertia forces from velocities alone; bias holds
//                                              elastic and damping forces too
//   elastic_force(parameters) (m)              gradient of the elastic energy
//   elastic_energy(parameters)
//
// The recursions of room chain/ see only that (cpp/several-sections.md eqs. (30) to (34)).

namespace cdcr::detail {

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;

/// A frame, by its axes, and how fast it turns.
template <class S>
struct FrameState {
  Vector3<S> x, y, z;
  Vector3<S> omega;

  /// A vector of this frame, expressed in the base frame.
  [[nodiscard]] Vector3<S> rotate(const Vector3d& v) const {
    return x * v[0] + y * v[1] + z * v[2];
  }
  [[nodiscard]] Matrix3<S> rotation() const {
    Matrix3<S> R;
    R << x, y, z;
    return R;
  }
};

}  // namespace cdcr::detail
