#pragma once

#include "section/rod_frames.hpp"

namespace cdcr::detail {

/// The kind of section (section_state.hpp) whose bending, twist and stretch vary along it: rigid
/// elements at nodes, cpp/rods.md eqs. (58) to (62). The number of coordinates is that of its
/// parameters.
template <class S>
struct Rod : RodFrames<S> {
  using Scalar = S;
  using RodFrames<S>::m, RodFrames<S>::max_m;
  using Matrix3m = typename RodFrames<S>::Matrix3m;
  using Matrixm = Eigen::Matrix<S, m, m, Eigen::ColMajor, max_m, max_m>;
  using Vectorm = Eigen::Matrix<S, m, 1, Eigen::ColMajor, max_m, 1>;

  using RodFrames<S>::base, RodFrames<S>::rod, RodFrames<S>::axes, RodFrames<S>::r,
      RodFrames<S>::J_omega, RodFrames<S>::J_v;

  Vector3<S> tip_angular_bias, tip_linear_bias, moment, force;
  Vectorm bias;
  Vectorm elastic;

  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* q) {
    RodFrames<S>::update_position(section, at, q);
    elastic = elastic_force(section, q);
  }

  /// Frame at the tip; how fast it turns is left out.
  [[nodiscard]] FrameState<S> end() const {
    return {axes.col(0), axes.col(1), axes.col(2), Vector3<S>::Zero()};
  }
  /// omega of the tip.
  [[nodiscard]] Vector3<S> turning_rate() const {
    return base.omega + turning[rod->num_frames()].omega;
  }

  template <bool turns>
  void update_velocity(const SectionParameters&, const Vector3<S>& omega, const S* qd) {
    base.omega = omega;
    bias = elastic;
    for (int i = 0; i < rod->size(); ++i) bias[i] += rod->damping[i] * qd[i];
    if (rod->material_damping > 0.0) add_material_damping(qd);
    with_width<S>(rod->size(), [&](auto width) {
      move(qd);
      add_inertia_forces<turns>(width);
    });
  }

  [[nodiscard]] Vector3<S> first_moment() const {
    Vector3<S> h = Vector3<S>::Zero();
    for (int k = 0; k < rod->num_nodes(); ++k) h += node(k).mass * places[k];
    return h;
  }
  [[nodiscard]] Matrix3<S> second_moment() const {
    S round(frame(0).inertia);
    Matrix3<S> J = round * base.z * base.z.transpose();
    for (int k = 0; k < rod->num_nodes(); ++k) {
      round += node(k).mass * places[k].squaredNorm();
      J -= node(k).mass * places[k] * places[k].transpose();
    }
    for (int k = 1; k <= rod->num_frames(); ++k) {
      round += frame(k).inertia;
      J += frame(k).inertia * turning[k].t * turning[k].t.transpose();
    }
    J.diagonal().array() += round;
    return J;
  }
  [[nodiscard]] Matrix3m linear_coupling() const {
    Matrix3m H(3, rod->size());
    with_width<S>(rod->size(), [&](auto width) {
      std::array<S, 3 * max_m> sum{};
      for (int i = 0; i < 3 * width; ++i) sum[i] = S(0.0);
      for (int k = 0; k < rod->num_nodes(); ++k) {
        const S* J = rows.data() + 3 * k * width;
        for (int i = 0; i < 3 * width; ++i) sum[i] += node(k).mass * J[i];
      }
      for (int i = 0; i < H.cols(); ++i) H.col(i) << sum[i], sum[width + i], sum[2 * width + i];
    });
    return H;
  }
  [[nodiscard]] Matrix3m angular_coupling() const {
    Matrix3m N(3, rod->size());
    with_width<S>(rod->size(), [&](auto width) {
      std::array<S, 3 * max_m> sum{};
      for (int i = 0; i < 3 * width; ++i) sum[i] = S(0.0);
      for (int k = 0; k < rod->num_nodes(); ++k) {
        const S* J = rows.data() + 3 * k * width;
        const Vector3<S> lever = node(k).mass * places[k];
        for (int c = 0; c < 3; ++c) {
          const int a = (c + 1) % 3, b = (c + 2) % 3;
          for (int i = 0; i < width; ++i) {
            sum[c * width + i] += lever[a] * J[b * width + i] - lever[b] * J[a * width + i];
          }
        }
      }
      for (int k = 1; k <= rod->num_frames(); ++k) {
        const S *J = this->turning_rows(width) + 3 * (k - 1) * width,
                *spin = this->spin_rows(width) + (k - 1) * width;
        for (int c = 0; c < 3; ++c) {
          for (int i = 0; i < width; ++i) {
            sum[c * width + i] += frame(k).inertia * (J[c * width + i] + turning[k].t[c] * spin[i]);
          }
        }
      }
      for (int i = 0; i < N.cols(); ++i) N.col(i) << sum[i], sum[width + i], sum[2 * width + i];
    });
    return N;
  }
  [[nodiscard]] Matrixm own_mass() const {
    Matrixm M(rod->size(), rod->size());
    with_width<S>(rod->size(), [&](auto width) {
      constexpr int max_width = std::is_same_v<decltype(width), int> ? max_m : int(width);
      // All rows, times what weighs them.
      const int num_rows = 3 * rod->num_nodes() + 4 * rod->num_frames();
      std::array<S, max_width * (3 * max_rod_nodes + 4 * (max_rod_frames - 1))> weighed;
      S* to = weighed.data();
      const S* from = rows.data();
      const auto weigh = [&](double weight, int count) {
        for (int i = 0; i < count * width; ++i) *to++ = weight * *from++;
      };
      for (int k = 0; k < rod->num_nodes(); ++k) weigh(node(k).mass, 3);
      for (int k = 1; k <= rod->num_frames(); ++k) weigh(frame(k).inertia, 3);
      for (int k = 1; k <= rod->num_frames(); ++k) weigh(frame(k).inertia, 1);
      add_products<0>(width, num_rows, weighed.data(), M);
    });
    M.template triangularView<Eigen::StrictlyUpper>() = M.transpose();
    return M;
  }

  [[nodiscard]] static Vectorm elastic_force(const SectionParameters& section, const S* q) {
    const RodParameters& rod = *section.rod;
    Vectorm force(rod.size());
    for (int i = 0; i < rod.size(); ++i) {
      force[i] = S(0.0);
      for (int j = 0; j < rod.size(); ++j) force[i] += rod.stiffness(i, j) * (q[j] - rod.rest[j]);
    }
    return force;
  }
  [[nodiscard]] static S elastic_energy(const SectionParameters& section, const S* q) {
    const RodParameters& rod = *section.rod;
    const Vectorm force = elastic_force(section, q);
    S twice(0.0);
    for (int i = 0; i < force.size(); ++i) twice += force[i] * (q[i] - rod.rest[i]);
    return 0.5 * twice;
  }

 private:
  using RodFrames<S>::rows, RodFrames<S>::places, RodFrames<S>::turning, RodFrames<S>::moving,
      RodFrames<S>::move;

  void add_material_damping(const S* qd) {
    for (int i = 0; i < rod->size(); ++i) {
      for (int j = 0; j < rod->size(); ++j) {
        bias[i] += rod->material_damping * rod->stiffness(i, j) * qd[j];
      }
    }
  }
  [[nodiscard]] const RodNode& node(int k) const { return rod->rule.nodes[k]; }
  [[nodiscard]] const RodFrame& frame(int k) const { return rod->rule.frames[k]; }

  /// Rows from `first` on of the lower half of rows^T weighed: as many at once as there are lanes.
  template <int first, class Width>
  void add_products(Width width, int num_rows, const S* weighed, Matrixm& M) const {
    using L = Lanes<S>;
    if constexpr (std::is_same_v<Width, int>) {
      for (int i = 0; i < width; ++i) {
        for (int j = 0; j <= i; ++j) {
          S sum(0.0);
          for (int k = 0; k < num_rows; ++k) sum += weighed[k * width + i] * rows[k * width + j];
          M(i, j) = sum;
        }
      }
    } else if constexpr (first < Width()) {
      std::array<std::array<typename L::Pack, (width - first) / L::count>, L::count> sums;
      for (auto& of_one : sums) of_one.fill(typename L::Pack(0.0));
      for (int k = 0; k < num_rows; ++k) {
        for (int i = 0; i < L::count; ++i) {
          const typename L::Pack weight(weighed[k * width + first + i]);
          for (int j = first; j < width; j += L::count) {
            sums[i][(j - first) / L::count] += weight * L::load(&rows[k * width + j]);
          }
        }
      }
      for (int i = 0; i < L::count && first + i < M.cols(); ++i) {
        for (int j = first + i; j < M.cols(); ++j) {
          M(j, first + i) = L::get(sums[i][(j - first) / L::count], (j - first) % L::count);
        }
      }
      add_products<first + L::count>(width, num_rows, weighed, M);
    }
  }

  template <bool turns, class Width>
  void add_inertia_forces(Width width) {
    constexpr int max_width = std::is_same_v<Width, int> ? max_m : int(Width());
    const Vector3<S>& omega = base.omega;
    std::array<S, max_width> sum{};
    for (int i = 0; i < width; ++i) sum[i] = S(0.0);
    const auto add = [&](const S* J, const Vector3<S>& f) {
      for (int i = 0; i < width; ++i) {
        sum[i] += J[i] * f[0] + J[width + i] * f[1] + J[2 * width + i] * f[2];
      }
    };
    if constexpr (turns) {
      force.setZero();
      moment = frame(0).inertia * omega.dot(base.z) * omega.cross(base.z);
    }
    Vector3<S> a = Vector3<S>::Zero(), alpha = a;
    for (int k = 0; k < rod->num_nodes(); ++k) {
      a = moving[k].v_dot;
      if constexpr (turns) {
        a += omega.cross(Vector3<S>(omega.cross(places[k]) + 2.0 * moving[k].v));
      }
      const Vector3<S> push = node(k).mass * a;
      add(rows.data() + 3 * k * width, push);
      if constexpr (turns) {
        force += push;
        moment += places[k].cross(push);
      }
    }
    for (int k = 1; k <= rod->num_frames(); ++k) {
      const auto& here = turning[k];
      alpha = here.omega_dot;
      Vector3<S> whole = here.omega;
      if constexpr (turns) {
        alpha += omega.cross(here.omega);
        whole += omega;
      }
      // Rate of I_t (omega + t (t.omega)).
      const Vector3<S> twist = frame(k).inertia * (alpha + here.t.dot(alpha) * here.t +
                                                   here.t.dot(whole) * whole.cross(here.t));
      add(this->turning_rows(width) + 3 * (k - 1) * width, twist);
      if constexpr (turns) moment += twist;
    }
    for (int i = 0; i < bias.size(); ++i) bias[i] += sum[i];
    tip_angular_bias = alpha;
    tip_linear_bias = a;
  }
};

}  // namespace cdcr::detail
