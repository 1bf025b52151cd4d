#pragma once

#include "chain/chain.hpp"
#include "chain/inertia.hpp"

namespace cdcr::detail {

/// Mass matrix by composite inertia from tip to base, eq. (34): O(n^2).
template <class Section>
void composite_mass(const Chain& chain, const ChainState<Section>& state, MatrixRef M) {
  using S = typename Section::Scalar;
  using Matrix3m = typename Section::Matrix3m;
  using Vectorm = typename Section::Vectorm;
  constexpr int m = Section::m;
  Articulated<S> outboard = articulated_payload(chain.payload, state.tip);
  for (Index i = chain.num_sections() - 1; i >= 0; --i) {
    const Section& section = state.sections[i];
    const Index at = chain.first[i], size = chain.first[i + 1] - at;
    // What moves beyond this tip as one piece, and what it takes to move it with q.
    const Matrix3<S> Gt = outboard.G.transpose();
    Matrix3m F, T;
    for (Index k = 0; k < F.cols(); ++k) {
      const Vector3<S> w = section.J_omega.col(k), v = section.J_v.col(k);
      F.col(k) = sum_of_products(Gt, w, outboard.M, v);
      T.col(k) = sum_of_products(outboard.J, w, outboard.G, v);
    }
    auto own = M.template block<m, m>(at, at, size, size);
    own = section.own_mass() + section.J_omega.transpose() * T + section.J_v.transpose() * F;
    own.template triangularView<Eigen::StrictlyLower>() = own.transpose();
    for (Index k = 0; k < T.cols(); ++k) T.col(k) += section.r.cross(F.col(k));
    F += section.linear_coupling();
    T += section.angular_coupling();
    for (Index k = 0; k < size; ++k) {  // what column k asks of the sections that carry it
      const Vector3<S> f = F.col(k);
      Vector3<S> t = T.col(k);
      for (Index j = i - 1; j >= 0; --j) {
        const Section& before = state.sections[j];
        const Index row = chain.first[j];
        const Vectorm coupling = before.J_omega.transpose() * t + before.J_v.transpose() * f;
        t += before.r.cross(f);
        for (Index l = 0; l < coupling.size(); ++l) {
          M(row + l, at + k) = M(at + k, row + l) = coupling[l];
        }
      }
    }
    shift(outboard, section.r);
    add_section(outboard, chain.sections[i].mass, section);
  }
}

}  // namespace cdcr::detail
