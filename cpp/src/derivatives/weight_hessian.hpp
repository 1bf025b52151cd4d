#pragma once

#include <array>

#include "chain/chain.hpp"
#include "derivatives/dual.hpp"
#include "section/width.hpp"

// NOLINTBEGIN(readability-identifier-naming): letters of the equations

namespace cdcr::detail {

/// A section on dual numbers at a position. Compiled once for those who call it.
template <class DualSection>
[[gnu::noinline]] void place(DualSection& dual, const SectionParameters& fixed,
                             const FrameState<Dual>& base, const Dual* q) noexcept {
  with_fma<double>([&] { dual.update_position(fixed, base, q); });
}

/// Second derivatives with respect to the coordinates of an arc, on dual numbers.
template <class Matrix>
void differentiate_own(const SectionParameters& fixed, const ConstantCurvature<double>& arc,
                       const double* q, const Vector3d& g, double mass, const Vector3d& h,
                       Matrix&& H) {
  using DualSection = ConstantCurvature<Dual>;
  DualSection dual;
  const Vector3d moment = h.cross(g);
  const FrameState<Dual> base{arc.base.x.template cast<Dual>(), arc.base.y.template cast<Dual>(),
                              arc.base.z.template cast<Dual>(), Vector3<Dual>::Zero()};
  std::array<Dual, 2> x{Dual(q[0]), Dual(q[1])};
  for (int lane = 0; lane < 2; ++lane) x[lane].slopes[lane] = 1.0;
  place(dual, fixed, base, x.data());
  const typename DualSection::Vectorm force = DualSection::elastic_force(fixed, x.data()) -
                                              dual.linear_coupling().transpose().lazyProduct(g) -
                                              dual.J_omega.transpose().lazyProduct(moment) -
                                              dual.J_v.transpose().lazyProduct(mass * g);
  for (int k = 0; k < 2; ++k) {
    const Vector3d turned = Vector3d(arc.J_omega.col(k)).cross(h).cross(g);
    for (int c = 0; c < 2; ++c) {
      H(c, k) = force[c].slopes[k] - arc.J_omega.col(c).dot(turned);
    }
  }
}

/// The same of a rod, in closed form.
template <class Matrix>
void differentiate_own(const SectionParameters& fixed, const Rod<double>& rod, const double* /*q*/,
                       const Vector3d& g, double mass, const Vector3d& h, Matrix&& H) {
  H = fixed.rod->stiffness;
  rod.subtract_curvature(g, mass, h, H);
}

template <class Section>
void add_up_weight_hessian(const Chain& chain, const ChainState<Section>& state, const double* q,
                           MatrixRef& H) {
  using Matrix3m = typename Section::Matrix3m;
  const Vector3d& g = chain.gravity;
  double mass = chain.payload.mass;  // of all beyond this tip
  Vector3d h = state.tip.rotate(mass * chain.payload.position);
  for (Index i = chain.num_sections() - 1; i >= 0; --i) {
    const Section& section = state.sections[i];
    const SectionParameters& fixed = chain.sections[i];
    const Index at = chain.first[i], size = chain.first[i + 1] - at;
    differentiate_own(fixed, section, q + at, g, mass, h, H.block(at, at, size, size));
    Matrix3m pull;  // what turns with a coordinate pulls on the sections that carry it
    pull.resize(3, size);
    const Matrix3m coupling = section.linear_coupling();
    for (Index k = 0; k < size; ++k) {
      const Vector3d swing = Vector3d(section.J_omega.col(k)).cross(h);
      pull.col(k) = Vector3d(coupling.col(k) + mass * section.J_v.col(k) + swing).cross(g);
    }
    for (Index j = 0; j < i; ++j) {
      const Section& before = state.sections[j];
      const Index row = chain.first[j];
      for (Index c = 0; c < before.J_omega.cols(); ++c) {
        for (Index k = 0; k < size; ++k) {
          H(row + c, at + k) = H(at + k, row + c) = -before.J_omega.col(c).dot(pull.col(k));
        }
      }
    }
    h += mass * section.r + section.first_moment();
    mass += fixed.mass;
  }
}

/// Second derivatives (d, d) of the potential energy, cpp/derivatives.md eqs. (79), (80): O(d^2).
/// `state` needs its position alone.
template <class Section>
void weight_hessian(const Chain& chain, const ChainState<Section>& state, const double* q,
                    MatrixRef H) noexcept {
  with_fma<double>([&] { add_up_weight_hessian(chain, state, q, H); });
}

extern template void weight_hessian(const Chain&, const ArcChainState<double>&, const double*,
                                    MatrixRef) noexcept;
extern template void weight_hessian(const Chain&, const RodChainState<double>&, const double*,
                                    MatrixRef) noexcept;

}  // namespace cdcr::detail

// NOLINTEND(readability-identifier-naming)
