#pragma once

#include <array>

#include "section/rod_turns.hpp"

namespace cdcr::detail {

#if defined(__x86_64__)
#define CDCR_FMA 1
inline const bool has_fma = __builtin_cpu_supports("fma") != 0;

template <class F, class Width>
[[gnu::target("fma"), gnu::flatten]] void run_with_fma(const F& f, Width width) {
  f(width);
}
#endif

template <class F, class Width>
void run(const F& f, Width width) {
#ifdef CDCR_FMA
  if (has_fma) return run_with_fma(f, width);
#endif
  f(width);
}

/// f(width) for a number of coordinates: of doubles with the least width known to the compiler that
/// holds them; columns beyond are zero.
template <class S, class F>
void with_width(int size, const F& f) {
  if constexpr (Lanes<S>::count == 1) {
    f(size);
  } else {
    if (size <= 4) return run(f, std::integral_constant<int, 4>());
    if (size <= 8) return run(f, std::integral_constant<int, 8>());
    if (size <= 12) return run(f, std::integral_constant<int, 12>());
    if (size <= 16) return run(f, std::integral_constant<int, 16>());
    run(f, std::integral_constant<int, 20>());
  }
}

/// Frames and nodes along a rod in one state: functions of q that are differentiated as they stand,
/// so that a model made of them conserves its own energy (cpp/rods.md eqs. (52) to (57)).
///
/// Jacobians are rows of one number for each coordinate, `width` apart: three for J_v of each node,
/// then three for J_omega of each frame but the base, then one for t^T J_omega of each of these.
template <class S>
struct RodFrames {
  static constexpr int m = Eigen::Dynamic, max_m = max_rod_coordinates;
  using Matrix3m = Eigen::Matrix<S, 3, m, Eigen::ColMajor, 3, max_m>;

  FrameState<S> base;
  const RodParameters* rod = nullptr;
  Matrix3<S> axes;        // at the tip
  Vector3<S> r;           // from base to tip
  Matrix3m J_omega, J_v;  // of the tip: omega = J_omega qd, v = J_v qd on a base at rest

  /// Frames, places and Jacobians of all points.
  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* q) {
    rod = section.rod.get();
    base = at;
    with_width<S>(rod->size(), [&](auto width) {
      axes = turns.update_position(*rod, *section.arcs, base.rotation(), q);
      turn(width);
      integrate(width, q);
      const int size = rod->size();
      J_omega.resize(3, size);
      J_v.resize(3, size);
      const S *on_omega = turning_rows(width) + 3 * (rod->num_frames() - 1) * width,
              *on_v = rows.data() + 3 * (rod->num_nodes() - 1) * width;
      for (int i = 0; i < size; ++i) {
        for (int c = 0; c < 3; ++c) {
          J_omega(c, i) = on_omega[c * width + i];
          J_v(c, i) = on_v[c * width + i];
        }
      }
    });
    r = places[rod->num_nodes() - 1];
  }

 protected:
  /// Of a frame; omega and its rate from velocities alone on a base at rest.
  struct Turning {
    Vector3<S> t, omega, omega_dot;
  };
  /// Of a node, the same.
  struct Moving {
    Vector3<S> v, v_dot;
  };
  std::array<S, (3 * max_rod_nodes + 4 * (max_rod_frames - 1)) * max_m> rows;
  std::array<Vector3<S>, max_rod_nodes> places;
  std::array<Turning, max_rod_frames> turning;  // the first is that of the base
  std::array<Moving, max_rod_nodes> moving;

  template <class Width>
  [[nodiscard]] const S* turning_rows(Width width) const {
    return rows.data() + 3 * rod->num_nodes() * width;
  }
  template <class Width>
  [[nodiscard]] const S* spin_rows(Width width) const {
    return turning_rows(width) + 3 * rod->num_frames() * width;
  }

  /// Velocities of all points, and accelerations from velocities alone, on a base at rest.
  void move(const S* qd) {
    const std::vector<RodFrame>& frames = rod->rule.frames;
    turning[0].omega.setZero();
    turning[0].omega_dot.setZero();
    Vector3<S> omega = Vector3<S>::Zero(), omega_dot = omega;
    int k = 1;
    turns.rates(*rod, qd, [&](int s, const Vector3<S>& turned, const Vector3<S>& rate) {
      omega_dot += omega.cross(turned) + rate;
      omega += turned;
      if (k < static_cast<int>(frames.size()) && s + 1 == frames[k].steps_before) {
        turning[k].omega = omega;
        turning[k].omega_dot = omega_dot;
        ++k;
      }
    });
    // First and second derivatives in time of dr/dx and d2r/dx2 at the frames, and their integrals.
    std::array<std::array<S, 12>, max_rod_frames> rates;
    for (k = 0; k < static_cast<int>(frames.size()); ++k) {
      const Matrix3<S> R = axes_at(k);
      const auto x = R.col(0), y = R.col(1), z = R.col(2);
      const Strain &e = strain[k], rate = strain_of(frames[k], qd);
      const S length = rod->length + e.stretch;
      const Vector3<S> bent = e.q_x * x + e.q_y * y, bending = rate.q_x * x + rate.q_y * y;
      const Vector3<S>&w = turning[k].omega, &w_dot = turning[k].omega_dot;
      const auto differentiate = [&](S* to, const Vector3<S>& d, const Vector3<S>& local_1,
                                     const Vector3<S>& local_2) {
        const Vector3<S> swing = w.cross(d);
        Eigen::Map<Vector3<S>> first(to), second(to + 3);
        first = swing + local_1;
        second = w_dot.cross(d) + w.cross(Vector3<S>(swing + 2.0 * local_1)) + local_2;
      };
      differentiate(rates[k].data(), length * z, rate.stretch * z, Vector3<S>::Zero());
      differentiate(rates[k].data() + 6, length * bent + e.stretch_slope * z,
                    length * bending + rate.stretch * bent + rate.stretch_slope * z,
                    (2.0 * rate.stretch) * bending);
    }
    std::array<S, 6> sum{};
    sum.fill(S(0.0));
    for (k = 0; k < rod->num_nodes(); ++k) {
      const RodNode& node = rod->rule.nodes[k];
      for (int j = 0; j < num_neighbours; ++j) {
        const auto& weight = node.integral[j];
        const auto& rate = rates[node.first_neighbour + j];
        for (int i = 0; i < 6; ++i) sum[i] += weight.value * rate[i] + weight.slope * rate[6 + i];
      }
      moving[k] = {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}};
    }
  }

 private:
  /// Strains at a frame, or their rates.
  struct Strain {
    S q_x, q_y, stretch, stretch_slope;
  };
  RodTurns<S> turns;
  std::array<Strain, max_rod_frames> strain;

  [[nodiscard]] Strain strain_of(const RodFrame& frame, const S* q) const {
    Strain e{S(0.0), S(0.0), S(0.0), S(0.0)};
    for (int i = 0; i < rod->num_bending; ++i) {
      e.q_x += frame.legendre[i] * q[2 * i];
      e.q_y += frame.legendre[i] * q[2 * i + 1];
    }
    for (int i = 0; i < rod->num_stretch; ++i) {
      e.stretch += frame.legendre[i] * q[rod->first_stretch + i];
      e.stretch_slope += frame.legendre_slope[i] * q[rod->first_stretch + i];
    }
    return e;
  }

  [[nodiscard]] Matrix3<S> axes_at(int frame) const {
    return frame < rod->num_frames() ? turns.axes_before(rod->rule.frames[frame].steps_before)
                                     : axes;
  }

  /// J_omega of all frames.
  template <class Width>
  void turn(Width width) {
    constexpr int max_width = std::is_same_v<Width, int> ? max_m : int(Width());
    std::array<S, 3 * max_width * max_rod_steps> columns;
    const int count = rod->rule.steps.count;
    for (int s = 0; s < count; ++s) {
      for (int c = 0; c < 3; ++c) {
        for (int i = rod->first_stretch; i < width; ++i) {
          columns[(3 * s + c) * width + i] = S(0.0);
        }
      }
    }
    turns.slopes(*rod, [&](int s, int i, const Vector3<S>& column) {
      for (int c = 0; c < 3; ++c) columns[(3 * s + c) * width + i] = column[c];
    });
    S *J = rows.data() + 3 * rod->num_nodes() * width, *spin = J + 3 * rod->num_frames() * width;
    std::array<S, 3 * max_width> sum{};
    for (int i = 0; i < 3 * width; ++i) sum[i] = S(0.0);
    int s = 0;
    for (int k = 1; k <= rod->num_frames(); ++k) {
      for (; s < rod->rule.frames[k].steps_before; ++s) {
        for (int i = 0; i < 3 * width; ++i) sum[i] += columns[3 * s * width + i];
      }
      for (int i = 0; i < 3 * width; ++i) J[i] = sum[i];
      const Vector3<S> t = axes_at(k).col(2);
      turning[k].t = t;
      for (int i = 0; i < width; ++i) {
        spin[i] = t[0] * sum[i] + t[1] * sum[width + i] + t[2] * sum[2 * width + i];
      }
      J += 3 * width;
      spin += width;
    }
  }

  /// Places of all nodes, and J_v.
  template <class Width>
  void integrate(Width width, const S* q) {
    constexpr int max_width = std::is_same_v<Width, int> ? max_m : int(Width());
    // dr/dx and d2r/dx2 at the frames, and how they change with q; the base does not turn.
    std::array<std::array<S, 6>, max_rod_frames> d;
    std::array<S, 6 * max_width * max_rod_frames> J;
    for (int k = 0; k <= rod->num_frames(); ++k) {
      const RodFrame& frame = rod->rule.frames[k];
      strain[k] = strain_of(frame, q);
      strain[k].q_x += rod->locked_turning[1];
      strain[k].q_y -= rod->locked_turning[0];
      const Strain& e = strain[k];
      const Matrix3<S> R = axes_at(k);
      const auto x = R.col(0), y = R.col(1), z = R.col(2);
      const S length = rod->length + e.stretch;
      const Vector3<S> bent = e.q_x * x + e.q_y * y;
      const Vector3<S> first = length * z, second = length * bent + e.stretch_slope * z;
      d[k] = {first[0], first[1], first[2], second[0], second[1], second[2]};
      S *J_first = J.data() + 6 * k * width, *J_second = J_first + 3 * width;
      if (k == 0) {
        for (int i = 0; i < 6 * width; ++i) J_first[i] = S(0.0);
      } else {
        const S* W = turning_rows(width) + 3 * (k - 1) * width;
        for (int c = 0; c < 3; ++c) {
          const int a = (c + 1) % 3, b = (c + 2) % 3;
          for (int i = 0; i < width; ++i) {
            J_first[c * width + i] = W[a * width + i] * first[b] - W[b * width + i] * first[a];
            J_second[c * width + i] = W[a * width + i] * second[b] - W[b * width + i] * second[a];
          }
        }
      }
      for (int i = 0; i < rod->num_bending; ++i) {
        const S share = frame.legendre[i] * length;
        for (int c = 0; c < 3; ++c) {
          J_second[c * width + 2 * i] += share * x[c];
          J_second[c * width + 2 * i + 1] += share * y[c];
        }
      }
      for (int i = 0; i < rod->num_stretch; ++i) {
        const int column = rod->first_stretch + i;
        for (int c = 0; c < 3; ++c) {
          J_first[c * width + column] = frame.legendre[i] * z[c];
          J_second[c * width + column] =
              frame.legendre[i] * bent[c] + frame.legendre_slope[i] * z[c];
        }
      }
    }
    Vector3<S> place = Vector3<S>::Zero();
    std::array<S, 3 * max_width> sums;
    for (int i = 0; i < 3 * width; ++i) sums[i] = S(0.0);
    for (int k = 0; k < rod->num_nodes(); ++k) {
      const RodNode& node = rod->rule.nodes[k];
      const std::array<RodNode::Weight, num_neighbours> weights = node.integral;
      for (int j = 0; j < num_neighbours; ++j) {
        const auto& from = d[node.first_neighbour + j];
        for (int c = 0; c < 3; ++c) {
          place[c] += weights[j].value * from[c] + weights[j].slope * from[3 + c];
        }
      }
      places[k] = place;
      const S* from = J.data() + 6 * node.first_neighbour * width;
      S* to = rows.data() + 3 * k * width;
      for (int i = 0; i < 3 * width; i += Lanes<S>::count) {
        auto sum = Lanes<S>::load(sums.data() + i);
        for (int j = 0; j < num_neighbours; ++j) {
          sum += weights[j].value * Lanes<S>::load(from + 6 * j * width + i) +
                 weights[j].slope * Lanes<S>::load(from + (6 * j + 3) * width + i);
        }
        Lanes<S>::store(sum, sums.data() + i);
        Lanes<S>::store(sum, to + i);
      }
    }
  }
};

}  // namespace cdcr::detail
