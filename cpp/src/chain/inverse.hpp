#pragma once

#include "chain/chain.hpp"
#include "chain/inertia.hpp"

namespace cdcr::detail {

/// Generalised force that produces the accelerations: accelerations from base to tip, inertia
/// forces back, eqs. (30), (33): O(n). Without `qdd` the bias.
template <class Section, class S = typename Section::Scalar>
void inverse_dynamics(const Chain& chain, const ChainState<Section>& state, const S* qdd,
                      S* force) {
  using Vectorm = typename Section::Vectorm;
  using Matrix3m = typename Section::Matrix3m;
  struct Inertial {
    Vector3<S> moment, force;
  };
  const Index n = chain.num_sections();
  std::array<Inertial, max_sections> inertial;
  // At a base at rest weight is an acceleration upwards.
  Vector3<S> alpha = Vector3<S>::Zero(), v = -chain.gravity.template cast<S>();
  for (Index i = 0; i < n; ++i) {
    const Section& section = state.sections[i];
    const Index first = chain.first[i], size = chain.first[i + 1] - first;
    Vectorm rate = Vectorm::Zero(size);
    if (qdd != nullptr) rate = Eigen::Map<const Vectorm>(qdd + first, size);
    const Matrix3m H = section.linear_coupling();
    Vectorm own =
        section.bias + section.own_mass().lazyProduct(rate) + H.transpose().lazyProduct(v);
    if (i > 0) {  // the root's base neither turns nor asks what acts on it
      const Vector3<S> h = section.first_moment();
      const Matrix3m N = section.angular_coupling();
      inertial[i].force =
          section.force + chain.sections[i].mass * v + alpha.cross(h) + H.lazyProduct(rate);
      inertial[i].moment = section.moment + section.second_moment().lazyProduct(alpha) +
                           h.cross(v) + N.lazyProduct(rate);
      own += N.transpose().lazyProduct(alpha);
    }
    Eigen::Map<Vectorm>(force + first, size) = own;
    v += alpha.cross(section.r) + section.J_v.lazyProduct(rate) + section.tip_linear_bias;
    alpha += section.J_omega.lazyProduct(rate) + section.tip_angular_bias;
  }

  const Articulated<S> payload = articulated_payload(chain.payload, state.tip);
  Vector3<S> moment = payload.moment + payload.J * alpha + payload.G * v;
  Vector3<S> pull = payload.force + payload.G.transpose() * alpha + payload.M * v;
  for (Index i = n - 1; i >= 0; --i) {
    const Section& section = state.sections[i];
    const Index first = chain.first[i], size = chain.first[i + 1] - first;
    Eigen::Map<Vectorm>(force + first, size) +=
        section.J_omega.transpose().lazyProduct(moment) + section.J_v.transpose().lazyProduct(pull);
    if (i == 0) break;
    moment += section.r.cross(pull) + inertial[i].moment;
    pull += inertial[i].force;
  }
}

}  // namespace cdcr::detail
