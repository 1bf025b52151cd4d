#pragma once

#include "section/constant_curvature.hpp"

// Kinds of section (section/section_state.hpp) that only tests have. They are made of arcs, so what
// they should say is known from robots of arcs, but have another number of coordinates.

namespace cdcr::test {

/// Bends in its plane of x and z alone: one coordinate.
template <class S>
struct Planar : detail::ConstantCurvature<S> {
  using Arcs = detail::ConstantCurvature<S>;
  static constexpr int m = 1;
  using Matrix3m = Eigen::Matrix<S, 3, 1>;
  using Matrixm = Eigen::Matrix<S, 1, 1>;
  using Vectorm = Matrixm;
  Matrix3m J_omega, J_v;
  Vectorm bias;

  void update_position(const detail::SectionParameters& section, const detail::FrameState<S>& at,
                       const S* bend) {
    const S whole[] = {bend[0], S(0.0)};
    Arcs::update_position(section, at, whole);
    J_omega = Arcs::J_omega.col(0);
    J_v = Arcs::J_v.col(0);
  }
  template <bool turns>
  void update_velocity(const detail::SectionParameters& section, const detail::Vector3<S>& omega,
                       const S* rate) {
    const S whole[] = {rate[0], S(0.0)};
    Arcs::template update_velocity<turns>(section, omega, whole);
    bias[0] = Arcs::bias[0];
  }
  [[nodiscard]] Matrix3m linear_coupling() const { return Arcs::linear_coupling().col(0); }
  [[nodiscard]] Matrix3m angular_coupling() const { return Arcs::angular_coupling().col(0); }
  [[nodiscard]] Matrixm own_mass() const { return Arcs::own_mass().template topLeftCorner<1, 1>(); }

  [[nodiscard]] static Vectorm elastic_force(const detail::SectionParameters& section,
                                             const S* bend) {
    return Vectorm(section.stiffness * bend[0]);
  }
  [[nodiscard]] static S elastic_energy(const detail::SectionParameters& section, const S* bend) {
    return 0.5 * section.stiffness * bend[0] * bend[0];
  }
};

/// Two equal arcs, one on the tip of the other: four coordinates. The parameters are those of one
/// arc, but for the mass, which is that of both.
template <class S>
struct Pair {
  using Scalar = S;
  static constexpr int m = 4;
  using Matrix3m = Eigen::Matrix<S, 3, m>;
  using Matrixm = Eigen::Matrix<S, m, m>;
  using Vectorm = Eigen::Matrix<S, m, 1>;
  using Vector3 = detail::Vector3<S>;
  using Arc = detail::ConstantCurvature<S>;

  Arc near, far;
  detail::FrameState<S> base;
  S mass;  // of one arc
  Vector3 r;
  Matrix3m J_omega, J_v;
  Vector3 tip_angular_bias, tip_linear_bias, moment, force;
  Vectorm bias;

  void update_position(const detail::SectionParameters& section, const detail::FrameState<S>& at,
                       const S* q) {
    base = at;
    mass = 0.5 * section.mass;
    near.update_position(section, at, q);
    far.update_position(section, near.end(), q + 2);
    r = near.r + far.r;
    J_omega << near.J_omega, far.J_omega;
    J_v << near.J_v + crossed(near.J_omega, far.r), far.J_v;
  }
  [[nodiscard]] detail::FrameState<S> end() const { return far.end(); }
  [[nodiscard]] Vector3 turning_rate() const { return far.turning_rate(); }

  template <bool turns>
  void update_velocity(const detail::SectionParameters& section, const Vector3& omega,
                       const S* qd) {
    base.omega = omega;
    near.template update_velocity<turns>(section, omega, qd);
    far.template update_velocity<true>(section, near.turning_rate(), qd + 2);
    // The far arc's base accelerates as the near arc's tip does.
    const Vector3 &alpha = near.tip_angular_bias, &a = near.tip_linear_bias;
    tip_angular_bias = alpha + far.tip_angular_bias;
    tip_linear_bias = a + alpha.cross(far.r) + far.tip_linear_bias;
    const Vector3 h = far.first_moment();
    const Vector3 carried = far.force + mass * a + alpha.cross(h);
    const Vector3 turned = far.moment + far.second_moment() * alpha + h.cross(a);
    bias << near.bias + near.J_omega.transpose() * turned + near.J_v.transpose() * carried,
        far.bias + far.linear_coupling().transpose() * a +
            far.angular_coupling().transpose() * alpha;
    if constexpr (turns) {
      force = near.force + carried;
      moment = near.moment + turned + near.r.cross(carried);
    }
  }

  [[nodiscard]] Vector3 first_moment() const {
    return near.first_moment() + mass * near.r + far.first_moment();
  }
  [[nodiscard]] detail::Matrix3<S> second_moment() const {
    const Vector3 h = far.first_moment();
    detail::Matrix3<S> J = near.second_moment() + far.second_moment();
    J -= near.r * (h + mass * near.r).transpose() + h * near.r.transpose();
    J.diagonal().array() += near.r.dot(mass * near.r + 2.0 * h);
    return J;
  }
  [[nodiscard]] Matrix3m linear_coupling() const {
    Matrix3m H;
    H << near.linear_coupling() + carried_momentum(), far.linear_coupling();
    return H;
  }
  [[nodiscard]] Matrix3m angular_coupling() const {
    Matrix3m N;
    N << near.angular_coupling() + carried_spin() - crossed(carried_momentum(), near.r),
        far.angular_coupling() - crossed(far.linear_coupling(), near.r);
    return N;
  }
  [[nodiscard]] Matrixm own_mass() const {
    const Eigen::Matrix<S, 2, 2> both = near.J_v.transpose() * far.linear_coupling() +
                                        near.J_omega.transpose() * far.angular_coupling();
    Matrixm M;
    M << near.own_mass() + near.J_v.transpose() * carried_momentum() +
             near.J_omega.transpose() * carried_spin(),
        both, both.transpose(), far.own_mass();
    return M;
  }

  [[nodiscard]] static Vectorm elastic_force(const detail::SectionParameters& section, const S* q) {
    return section.stiffness * Eigen::Map<const Vectorm>(q);
  }
  [[nodiscard]] static S elastic_energy(const detail::SectionParameters& section, const S* q) {
    return Arc::elastic_energy(section, q) + Arc::elastic_energy(section, q + 2);
  }

 private:
  using Matrix32 = typename Arc::Matrix3m;

  /// Each column times a vector.
  static Matrix32 crossed(const Matrix32& columns, const Vector3& v) {
    Matrix32 out;
    for (int k = 0; k < 2; ++k) out.col(k) = Vector3(columns.col(k)).cross(v);
    return out;
  }
  /// Momenta of the far arc, about its base, as the near one carries it.
  [[nodiscard]] Matrix32 carried_momentum() const {
    return mass * near.J_v + crossed(near.J_omega, far.first_moment());
  }
  [[nodiscard]] Matrix32 carried_spin() const {
    return far.second_moment() * near.J_omega - crossed(near.J_v, far.first_moment());
  }
};

}  // namespace cdcr::test
