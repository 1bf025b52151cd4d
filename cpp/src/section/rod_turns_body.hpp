#pragma once

#include "section/rod_turns.hpp"

// Bodies of RodTurns.

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result): counts of rows and coordinates,
// all small

namespace cdcr::detail {

template <class S>
auto RodTurns<S>::update_position(const RodParameters& rod, const ArcTable& arcs, Matrix3<S> axes,
                                  const S* q, FrameAxes<S>& frames) -> Matrix3<S> {
  const int count = rod.rule.steps.count;
  std::array<Matrix3<Pack>, max_packs> turns;
  for (int p = 0, s = 0; s < count; ++p, s += L::count) {
    Step& step = steps_[p];
    Vector3<Pack> whole = turning_of(rod, 0, s, q);
    for (int c = 0; c < 3; ++c) {
      whole[c] += L::weights(&rod.rule.steps.weights[0][0][s]) * S(rod.locked_turning[c]);
    }
    step.magnus = Magnus<Pack>(whole, turning_of(rod, 1, s, q), turning_of(rod, 2, s, q));
    const Vector3<Pack>& Omega = step.magnus.Omega;
    read(arcs, Omega.squaredNorm(), step.f);
    turns[p] = turn(1.0 - Omega.squaredNorm() * step.f.A, step.f.sine, step.f.A, Omega);
  }
  frames.set(0, axes);
  int k = 1;
  for (int p = 0; p < count / L::count; ++p) {
    const Matrix3<Pack>& by = turns[p];
    L::each([&](auto lane) {
      for (int i = 0; i < 9; ++i) L::set(steps_[p].from(i), lane, axes(i));
      for (int c = 0; c < 3; ++c) {
        const S x = axes(c, 0), y = axes(c, 1), z = axes(c, 2);
        for (int j = 0; j < 3; ++j) {
          axes(c, j) =
              x * L::get(by(0, j), lane) + y * L::get(by(1, j), lane) + z * L::get(by(2, j), lane);
        }
      }
      if (k <= rod.num_frames() && p * L::count + lane + 1 == rod.rule.frames[k].steps_before) {
        frames.set(k++, axes);
      }
    });
  }
  return axes;
}

template <class S>
void RodTurns<S>::slopes(const RodParameters& rod, S* columns, int width) const {
  const RodSteps& rule = rod.rule.steps;
  for (int p = 0, s = 0; s < rule.count; ++p, s += L::count) {
    const Step& step = steps_[p];
    const Matrix3<Pack> tangent =
        step.from.lazyProduct(turn(step.f.sine, step.f.A, step.f.G, step.magnus.Omega));
    std::array<Matrix3<Pack>, 3> slope;
    step.magnus.slopes(slope);
    const auto about = [&](int axis, int j) -> Vector3<Pack> {
      Vector3<Pack> sum = L::weights(&rule.weights[0][j][s]) * slope[0].col(axis);
      for (int i = 1; i <= j && i < 3; ++i) {
        sum += L::weights(&rule.weights[i][j][s]) * slope[i].col(axis);
      }
      return tangent.lazyProduct(sum);
    };
    S* to = columns + 3 * s * width;
    for (int j = 0; j < rod.num_bending; ++j) {
      const Vector3<Pack> x = about(1, j), y = -about(0, j);
      for (int c = 0; c < 3; ++c) L::store(x[c], y[c], to + c * width + 2 * j, 3 * width);
    }
    for (int j = 0; j < rod.num_twist; ++j) {
      const Vector3<Pack> z = about(2, j);
      L::each([&](auto lane) {
        for (int c = 0; c < 3; ++c) {
          to[(3 * lane + c) * width + rod.first_twist + j] = L::get(z[c], lane);
        }
      });
    }
  }
}

template <class S>
void RodTurns<S>::rates(const RodParameters& rod, const S* qd, Vectors<S>& omega_at,
                        Vectors<S>& omega_dot_at) const {
  Vector3<S> omega = Vector3<S>::Zero(), omega_dot = omega;
  omega_at.set(0, omega);
  omega_dot_at.set(0, omega);
  int k = 1;
  for (int p = 0, s = 0; s < rod.rule.steps.count; ++p, s += L::count) {
    const Step& step = steps_[p];
    const auto& f = step.f;
    Vector3<Pack> first, second;
    step.magnus.rates(turning_of(rod, 0, s, qd), turning_of(rod, 1, s, qd),
                      turning_of(rod, 2, s, qd), first, second);
    const Vector3<Pack>& Omega = step.magnus.Omega;
    const Pack growth = 2.0 * Omega.dot(first);
    const Vector3<Pack> across = Omega.cross(first), again = Omega.cross(across),
                        across_2 = Omega.cross(second);
    const Vector3<Pack> turning = first + f.A * across + f.G * again;
    const Vector3<Pack> rate = second + f.A * across_2 +
                               f.G * (Omega.cross(across_2) + first.cross(across)) +
                               growth * (f.dA * across + f.dG * again);
    const Vector3<Pack> turned = step.from.lazyProduct(turning),
                        turned_rate = step.from.lazyProduct(rate);
    L::each([&](auto lane) {
      const auto at = [lane](const Vector3<Pack>& v) {
        return Vector3<S>(L::get(v[0], lane), L::get(v[1], lane), L::get(v[2], lane));
      };
      omega_dot += omega.cross(at(turned)) + at(turned_rate);
      omega += at(turned);
      if (k <= rod.num_frames() && s + lane + 1 == rod.rule.frames[k].steps_before) {
        omega_at.set(k, omega);
        omega_dot_at.set(k++, omega_dot);
      }
    });
  }
}

template <class S>
auto RodTurns<S>::turning_of(const RodParameters& rod, int i, int s, const S* q) -> Vector3<Pack> {
  const auto& weights = rod.rule.steps.weights[i];
  Vector3<Pack> u = Vector3<Pack>::Zero();
  for (int j = i; j < rod.num_bending; ++j) {
    const auto weight = L::weights(&weights[j][s]);
    u[0] -= weight * q[2 * j + 1];
    u[1] += weight * q[2 * j];
  }
  for (int j = i; j < rod.num_twist; ++j) {
    u[2] += L::weights(&weights[j][s]) * q[rod.first_twist + j];
  }
  return u;
}

template <class S>
auto RodTurns<S>::turn(const Pack& along, const Pack& across, const Pack& outer,
                       const Vector3<Pack>& Omega) -> Matrix3<Pack> {
  const Vector3<Pack> scaled = outer * Omega, x = across * Omega;
  Matrix3<Pack> M = scaled * Omega.transpose();
  M(0, 0) += along;
  M(1, 1) += along;
  M(2, 2) += along;
  M(0, 1) -= x[2];
  M(0, 2) += x[1];
  M(1, 0) += x[2];
  M(1, 2) -= x[0];
  M(2, 0) -= x[1];
  M(2, 1) += x[0];
  return M;
}

template <class S>
void RodTurns<S>::read(const ArcTable& arcs, const Pack& sigma, TurnFunctions<Pack>& f) {
  for (int lane = 0; lane < L::count; ++lane) {
    if (!(L::get(sigma, lane) <= 2.5)) {
      read_table(arcs, sigma, f);
      return;
    }
  }
  Pack H(inverse_factorials[last_power]), K(inverse_factorials[last_power + 1]);
  for (int k = last_power - 2; k >= 4; k -= 2) {
    H = inverse_factorials[k] - sigma * H;
    K = inverse_factorials[k + 1] - sigma * K;
  }
  f.A = 0.5 - sigma * H;
  f.G = 1.0 / 6.0 - sigma * K;
  f.sine = 1.0 - sigma * f.G;
  f.dA = H - 0.5 * f.G;
  f.dG = 1.5 * K - 0.5 * H;
}

template <class S>
void RodTurns<S>::read_table(const ArcTable& arcs, const Pack& sigma, TurnFunctions<Pack>& f) {
  for (int lane = 0; lane < L::count; ++lane) {
    ArcValues<S> values;
    read_arcs(arcs, S(L::get(sigma, lane)), values);
    L::set(f.A, lane, values[arc_a]);
    L::set(f.sine, lane, values[arc_s]);
    L::set(f.G, lane, values[arc_g]);
    L::set(f.dA, lane, values[arc_da]);
    L::set(f.dG, lane, values[arc_dg]);
  }
}

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
