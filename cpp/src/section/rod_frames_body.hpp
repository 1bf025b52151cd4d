#pragma once

#include "section/rod_frames.hpp"
#include "section/rod_turns_body.hpp"

// Bodies of RodFrames.

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming):
// counts of rows and coordinates, all small

namespace cdcr::detail {

template <class S>
void RodFrames<S>::update_position(const SectionParameters& section, const FrameState<S>& at,
                                   const S* q) {
  rod = section.rod.get();
  base = at;
  with_width<S>(rod->size(), [&](auto width) {
    axes = turns.update_position(*rod, *section.arcs, base.rotation(), q, axes_at);
    turn(width);
    integrate(width, q);
    copy(width, turning_rows(width, rod->num_frames()), J_omega);
    copy(width, node_rows(width, rod->num_nodes() - 1), J_v);
  });
  r = places.get(rod->num_nodes() - 1);
}

template <class S>
void RodFrames<S>::move(const S* qd) {
  turns.rates(*rod, qd, omega_at, omega_dot_at);
  // Of dr/dx the first and second derivatives in time, then of d2r/dx2.
  alignas(row_alignment) std::array<S, 16 * (max_rod_frames + 1)> rates;
  for (int k = 0; k <= rod->num_frames(); k += L::count) {
    const auto x = axes_at.x.load(k), y = axes_at.y.load(k), z = axes_at.z.load(k);
    const Strain &e = strain[k / L::count], rate = strain_of(k, qd);
    const Pack length = rod->length + e.stretch;
    const Vector3<Pack> bent = e.q_x * x + e.q_y * y, bending = rate.q_x * x + rate.q_y * y;
    const Vector3<Pack> w = omega_at.load(k), w_dot = omega_dot_at.load(k);
    const auto differentiate = [&](S* to, const Vector3<Pack>& d, const Vector3<Pack>& local_1,
                                   const Vector3<Pack>& local_2) {
      const Vector3<Pack> swing = w.cross(d), first = swing + local_1;
      const Vector3<Pack> second =
          w_dot.cross(d) + w.cross(Vector3<Pack>(swing + 2.0 * local_1)) + local_2;
      put(first, to, 16);
      put(second, to + 4, 16);
    };
    S* to = rates.data() + 16 * k;
    differentiate(to, length * z, rate.stretch * z, Vector3<Pack>::Zero());
    differentiate(to + 8, length * bent + e.stretch_slope * z,
                  length * bending + rate.stretch * bent + rate.stretch_slope * z,
                  (2.0 * rate.stretch) * bending);
  }
  integrate_rows<8>(rates.data(), [&](int k, const S* sum) {
    v_at.set(k, {sum[0], sum[1], sum[2]});
    v_dot_at.set(k, {sum[4], sum[5], sum[6]});
  });
}

template <class S>
auto RodFrames<S>::strain_of(int k, const S* q) const -> Strain {
  const RodRule& rule = rod->rule;
  Strain e{Pack(0.0), Pack(0.0), Pack(0.0), Pack(0.0)};
  for (int i = 0; i < rod->num_bending; ++i) {
    const auto weight = L::weights(&rule.legendre[i][k]);
    e.q_x += weight * q[2 * i];
    e.q_y += weight * q[2 * i + 1];
  }
  for (int i = 0; i < rod->num_stretch; ++i) {
    e.stretch += L::weights(&rule.legendre[i][k]) * q[rod->first_stretch + i];
    e.stretch_slope += L::weights(&rule.legendre_slope[i][k]) * q[rod->first_stretch + i];
  }
  return e;
}

template <class S>
void RodFrames<S>::put(const Vector3<Pack>& v, S* to, int apart) {
  L::each([&](auto lane) {
    for (int c = 0; c < 3; ++c) to[lane * apart + c] = L::get(v[c], lane);
    to[lane * apart + 3] = S(0.0);
  });
}

template <class S>
template <int length, class F>
void RodFrames<S>::integrate_rows(const S* from, const F& f) const {
  constexpr int num_packs = length / Rows<S>::count;
  alignas(row_alignment) std::array<S, length> sum;
  for (S& one : sum) one = S(0.0);
  for (int k = 0; k < rod->num_nodes(); ++k) {
    integrate_step<num_packs>(std::integral_constant<int, num_packs>(), k, from, sum.data(),
                              sum.data());
    f(k, sum.data());
  }
}

template <class S>
template <int max_packs, class Count>
void RodFrames<S>::integrate_step(Count num_packs, int k, const S* rows_of_frames, const S* before,
                                  S* to) const {
  const RodNode& node = rod->rule.nodes[k];
  const RowPack* from = packs_of(rows_of_frames) + 2 * num_packs * node.first_neighbour;
  RowPack sum[max_packs];  // NOLINT(modernize-avoid-c-arrays): of a typedef
  for (int i = 0; i < num_packs; ++i) {
    sum[i] = node.integral[0].value * from[i] + node.integral[0].slope * from[num_packs + i];
  }
  for (int j = 1; j < num_neighbours; ++j) {
    from += 2 * num_packs;
    const auto weight = node.integral[j];
    for (int i = 0; i < num_packs; ++i) {
      sum[i] += weight.value * from[i] + weight.slope * from[num_packs + i];
    }
  }
  for (int i = 0; i < num_packs; ++i) packs_of(to)[i] = packs_of(before)[i] + sum[i];
}

template <class S>
template <class Width>
void RodFrames<S>::turn(Width width) {
  constexpr int max_packs = 3 * widest<Width> / Rows<S>::count;
  const int n = width / Rows<S>::count;
  alignas(row_alignment) std::array<S, 3 * widest<Width> * max_rod_steps> columns;
  for (int row = 0; row < 3 * rod->rule.steps.count; ++row) {
    for (int i = rod->first_stretch; i < width; ++i) columns[row * width + i] = S(0.0);
  }
  turns.slopes(*rod, columns.data(), width);
  RowPack sum[max_packs];  // NOLINT(modernize-avoid-c-arrays): of a typedef
  for (int i = 0; i < 3 * n; ++i) sum[i] = packs_of(columns.data())[i];
  S *J = rows.data() + 3 * rod->num_nodes() * width, *spin = J + 3 * rod->num_frames() * width;
  int s = 1;
  for (int k = 1; k <= rod->num_frames(); ++k, J += 3 * width, spin += width) {
    for (; s < rod->rule.frames[k].steps_before; ++s) {
      const RowPack* from = packs_of(columns.data() + 3 * s * width);
      for (int i = 0; i < 3 * n; ++i) sum[i] += from[i];
    }
    const Vector3<S> t = axes_at.z.get(k);
    for (int i = 0; i < 3 * n; ++i) packs_of(J)[i] = sum[i];
    for (int i = 0; i < n; ++i) {
      packs_of(spin)[i] = t[0] * sum[i] + t[1] * sum[n + i] + t[2] * sum[2 * n + i];
    }
  }
}

template <class S>
template <class Width>
void RodFrames<S>::integrate(Width width, const S* q) {
  // dr/dx and d2r/dx2 at the frames, and how they change with q; the base does not turn.
  alignas(row_alignment) std::array<S, 8 * (max_rod_frames + 1)> d;
  alignas(row_alignment) std::array<S, 6 * widest<Width> * max_rod_frames> J;
  for (int k = 0; k <= rod->num_frames(); k += L::count) {
    Strain& e = strain[k / L::count];
    e = strain_of(k, q);
    for (int lane = 0; lane < L::count; ++lane) {
      L::set(e.q_x, lane, L::get(e.q_x, lane) + rod->locked_turning[1]);
      L::set(e.q_y, lane, L::get(e.q_y, lane) - rod->locked_turning[0]);
    }
    const auto x = axes_at.x.load(k), y = axes_at.y.load(k), z = axes_at.z.load(k);
    const Pack length = rod->length + e.stretch;
    put(length * z, d.data() + 8 * k, 8);
    put(length * (e.q_x * x + e.q_y * y) + e.stretch_slope * z, d.data() + 8 * k + 4, 8);
  }
  for (int k = 0; k <= rod->num_frames(); ++k) {
    const S *first = d.data() + 8 * k, *second = first + 4;
    S *J_first = J.data() + 6 * k * width, *J_second = J_first + 3 * width;
    if (k == 0) {
      for (int i = 0; i < 6 * width; ++i) J_first[i] = S(0.0);
    } else {
      const S* turning = turning_rows(width, k);
      for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        const RowPack *on_a = packs_of(turning + a * width), *on_b = packs_of(turning + b * width);
        for (int i = 0; i < width / Rows<S>::count; ++i) {
          packs_of(J_first + c * width)[i] = on_a[i] * first[b] - on_b[i] * first[a];
          packs_of(J_second + c * width)[i] = on_a[i] * second[b] - on_b[i] * second[a];
        }
      }
    }
    const Strain& e = strain[k / L::count];
    const int lane = k % L::count;
    const Vector3<S> x = axes_at.x.get(k), y = axes_at.y.get(k), z = axes_at.z.get(k);
    const S length = rod->length + L::get(e.stretch, lane);
    for (int i = 0; i < rod->num_bending; ++i) {
      const S share = rod->rule.legendre[i][k] * length;
      for (int c = 0; c < 3; ++c) {
        J_second[c * width + 2 * i] += share * x[c];
        J_second[c * width + 2 * i + 1] += share * y[c];
      }
    }
    for (int i = 0; i < rod->num_stretch; ++i) {
      const int column = rod->first_stretch + i;
      const double P = rod->rule.legendre[i][k], slope = rod->rule.legendre_slope[i][k];
      for (int c = 0; c < 3; ++c) {
        J_first[c * width + column] = P * z[c];
        J_second[c * width + column] =
            P * (L::get(e.q_x, lane) * x[c] + L::get(e.q_y, lane) * y[c]) + slope * z[c];
      }
    }
  }
  integrate_rows<4>(d.data(),
                    [&](int k, const S* sum) { places.set(k, {sum[0], sum[1], sum[2]}); });
  alignas(row_alignment) std::array<S, 3 * widest<Width>> zero;
  for (int i = 0; i < 3 * width; ++i) zero[i] = S(0.0);
  const S* before = zero.data();
  const auto num_packs = packs_in(width);
  for (int k = 0; k < rod->num_nodes(); ++k) {
    S* to = rows.data() + 3 * k * width;
    integrate_step<3 * widest<Width> / Rows<S>::count>(num_packs, k, J.data(), before, to);
    before = to;
  }
}

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming)
