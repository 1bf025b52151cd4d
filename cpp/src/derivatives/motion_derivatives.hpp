#pragma once

#include <algorithm>
#include <type_traits>
#include <variant>
#include <vector>

#include "chain/chain.hpp"
#include "derivatives/cholesky.hpp"
#include "derivatives/dual.hpp"
#include "derivatives/lane_map.hpp"
#include "derivatives/outboard.hpp"
#include "section/width.hpp"

// NOLINTBEGIN(readability-identifier-naming): letters of the equations

namespace cdcr::detail {

/// Accelerations of a chain and how they change with its state, cpp/derivatives.md eqs. (71) to
/// (80). Derivatives with respect to q and qd stand in lanes, four to a Quad, as `lanes` says;
/// those to commands after them.
///
/// A section is differentiated by itself, on dual numbers, with respect to its own coordinates.
/// Recursions do the rest, since what it carries turns and moves as one piece: O(d^2), but for the
/// solution with the mass matrix. Set-up allocates; the functions do not.
template <template <class> class Kind>
class MotionDerivatives {
 public:
  using Section = Kind<double>;
  using DualSection = Kind<Dual>;

  MotionDerivatives(const Chain& chain, Index num_commands);

  /// Accelerations under a generalised force; rows become the derivatives of -(M qdd + h) at
  /// constant qdd, with zeros for commands. `state` is that of q and qd.
  void update(const Chain& chain, const ChainState<Section>& state, const double* q,
              const double* qd, const double* force) noexcept;
  /// Derivatives of the force and the moment of inertia and weight on the base, at accelerations,
  /// with respect to q, qd and qdd, (6, 3d), cpp/base-wrench.md eq. (124). Rows are lost.
  void differentiate_base(const Chain& chain, const ChainState<Section>& state, const double* q,
                          const double* qd, const double* accelerations, MatrixRef slopes) noexcept;
  /// Multiplies by M^-1 the first `width` quads of all rows.
  void solve(Index width) noexcept;

  /// Multiplies a vector by M^-1.
  void solve(double* x) const noexcept {
    with_fma<double>([&] { mass_.solve(x); });
  }
  /// Sets all rows to zero.
  void clear() noexcept { std::fill(rows.begin(), rows.end(), Quad(0.0)); }

  /// What stands in the lanes of a row.
  [[nodiscard]] const double* row(Index i) const noexcept {
    return reinterpret_cast<const double*>(rows.data() + i * lanes.width());
  }

  LaneMap lanes;
  std::vector<Quad> rows;  ///< (d, lanes.width())
  VectorXd qdd;
  DualSection dual;  ///< room for one section at a time

 private:
  using Matrix3m = typename Section::Matrix3m;
  using Vectorm = typename Section::Vectorm;
  using Columns = Eigen::Matrix3Xd;

  /// Of one section: accelerations of its base, motion of its tip, and how fast that moves beside
  /// the base.
  struct Body {
    Vector3d alpha, a, tip_alpha, tip_a, tip_omega, moving;
  };
  /// Variation of force and moment on a base.
  struct Load {
    Vector3<Quad> F, T;
  };
  /// What a section is differentiated with.
  struct Inputs {
    FrameState<Dual> base;
    std::array<Dual, Section::max_m> q, qd;
  };
  /// Slopes, in the lanes of one quad, of the force on q, of force and moment on the base, and of
  /// what the tip does.
  struct OwnSlopes {
    std::array<Quad, Section::max_m> force;
    Vector3<Quad> push, twist, tip_alpha, tip_a, tip_omega;

    void clear() {
      force.fill(Quad(0.0));
      for (Vector3<Quad>* v : {&push, &twist, &tip_alpha, &tip_a, &tip_omega}) v->setZero();
    }
  };
  // Whether rates are not differentiated on dual numbers: many coordinates cost many of these.
  static constexpr bool rates_apart = Section::m == Eigen::Dynamic;

  void add_up_mass(const Chain& chain, const ChainState<Section>& state);
  void accelerate(const Chain& chain, const ChainState<Section>& state, const double* qd);
  void differentiate_inwards(const Chain& chain, const ChainState<Section>& state, const double* q,
                             const double* qd, bool base = false);
  void carry_loads(const Chain& chain, const Section& section, Index i);
  void set_gyros(const Section& section, const Outboard& outboard, Index i, Index first,
                 Index size);
  template <bool turns>
  void differentiate_section(const Chain& chain, const Section& section, Index i, const double* q,
                             const double* qd, const Outboard& outboard, Matrix3d& J_own);
  template <bool turns>
  void differentiate_by_rate(const SectionParameters& fixed, const Section& section,
                             const Vectorm& qd, Index k, int lane, OwnSlopes& slopes);
  void differentiate_outwards(const Chain& chain, const ChainState<Section>& state);
  void clear_commands();

  Cholesky mass_;
  std::conditional_t<rates_apart, Section, std::monostate> moved_;  // at other rates
  std::vector<Body> bodies_;
  // What accelerations of a coordinate, and turning rates beside it, ask of its section's base,
  // eqs. (77), (78).
  Columns pushes_, twists_, gyros_;
  std::vector<Motion> motions_;
  std::vector<Load> loads_;
};

extern template class MotionDerivatives<ConstantCurvature>;
extern template class MotionDerivatives<Rod>;

}  // namespace cdcr::detail

// NOLINTEND(readability-identifier-naming)
