#pragma once

#include <array>

#include "section/arc.hpp"
#include "section/magnus.hpp"
#include "section/rod_parameters.hpp"

namespace cdcr::detail {

/// The frames along a rod in one state: functions of q that are differentiated as they stand, so
/// that a model made of them conserves its own energy (cpp/rods.md eqs. (52) to (57)).
template <class S>
struct RodFrames {
  static constexpr int m = Eigen::Dynamic, max_m = max_rod_coordinates;
  using Matrix3m = Eigen::Matrix<S, 3, m, Eigen::ColMajor, 3, max_m>;

  /// A point of the backbone beside the base; rates are those on a base at rest.
  struct Point {
    Vector3<S> t, r;        // tangent, and place from the base
    Matrix3m J_omega, J_v;  // omega = J_omega qd, v = J_v qd
    Vector3<S> omega, v;
    Vector3<S> omega_dot, v_dot;  // accelerations from velocities alone
  };
  FrameState<S> base;
  const RodParameters* rod = nullptr;
  std::array<Point, max_rod_nodes> points;
  Matrix3<S> axes;  // at the tip

  /// Places, tangents and Jacobians of all points.
  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* q) {
    rod = section.rod.get();
    base = at;
    const int size = rod->size(), n = rod->num_nodes();
    axes = base.rotation();
    // dr/dx and d2r/dx2 at the nodes, and how they change with q; the base does not turn.
    std::array<Vector3<S>, max_rod_nodes + 1> first, second;
    std::array<Matrix3m, max_rod_nodes + 1> J_first, J_second;
    for (int k = 0; k <= n; ++k) {
      if (k > 0) turn(*section.arcs, k - 1, q);
      const RodNode& node = rod->nodes[k];
      local[k] = strain_of(k, q);
      local[k].q_x += rod->locked_turning[1];
      local[k].q_y -= rod->locked_turning[0];
      const Strain& e = local[k];
      const auto x = axes.col(0), y = axes.col(1), z = axes.col(2);
      const S length = rod->length + e.stretch;
      first[k] = length * z;
      const Vector3<S> bent = e.q_x * x + e.q_y * y;
      second[k] = length * bent + e.stretch_slope * z;
      J_first[k].setZero(3, size);
      J_second[k].setZero(3, size);
      if (k > 0) {
        points[k - 1].t = z;
        for (int i = 0; i < rod->first_stretch; ++i) {
          const Vector3<S> turning = points[k - 1].J_omega.col(i);
          J_first[k].col(i) = turning.cross(first[k]);
          J_second[k].col(i) = turning.cross(second[k]);
        }
      }
      for (int i = 0; i < rod->num_bending; ++i) {
        J_second[k].col(2 * i) += (node.legendre[i] * length) * x;
        J_second[k].col(2 * i + 1) += (node.legendre[i] * length) * y;
      }
      for (int i = 0; i < rod->num_stretch; ++i) {
        const int column = rod->first_stretch + i;
        J_first[k].col(column) = node.legendre[i] * z;
        J_second[k].col(column) = node.legendre[i] * bent + node.legendre_slope[i] * z;
      }
    }
    for (int k = 0; k < n; ++k) {
      Point& point = points[k];
      if (k == 0) {
        point.r.setZero();
        point.J_v.setZero(3, size);
      } else {
        point.r = points[k - 1].r;
        point.J_v = points[k - 1].J_v;
      }
      int j = rod->nodes[k + 1].first_neighbour;
      for (const RodNode::Weight& weight : rod->nodes[k + 1].integral) {
        point.r += weight.value * first[j] + weight.slope * second[j];
        point.J_v += weight.value * J_first[j] + weight.slope * J_second[j];
        ++j;
      }
    }
  }

  /// Velocities of all points, and accelerations from velocities alone, on a base at rest.
  void move(const S* qd) {
    const int n = rod->num_nodes();
    Vector3<S> omega = Vector3<S>::Zero(), omega_dot = Vector3<S>::Zero();
    // First and second derivatives in time of dr/dx and d2r/dx2 at the nodes.
    std::array<Vector3<S>, max_rod_nodes + 1> first_1, first_2, second_1, second_2;
    for (int k = 0; k <= n; ++k) {
      if (k > 0) {
        turn_rates(k - 1, qd, omega, omega_dot);
        points[k - 1].omega = omega;
        points[k - 1].omega_dot = omega_dot;
      }
      const Matrix3<S>& here = k < n ? steps[k].from : axes;
      const auto x = here.col(0), y = here.col(1), z = here.col(2);
      const Strain &e = local[k], rate = strain_of(k, qd);
      const S length = rod->length + e.stretch;
      const Vector3<S> bent = e.q_x * x + e.q_y * y, bending = rate.q_x * x + rate.q_y * y;
      const auto differentiate = [&](const Vector3<S>& d, const Vector3<S>& local_1,
                                     const Vector3<S>& local_2, Vector3<S>& d_1, Vector3<S>& d_2) {
        const Vector3<S> swing = omega.cross(d);
        d_1 = swing + local_1;
        d_2 = omega_dot.cross(d) + omega.cross(Vector3<S>(swing + 2.0 * local_1)) + local_2;
      };
      differentiate(length * z, rate.stretch * z, Vector3<S>::Zero(), first_1[k], first_2[k]);
      differentiate(length * bent + e.stretch_slope * z,
                    length * bending + rate.stretch * bent + rate.stretch_slope * z,
                    (2.0 * rate.stretch) * bending, second_1[k], second_2[k]);
    }
    for (int k = 0; k < n; ++k) {
      Point& point = points[k];
      if (k == 0) {
        point.v.setZero();
        point.v_dot.setZero();
      } else {
        point.v = points[k - 1].v;
        point.v_dot = points[k - 1].v_dot;
      }
      int j = rod->nodes[k + 1].first_neighbour;
      for (const RodNode::Weight& weight : rod->nodes[k + 1].integral) {
        point.v += weight.value * first_1[j] + weight.slope * second_1[j];
        point.v_dot += weight.value * first_2[j] + weight.slope * second_2[j];
        ++j;
      }
    }
  }

 private:
  /// The rotation from one point to the next.
  struct Step {
    Magnus<S> magnus;
    Matrix3<S> from;  // axes where it begins
    ArcValues<S> f;   // of |Omega|^2
  };
  /// Strains at a node, or their rates.
  struct Strain {
    S q_x, q_y, stretch, stretch_slope;
  };
  std::array<Step, max_rod_nodes> steps;
  std::array<Strain, max_rod_nodes + 1> local;

  [[nodiscard]] Strain strain_of(int k, const S* q) const {
    const RodNode& node = rod->nodes[k];
    Strain e{S(0.0), S(0.0), S(0.0), S(0.0)};
    for (int i = 0; i < rod->num_bending; ++i) {
      e.q_x += node.legendre[i] * q[2 * i];
      e.q_y += node.legendre[i] * q[2 * i + 1];
    }
    for (int i = 0; i < rod->num_stretch; ++i) {
      e.stretch += node.legendre[i] * q[rod->first_stretch + i];
      e.stretch_slope += node.legendre_slope[i] * q[rod->first_stretch + i];
    }
    return e;
  }

  /// Sum of u_j = (-q_y, q_x, t) of order j times these weights.
  [[nodiscard]] Vector3<S> turning_of(const LegendreValues& weight, const S* q) const {
    Vector3<S> u = Vector3<S>::Zero();
    for (int j = 0; j < rod->num_bending; ++j) {
      u[0] -= weight[j] * q[2 * j + 1];
      u[1] += weight[j] * q[2 * j];
    }
    for (int j = 0; j < rod->num_twist; ++j) u[2] += weight[j] * q[rod->first_twist + j];
    return u;
  }

  /// Turns `axes` from the point before to point k, and tells how they turn with q there.
  void turn(const ArcTable& arcs, int k, const S* q) {
    const auto& weight = rod->nodes[k + 1].step;
    Step& step = steps[k];
    const Vector3<S> locked = rod->locked_turning.template cast<S>();
    const auto turning = [&](std::size_t i) -> Vector3<S> {
      return turning_of(weight[i], q) + weight[i][0] * locked;
    };
    step.magnus = Magnus<S>(turning(0), turning(1), turning(2));
    step.from = axes;
    const Vector3<S>& Omega = step.magnus.Omega;
    read(arcs, S(Omega.squaredNorm()), step.f);
    const S A = step.f[arc_a], G = step.f[arc_g], sine = step.f[arc_s];
    // R [Omega] and R [Omega]^2, row by row.
    Matrix3<S> once, twice;
    for (int c = 0; c < 3; ++c) {
      const Vector3<S> row = axes.row(c).transpose();
      const Vector3<S> turned = row.cross(Omega);
      once.row(c) = turned.transpose();
      twice.row(c) = turned.cross(Omega).transpose();
    }
    const Matrix3<S> tangent = axes + A * once + G * twice;
    axes += sine * once + A * twice;

    std::array<Matrix3<S>, 3> slope;
    step.magnus.slopes(slope);
    for (Matrix3<S>& one : slope) one = tangent.lazyProduct(one).eval();
    Matrix3m& J = points[k].J_omega;
    if (k == 0) {
      J.setZero(3, rod->size());
    } else {
      J = points[k - 1].J_omega;
    }
    const auto about = [&](int axis, int j) -> Vector3<S> {
      return weight[0][j] * slope[0].col(axis) + weight[1][j] * slope[1].col(axis) +
             weight[2][j] * slope[2].col(axis);
    };
    for (int j = 0; j < rod->num_bending; ++j) {
      J.col(2 * j) += about(1, j);
      J.col(2 * j + 1) -= about(0, j);
    }
    for (int j = 0; j < rod->num_twist; ++j) J.col(rod->first_twist + j) += about(2, j);
  }

  /// From omega and its rate at the point before to those at point k.
  void turn_rates(int k, const S* qd, Vector3<S>& omega, Vector3<S>& omega_dot) const {
    const auto& weight = rod->nodes[k + 1].step;
    const Step& step = steps[k];
    Vector3<S> first, second;
    step.magnus.rates(turning_of(weight[0], qd), turning_of(weight[1], qd),
                      turning_of(weight[2], qd), first, second);
    const Vector3<S>& Omega = step.magnus.Omega;
    const S A = step.f[arc_a], G = step.f[arc_g], growth = 2.0 * Omega.dot(first);
    const Vector3<S> across = Omega.cross(first), again = Omega.cross(across),
                     across_2 = Omega.cross(second);
    const Vector3<S> turning = step.from * (first + A * across + G * again);
    const Vector3<S> turning_dot =
        step.from * (second + A * across_2 + G * (Omega.cross(across_2) + first.cross(across)) +
                     growth * (step.f[arc_da] * across + step.f[arc_dg] * again));
    omega_dot += omega.cross(turning) + turning_dot;
    omega += turning;
  }
};

}  // namespace cdcr::detail
