#pragma once

#include <Eigen/Cholesky>
#include <type_traits>

#include "chain/chain.hpp"
#include "chain/forward_many.hpp"
#include "chain/inertia.hpp"

namespace cdcr::detail {

/// Inverse of a symmetric positive definite matrix.
template <class Square, class S = typename Square::Scalar>
[[nodiscard]] Square inverse_of(const Square& D) {
  if constexpr (Square::RowsAtCompileTime == 2) {
    const S factor = 1.0 / (D(0, 0) * D(1, 1) - D(0, 1) * D(0, 1));
    const S across = -D(0, 1) * factor;
    Square inverse;
    inverse << D(1, 1) * factor, across, across, D(0, 0) * factor;
    return inverse;
  } else {
    return D.llt().solve(Square::Identity(D.rows(), D.rows()));
  }
}

/// Accelerations under a generalised force, by one pass from tip to base for articulated inertia
/// and one out again for accelerations, eqs. (31), (32): O(n).
template <class Section, class S = typename Section::Scalar>
void forward_dynamics(const Chain& chain, const ChainState<Section>& state, const S* force,
                      S* qdd) {
  if constexpr (Section::m == Eigen::Dynamic) {
    return forward_dynamics_of_many(chain, state, force, qdd);
  }
  using Vectorm = typename Section::Vectorm;
  using Matrixm = typename Section::Matrixm;
  using Matrix3m = typename Section::Matrix3m;
  struct Solved {
    Matrix3m U_omega, U_v;  // force on the base that an acceleration of q needs
    Matrixm inverse;        // of the section's articulated mass D
    Vectorm u;              // D^-1 of the force on q at rest
  };
  const Index n = chain.num_sections();
  std::array<Solved, max_sections> solved;
  Articulated<S> outboard = articulated_payload(chain.payload, state.tip);
  // Eliminates q of section i; `carries` is false where no mass lies beyond it.
  const auto eliminate = [&](Index i, auto carries) {
    const Section& section = state.sections[i];
    Solved& s = solved[i];
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
      F = Gt.lazyProduct(section.J_omega) + outboard.M.lazyProduct(section.J_v);
      T = outboard.J.lazyProduct(section.J_omega) + outboard.G.lazyProduct(section.J_v);
      D += section.J_omega.transpose().lazyProduct(T) + section.J_v.transpose().lazyProduct(F);
      b += section.J_omega.transpose().lazyProduct(m_tip) +
           section.J_v.transpose().lazyProduct(f_tip);
      s.U_v = F + section.linear_coupling();
    } else {
      s.U_v = section.linear_coupling();
    }
    s.inverse = inverse_of(D);
    s.u = s.inverse.lazyProduct(b);
    if (i == 0) return;  // its base neither turns nor passes anything on

    if constexpr (carries) {
      for (Index k = 0; k < F.cols(); ++k) T.col(k) += section.r.cross(F.col(k));
      s.U_omega = T + section.angular_coupling();
      shift(outboard, section.r);
    } else {
      s.U_omega = section.angular_coupling();
    }
    add_section(outboard, chain.sections[i].mass, section);
    const Matrix3m UD = s.U_omega.lazyProduct(s.inverse), VD = s.U_v.lazyProduct(s.inverse);
    outboard.J -= UD.lazyProduct(s.U_omega.transpose());
    outboard.G -= UD.lazyProduct(s.U_v.transpose());
    outboard.M -= VD.lazyProduct(s.U_v.transpose());
    if constexpr (carries) {
      outboard.force = f_tip + section.force - s.U_v.lazyProduct(s.u);
      outboard.moment =
          m_tip + section.r.cross(f_tip) + section.moment - s.U_omega.lazyProduct(s.u);
    } else {
      outboard.force = section.force - s.U_v.lazyProduct(s.u);
      outboard.moment = section.moment - s.U_omega.lazyProduct(s.u);
    }
  };
  Index last = n - 1;
  if (!chain.payload.has_inertia()) eliminate(last--, std::false_type());
  for (Index i = last; i >= 0; --i) eliminate(i, std::true_type());

  // At a base at rest weight is an acceleration upwards.
  Vector3<S> omega = Vector3<S>::Zero(), v = -chain.gravity.template cast<S>();
  for (Index i = 0; i < n; ++i) {
    const Section& section = state.sections[i];
    const Solved& s = solved[i];
    Vectorm w = s.U_v.transpose().lazyProduct(v);
    if (i > 0) w += s.U_omega.transpose().lazyProduct(omega);
    const Vectorm a = -s.u - s.inverse.lazyProduct(w);
    Eigen::Map<Vectorm>(qdd + chain.first[i], a.size()) = a;
    if (i + 1 == n) break;
    v += omega.cross(section.r) + section.J_v.lazyProduct(a) + section.tip_linear_bias;
    omega += section.J_omega.lazyProduct(a) + section.tip_angular_bias;
  }
}

}  // namespace cdcr::detail
