#pragma once

#include "chain/chain.hpp"
#include "chain/inertia.hpp"

namespace cdcr::detail {

/// Mass matrix by composite inertia from tip to base, eq. (34): O(n^2).
template <class Section, class Matrix>
void composite_mass(const Chain& chain, const ChainState<Section>& state, Matrix& M) {
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
    Matrix3m F = Gt.lazyProduct(section.J_omega) + outboard.M.lazyProduct(section.J_v);
    Matrix3m T = outboard.J.lazyProduct(section.J_omega) + outboard.G.lazyProduct(section.J_v);
    auto own = M.template block<m, m>(at, at, size, size);
    own = section.own_mass() + section.J_omega.transpose().lazyProduct(T) +
          section.J_v.transpose().lazyProduct(F);
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
        const Vectorm coupling =
            before.J_omega.transpose().lazyProduct(t) + before.J_v.transpose().lazyProduct(f);
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
