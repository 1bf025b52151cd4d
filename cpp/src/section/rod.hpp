#pragma once

#include "section/rod_frames.hpp"

namespace cdcr::detail {

/// The kind of section (section_state.hpp) whose bending, twist and stretch vary along it: rigid
/// elements at nodes, cpp/rods.md eqs. (58) to (62). The number of coordinates is that of its
/// parameters.
template <class S>
struct Rod : RodFrames<S> {
  using Scalar = S;
  using RodFrames<S>::m, RodFrames<S>::max_m;
  using Matrix3m = typename RodFrames<S>::Matrix3m;
  using Matrixm = Eigen::Matrix<S, m, m, Eigen::ColMajor, max_m, max_m>;
  using Vectorm = Eigen::Matrix<S, m, 1, Eigen::ColMajor, max_m, 1>;

  using RodFrames<S>::base, RodFrames<S>::points, RodFrames<S>::axes, RodFrames<S>::rod,
      RodFrames<S>::move;
  using Point = typename RodFrames<S>::Point;

  Vector3<S> r;
  Matrix3m J_omega, J_v;
  Vector3<S> tip_angular_bias, tip_linear_bias, moment, force;
  Vectorm bias;
  Vectorm elastic;

  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* q) {
    RodFrames<S>::update_position(section, at, q);
    const int n = rod->num_nodes();
    r = points[n - 1].r;
    J_omega = points[n - 1].J_omega;
    J_v = points[n - 1].J_v;
    elastic = elastic_force(section, q);
  }

  /// Frame at the tip; how fast it turns is left out.
  [[nodiscard]] FrameState<S> end() const {
    return {axes.col(0), axes.col(1), axes.col(2), Vector3<S>::Zero()};
  }
  /// omega of the tip.
  [[nodiscard]] Vector3<S> turning_rate() const {
    return base.omega + points[rod->num_nodes() - 1].omega;
  }

  template <bool turns>
  void update_velocity(const SectionParameters&, const Vector3<S>& omega, const S* qd) {
    base.omega = omega;
    const int n = rod->num_nodes();
    move(qd);
    bias = elastic;
    for (int i = 0; i < rod->size(); ++i) bias[i] += rod->damping[i] * qd[i];
    if (rod->material_damping > 0.0) add_material_damping(qd);
    if constexpr (turns) {
      const double inertia = rod->nodes[0].inertia;
      force.setZero();
      moment = inertia * omega.dot(base.z) * omega.cross(base.z);
    }
    Vector3<S> a = Vector3<S>::Zero(), alpha = a;
    for (int k = 0; k < n; ++k) {
      const Point& point = points[k];
      const RodNode& node = rod->nodes[k + 1];
      a = point.v_dot;
      alpha = point.omega_dot;
      Vector3<S> whole = point.omega;
      if constexpr (turns) {
        a += omega.cross(Vector3<S>(omega.cross(point.r) + 2.0 * point.v));
        alpha += omega.cross(point.omega);
        whole += omega;
      }
      const Vector3<S> push = node.mass * a;
      // Rate of I_t (omega + t (t.omega)).
      const Vector3<S> twist = node.inertia * (alpha + point.t.dot(alpha) * point.t +
                                               point.t.dot(whole) * whole.cross(point.t));
      bias += point.J_v.transpose().lazyProduct(push);
      bias += point.J_omega.transpose().lazyProduct(twist);
      if constexpr (turns) {
        force += push;
        moment += point.r.cross(push) + twist;
      }
    }
    tip_angular_bias = alpha;
    tip_linear_bias = a;
  }

  [[nodiscard]] Vector3<S> first_moment() const {
    Vector3<S> h = Vector3<S>::Zero();
    for (int k = 0; k < rod->num_nodes(); ++k) h += rod->nodes[k + 1].mass * points[k].r;
    return h;
  }
  [[nodiscard]] Matrix3<S> second_moment() const {
    S round(rod->nodes[0].inertia);
    Matrix3<S> J = round * base.z * base.z.transpose();
    for (int k = 0; k < rod->num_nodes(); ++k) {
      const Point& point = points[k];
      const RodNode& node = rod->nodes[k + 1];
      round += node.mass * point.r.squaredNorm() + node.inertia;
      J += node.inertia * point.t * point.t.transpose() - node.mass * point.r * point.r.transpose();
    }
    J.diagonal().array() += round;
    return J;
  }
  [[nodiscard]] Matrix3m linear_coupling() const {
    Matrix3m H = Matrix3m::Zero(3, rod->size());
    for (int k = 0; k < rod->num_nodes(); ++k) H += rod->nodes[k + 1].mass * points[k].J_v;
    return H;
  }
  [[nodiscard]] Matrix3m angular_coupling() const {
    Matrix3m N = Matrix3m::Zero(3, rod->size());
    for (int k = 0; k < rod->num_nodes(); ++k) {
      const Point& point = points[k];
      const RodNode& node = rod->nodes[k + 1];
      const Vector3<S> lever = node.mass * point.r;
      for (int i = 0; i < rod->size(); ++i) {
        const Vector3<S> turning = point.J_omega.col(i);
        N.col(i) += lever.cross(Vector3<S>(point.J_v.col(i))) +
                    node.inertia * (turning + point.t.dot(turning) * point.t);
      }
    }
    return N;
  }
  [[nodiscard]] Matrixm own_mass() const {
    const int size = rod->size();
    Matrixm M = Matrixm::Zero(size, size);
    for (int k = 0; k < rod->num_nodes(); ++k) {
      const Point& point = points[k];
      const RodNode& node = rod->nodes[k + 1];
      const Vectorm spin = point.J_omega.transpose().lazyProduct(point.t);
      for (int j = 0; j < size; ++j) {
        const Vector3<S> moving = node.mass * point.J_v.col(j),
                         turning = node.inertia * point.J_omega.col(j);
        const S spinning = node.inertia * spin[j];
        for (int i = j; i < size; ++i) {
          M(i, j) +=
              point.J_v.col(i).dot(moving) + point.J_omega.col(i).dot(turning) + spin[i] * spinning;
        }
      }
    }
    M.template triangularView<Eigen::StrictlyUpper>() = M.transpose();
    return M;
  }

  void add_material_damping(const S* qd) {
    for (int i = 0; i < rod->size(); ++i) {
      for (int j = 0; j < rod->size(); ++j) {
        bias[i] += rod->material_damping * rod->stiffness(i, j) * qd[j];
      }
    }
  }
  [[nodiscard]] static Vectorm elastic_force(const SectionParameters& section, const S* q) {
    const RodParameters& rod = *section.rod;
    Vectorm force(rod.size());
    for (int i = 0; i < rod.size(); ++i) {
      force[i] = S(0.0);
      for (int j = 0; j < rod.size(); ++j) force[i] += rod.stiffness(i, j) * (q[j] - rod.rest[j]);
    }
    return force;
  }
  [[nodiscard]] static S elastic_energy(const SectionParameters& section, const S* q) {
    const RodParameters& rod = *section.rod;
    const Vectorm force = elastic_force(section, q);
    S twice(0.0);
    for (int i = 0; i < force.size(); ++i) twice += force[i] * (q[i] - rod.rest[i]);
    return 0.5 * twice;
  }
};

}  // namespace cdcr::detail
