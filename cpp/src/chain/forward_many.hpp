#pragma once

#include <type_traits>

#include "chain/chain.hpp"
#include "chain/eliminate.hpp"
#include "chain/inertia.hpp"

namespace cdcr::detail {

/// The same as forward_dynamics (chain/forward.hpp) for sections of many coordinates, whose number
/// the compiler does not know. Apart, since what is best for two coordinates is not for many.
template <class Section, class S = typename Section::Scalar>
void forward_dynamics_of_many(const Chain& chain, const ChainState<Section>& state, const S* force,
                              S* qdd) {
  using Vectorm = typename Section::Vectorm;
  using Matrixm = typename Section::Matrixm;
  using Matrix3m = typename Section::Matrix3m;
  const Index n = chain.num_sections();
  std::array<Eliminated<Section>, max_sections> eliminated;
  Articulated<S> outboard = articulated_payload(chain.payload, state.tip);
  // Eliminates q of section i; `carries` is false where no mass lies beyond it.
  const auto eliminate = [&](Index i, auto carries) {
    const Section& section = state.sections[i];
    Eliminated<Section>& s = eliminated[i];
    Matrixm D = section.own_mass();
    Vectorm b = section.bias - Eigen::Map<const Vectorm>(force + chain.first[i], D.rows());
    Vector3<S> f_tip, m_tip;
    Matrix3m F, T;
    if constexpr (carries) {
      // What the rest of the chain asks of this tip: its own share, and that of q.
      const Matrix3<S> Gt = outboard.G.transpose();
      const Vector3<S>&alpha = section.tip_angular_bias, &a = section.tip_linear_bias;
      f_tip = outboard.force + Gt.lazyProduct(alpha) + outboard.M.lazyProduct(a);
      m_tip = outboard.moment + outboard.J.lazyProduct(alpha) + outboard.G.lazyProduct(a);
      with_fma<S>([&] {
        F = Gt.lazyProduct(section.J_omega) + outboard.M.lazyProduct(section.J_v);
        T = outboard.J.lazyProduct(section.J_omega) + outboard.G.lazyProduct(section.J_v);
        D += section.J_omega.transpose().lazyProduct(T) + section.J_v.transpose().lazyProduct(F);
        b += section.J_omega.transpose().lazyProduct(m_tip) +
             section.J_v.transpose().lazyProduct(f_tip);
      });
      s.force(D.cols()) = F + section.linear_coupling();
    } else {
      s.force(D.cols()) = section.linear_coupling();
    }
    s.set(D, b);
    if (i == 0) {  // its base neither turns nor passes anything on
      s.solve(false);
      return;
    }
    if constexpr (carries) {
      for (Index k = 0; k < F.cols(); ++k) T.col(k) += section.r.cross(F.col(k));
      s.moment(D.cols()) = T + section.angular_coupling();
      shift(outboard, section.r);
    } else {
      s.moment(D.cols()) = section.angular_coupling();
    }
    add_section(outboard, chain.sections[i].mass, section);
    s.solve(true);
    if constexpr (carries) {
      outboard.force = f_tip + section.force;
      outboard.moment = m_tip + section.r.cross(f_tip) + section.moment;
    } else {
      outboard.force = section.force;
      outboard.moment = section.moment;
    }
    s.take_from(outboard);
  };
  Index last = n - 1;
  if (!chain.payload.has_inertia()) eliminate(last--, std::false_type());
  for (Index i = last; i >= 0; --i) eliminate(i, std::true_type());

  // At a base at rest weight is an acceleration upwards.
  Vector3<S> omega = Vector3<S>::Zero(), v = -chain.gravity.template cast<S>();
  for (Index i = 0; i < n; ++i) {
    const Section& section = state.sections[i];
    const Vectorm a = eliminated[i].acceleration(omega, v, i > 0);
    Eigen::Map<Vectorm>(qdd + chain.first[i], a.size()) = a;
    if (i + 1 == n) break;
    v += omega.cross(section.r) + section.J_v.lazyProduct(a) + section.tip_linear_bias;
    omega += section.J_omega.lazyProduct(a) + section.tip_angular_bias;
  }
}

}  // namespace cdcr::detail
