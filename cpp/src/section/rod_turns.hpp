#pragma once

#include <array>

#include "section/arc.hpp"
#include "section/magnus.hpp"
#include "section/pair.hpp"
#include "section/rod_parameters.hpp"

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result): counts of rows and coordinates,
// all small

namespace cdcr::detail {

/// Vectors at the frames or nodes of a rod, as many as there are lanes worked on at once.
template <class S>
struct Vectors {
  using L = Lanes<S>;
  static constexpr int max = max_rod_nodes;
  std::array<S, max> x, y, z;

  [[nodiscard]] Vector3<typename L::Pack> load(int k) const {
    return {L::load(&x[k]), L::load(&y[k]), L::load(&z[k])};
  }
  [[nodiscard]] Vector3<S> get(int k) const { return {x[k], y[k], z[k]}; }
  void store(int k, const Vector3<typename L::Pack>& v) {
    L::store(v[0], &x[k]);
    L::store(v[1], &y[k]);
    L::store(v[2], &z[k]);
  }
  void set(int k, const Vector3<S>& v) {
    x[k] = v[0];
    y[k] = v[1];
    z[k] = v[2];
  }
};
/// Axes of frames.
template <class S>
struct FrameAxes {
  Vectors<S> x, y, z;

  void set(int k, const Matrix3<S>& axes) {
    x.set(k, axes.col(0));
    y.set(k, axes.col(1));
    z.set(k, axes.col(2));
  }
};

/// A, S, G of |Omega|^2 and the derivatives of A and G.
template <class T>
struct TurnFunctions {
  T A, sine, G, dA, dG;
};

/// The rotations along a rod, from frame to frame in steps, cpp/rods.md eqs. (54) to (56). Steps do
/// not need one another until their rotations are multiplied, so two are worked on at once.
template <class S>
class RodTurns {
  using L = Lanes<S>;
  using Pack = typename L::Pack;

 public:
  /// From the axes at the base to those at the tip, which are given; those at the frames go to
  /// `frames`.
  Matrix3<S> update_position(const RodParameters& rod, const ArcTable& arcs, Matrix3<S> axes,
                             const S* q, FrameAxes<S>& frames);

  /// What each step adds to J_omega: rows of x, y and z, `width` apart.
  void slopes(const RodParameters& rod, S* columns, int width) const;

  /// Second derivatives of moment.(R T dOmega) of the steps from s on with respect to their alphas,
  /// at a constant moment and R.
  [[nodiscard]] Eigen::Matrix<Pack, 9, 9> curvature(int s, const Vector3<Pack>& moment) const;

  /// omega of the frames and its rate from velocities alone.
  void rates(const RodParameters& rod, const S* qd, Vectors<S>& omega_at,
             Vectors<S>& omega_dot_at) const;

 private:
  static constexpr int max_packs = max_rod_steps / L::count;

  struct Step {
    Magnus<Pack> magnus;
    Matrix3<Pack> from;  // axes where it begins
    TurnFunctions<Pack> f;
  };
  std::array<Step, max_packs> steps_;

  /// alpha_i of a step.
  [[nodiscard]] static Vector3<Pack> turning_of(const RodParameters& rod, int i, int s, const S* q);

  /// along 1 + across [Omega] + outer Omega Omega^T.
  [[nodiscard]] static Matrix3<Pack> turn(const Pack& along, const Pack& across, const Pack& outer,
                                          const Vector3<Pack>& Omega);

  /// By H = (1/2 - A)/sigma and K = (1/6 - G)/sigma, whose series end where the next power is below
  /// rounding; from the table beyond.
  static void read(const ArcTable& arcs, const Pack& sigma, TurnFunctions<Pack>& f);
  static constexpr int last_power = 20;
  static constexpr std::array<double, last_power + 2> inverse_factorials = [] {
    std::array<double, last_power + 2> values{1.0};
    double factorial = 1.0;
    for (int n = 1; n < last_power + 2; ++n) values[n] = 1.0 / (factorial *= n);
    return values;
  }();

  static void read_table(const ArcTable& arcs, const Pack& sigma, TurnFunctions<Pack>& f);
};

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
