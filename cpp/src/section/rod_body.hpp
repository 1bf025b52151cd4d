#pragma once

#include "section/rod.hpp"
#include "section/rod_frames_body.hpp"

// Bodies of Rod.

namespace cdcr::detail {

template <class S>
void Rod<S>::update_position(const SectionParameters& section, const FrameState<S>& at,
                             const S* q) {
  RodFrames<S>::update_position(section, at, q);
  elastic = elastic_force(section, q);
}

template <class S>
template <bool turns>
void Rod<S>::update_velocity(const SectionParameters&, const Vector3<S>& omega, const S* qd) {
  base.omega = omega;
  bias = elastic;
  for (int i = 0; i < rod->size(); ++i) bias[i] += rod->damping[i] * qd[i];
  if (rod->material_damping > 0.0) add_material_damping(qd);
  with_width<S>(rod->size(), [&](auto width) {
    move(qd);
    add_inertia_forces<turns>(width);
  });
}

template <class S>
auto Rod<S>::first_moment() const -> Vector3<S> {
  Vector3<Pack> h = Vector3<Pack>::Zero();
  for (int k = 0; k < rod->num_nodes(); k += L::count) h += mass(k) * places.load(k);
  return total(h);
}

template <class S>
auto Rod<S>::second_moment() const -> Matrix3<S> {
  // Upper half, xx xy xz yy yz zz, of I t t^T - m r r^T, and the share of the unit matrix.
  std::array<Pack, 6> J;
  J.fill(Pack(0.0));
  Pack round(0.0);
  const auto add = [&J](const Vector3<Pack>& weighed, const Vector3<Pack>& v) {
    for (int i = 0, at = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) J[at++] += weighed[i] * v[j];
    }
  };
  for (int k = 0; k < rod->num_nodes(); k += L::count) {
    const Vector3<Pack> place = places.load(k), weighed = -mass(k) * place;
    round -= weighed.dot(place);
    add(weighed, place);
  }
  for (int k = 0; k <= rod->num_frames(); k += L::count) {
    const Vector3<Pack> t = axes_at.z.load(k);
    round += inertia(k);
    add(inertia(k) * t, t);
  }
  Matrix3<S> sum;
  for (int i = 0, at = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) sum(i, j) = sum(j, i) = L::total(J[at++]);
  }
  sum.diagonal().array() += L::total(round);
  return sum;
}

template <class S>
auto Rod<S>::linear_coupling() const -> Matrix3m {
  Matrix3m H;
  with_width<S>(rod->size(), [&](auto width) {
    constexpr int max_packs = 3 * widest<decltype(width)> / Rows<S>::count;
    const int n = 3 * width / Rows<S>::count;
    alignas(row_alignment) std::array<S, 3 * widest<decltype(width)>> sums;
    RowPack sum[max_packs];  // NOLINT(modernize-avoid-c-arrays): of a typedef
    for (int i = 0; i < n; ++i) sum[i] = rod->rule.mass[0] * packs_of(node_rows(width, 0))[i];
    for (int k = 1; k < rod->num_nodes(); ++k) {
      const RowPack* J = packs_of(node_rows(width, k));
      for (int i = 0; i < n; ++i) sum[i] += rod->rule.mass[k] * J[i];
    }
    for (int i = 0; i < n; ++i) packs_of(sums.data())[i] = sum[i];
    copy(width, sums.data(), H);
  });
  return H;
}

template <class S>
auto Rod<S>::angular_coupling() const -> Matrix3m {
  Matrix3m N;
  with_width<S>(rod->size(), [&](auto width) {
    constexpr int max_packs = widest<decltype(width)> / Rows<S>::count;
    const int n = width / Rows<S>::count;
    alignas(row_alignment) std::array<S, 3 * widest<decltype(width)>> sums;
    for (int c = 0; c < 3; ++c) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      RowPack sum[max_packs];  // NOLINT(modernize-avoid-c-arrays): of a typedef
      Rows<S>::clear(sum, n);
      for (int k = 0; k < rod->num_nodes(); ++k) {
        const Vector3<S> lever = rod->rule.mass[k] * places.get(k);
        const RowPack* J = packs_of(node_rows(width, k));
        for (int i = 0; i < n; ++i) {
          sum[i] += lever[a] * J[b * n + i] - lever[b] * J[a * n + i];
        }
      }
      for (int k = 1; k <= rod->num_frames(); ++k) {
        const RowPack *J = packs_of(turning_rows(width, k)) + c * n,
                      *spin = packs_of(spin_row(width, k));
        const double inertia = rod->rule.inertia[k];
        const S along = inertia * axes_at.z.get(k)[c];
        for (int i = 0; i < n; ++i) sum[i] += inertia * J[i] + along * spin[i];
      }
      for (int i = 0; i < n; ++i) packs_of(sums.data())[c * n + i] = sum[i];
    }
    copy(width, sums.data(), N);
  });
  return N;
}

template <class S>
auto Rod<S>::own_mass() const -> Matrixm {
  Matrixm M(rod->size(), rod->size());
  with_width<S>(rod->size(), [&](auto width) {
    // All rows, times what weighs them.
    constexpr int max_rows = 3 * max_rod_nodes + 4 * max_rod_frames;
    alignas(row_alignment) std::array<S, max_rows * widest<decltype(width)>> weighed;
    S* to = weighed.data();
    const S* from = rows.data();
    const auto weigh = [&](double weight, int num_rows) {
      const int num_packs = num_rows * width / Rows<S>::count;
      for (int i = 0; i < num_packs; ++i) packs_of(to)[i] = weight * packs_of(from)[i];
      to += num_rows * width;
      from += num_rows * width;
    };
    for (int k = 0; k < rod->num_nodes(); ++k) weigh(rod->rule.mass[k], 3);
    for (int k = 1; k <= rod->num_frames(); ++k) weigh(rod->rule.inertia[k], 3);
    for (int k = 1; k <= rod->num_frames(); ++k) weigh(rod->rule.inertia[k], 1);
    const int num_rows = 3 * rod->num_nodes() + 4 * rod->num_frames();
    add_products<0>(width, num_rows, weighed.data(), M);
  });
  M.template triangularView<Eigen::StrictlyUpper>() = M.transpose();
  return M;
}

template <class S>
auto Rod<S>::elastic_force(const SectionParameters& section, const S* q) -> Vectorm {
  const RodParameters& rod = *section.rod;
  Vectorm force(rod.size());
  for (int i = 0; i < rod.size(); ++i) {
    force[i] = S(0.0);
    for (int j = 0; j < rod.size(); ++j) force[i] += rod.stiffness(i, j) * (q[j] - rod.rest[j]);
  }
  return force;
}

template <class S>
auto Rod<S>::elastic_energy(const SectionParameters& section, const S* q) -> S {
  const RodParameters& rod = *section.rod;
  const Vectorm force = elastic_force(section, q);
  S twice(0.0);
  for (int i = 0; i < force.size(); ++i) twice += force[i] * (q[i] - rod.rest[i]);
  return 0.5 * twice;
}

template <class S>
void Rod<S>::add_material_damping(const S* qd) {
  for (int i = 0; i < rod->size(); ++i) {
    for (int j = 0; j < rod->size(); ++j) {
      bias[i] += rod->material_damping * rod->stiffness(i, j) * qd[j];
    }
  }
}

template <class S>
template <int first, class Width>
void Rod<S>::add_products(Width width, int num_rows, const S* weighed, Matrixm& M) const {
  constexpr int count = Rows<S>::count;
  if constexpr (std::is_same_v<Width, int>) {
    for (int i = 0; i < width; ++i) {
      for (int j = 0; j <= i; ++j) {
        S sum(0.0);
        for (int k = 0; k < num_rows; ++k) sum += weighed[k * width + i] * rows[k * width + j];
        M(i, j) = sum;
      }
    }
  } else if constexpr (first < Width()) {
    constexpr int num_packs = (Width() - first) / count;
    // NOLINTNEXTLINE(modernize-avoid-c-arrays): of a typedef
    RowPack sums[count][num_packs] = {};
    for (int k = 0; k < num_rows; ++k) {
      const auto* row = packs_of<S>(&rows[k * width + first]);
      for (int i = 0; i < count; ++i) {
        const S weight = weighed[k * width + first + i];
        for (int j = 0; j < num_packs; ++j) sums[i][j] += weight * row[j];
      }
    }
    for (int i = 0; i < count && first + i < M.cols(); ++i) {
      for (int j = i; first + j < M.cols(); ++j) {
        M(first + j, first + i) = sums[i][j / count][j % count];
      }
    }
    add_products<first + count>(width, num_rows, weighed, M);
  }
}

template <class S>
template <bool turns, class Width>
void Rod<S>::add_inertia_forces(Width width) {
  const Vector3<Pack> omega = base.omega.template cast<Pack>();
  constexpr int max_packs = widest<Width> / Rows<S>::count;
  const int n = width / Rows<S>::count;
  alignas(row_alignment) std::array<S, widest<Width>> sums;
  for (int i = 0; i < width; ++i) sums[i] = i < bias.size() ? bias[i] : S(0.0);
  RowPack sum[max_packs];  // NOLINT(modernize-avoid-c-arrays): of a typedef
  for (int i = 0; i < n; ++i) sum[i] = packs_of(sums.data())[i];
  const auto add = [&](const S* rows_of_one, const Vector3<S>& f) {
    const RowPack* J = packs_of(rows_of_one);
    for (int i = 0; i < n; ++i) {
      sum[i] += J[i] * f[0] + J[n + i] * f[1] + J[2 * n + i] * f[2];
    }
  };
  Vectors<S> push_at, twist_at;
  Vector3<Pack> whole_force = Vector3<Pack>::Zero(), whole_moment = Vector3<Pack>::Zero();
  for (int k = 0; k < rod->num_nodes(); k += L::count) {
    Vector3<Pack> a = v_dot_at.load(k);
    const Vector3<Pack> place = places.load(k);
    if constexpr (turns) {
      a += omega.cross(Vector3<Pack>(omega.cross(place) + 2.0 * v_at.load(k)));
    }
    const Vector3<Pack> push = mass(k) * a;
    push_at.store(k, push);
    if constexpr (turns) {
      whole_force += push;
      whole_moment += place.cross(push);
    }
  }
  for (int k = 0; k <= rod->num_frames(); k += L::count) {
    Vector3<Pack> alpha = omega_dot_at.load(k), whole = omega_at.load(k);
    const Vector3<Pack> t = axes_at.z.load(k);
    if constexpr (turns) {
      alpha += omega.cross(whole);
      whole += omega;
    }
    // Rate of I_t (omega + t (t.omega)).
    const Vector3<Pack> twist =
        inertia(k) * (alpha + t.dot(alpha) * t + t.dot(whole) * whole.cross(t));
    twist_at.store(k, twist);
    if constexpr (turns) whole_moment += twist;
  }
  for (int k = 0; k < rod->num_nodes(); ++k) add(node_rows(width, k), push_at.get(k));
  for (int k = 1; k <= rod->num_frames(); ++k) add(turning_rows(width, k), twist_at.get(k));
  for (int i = 0; i < n; ++i) packs_of(sums.data())[i] = sum[i];
  for (int i = 0; i < bias.size(); ++i) bias[i] = sums[i];
  const int node = rod->num_nodes() - 1, frame = rod->num_frames();
  tip_angular_bias = omega_dot_at.get(frame);
  tip_linear_bias = v_dot_at.get(node);
  if constexpr (turns) {
    force = total(whole_force);
    moment = total(whole_moment);
    tip_angular_bias += base.omega.cross(omega_at.get(frame));
    tip_linear_bias += base.omega.cross(Vector3<S>(base.omega.cross(r) + 2.0 * v_at.get(node)));
  }
}

}  // namespace cdcr::detail
