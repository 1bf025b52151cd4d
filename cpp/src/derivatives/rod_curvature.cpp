#include "derivatives/weight_hessian.hpp"
#include "section/rod_turns_body.hpp"

// Second derivatives of the work of weight on a rod, cpp/derivatives.md eq. (80).

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming):
// counts of rows and coordinates, all small; letters of the equations

namespace cdcr::detail {

template <class S>
auto Magnus<S>::curvature(const Vector3<S>& along) const -> Eigen::Matrix<S, 9, 9> {
  using Slopes = Eigen::Matrix<S, 3, 9>;
  const auto cross = [](const Vector3<S>& v) {
    Matrix3<S> M = Matrix3<S>::Zero();
    add_cross(M, v);
    return M;
  };
  const Matrix3<S> one = Matrix3<S>::Identity(), on_a = cross(a), on_b = cross(b);
  const S aa = a.dot(a), ab = a.dot(b);
  Slopes w_slope, P_slope, Q_slope;
  w_slope << on_b, -on_a, 2.0 * one;
  P_slope << on_b - 20.0 * one, -on_a, -one;
  Q_slope << (b * a.transpose() - ab * one - cross(w)) / 60.0,
      one - (a * a.transpose() - aa * one) / 60.0, on_a / 30.0;
  const Vector3<S> v = along.cross(P);
  const Slopes across = cross(along).lazyProduct(Q_slope);
  Eigen::Matrix<S, 9, 9> half = -P_slope.transpose().lazyProduct(across);
  half.template topRows<3>() -= cross(v).lazyProduct(w_slope) / 60.0;
  half.template block<3, 3>(0, 3) += cross(Q.cross(along) + v.cross(a) / 60.0);
  return (half + half.transpose()) / -240.0;
}

template <class S>
auto RodTurns<S>::curvature(int s, const Vector3<Pack>& moment) const -> Eigen::Matrix<Pack, 9, 9> {
  const Step& step = steps_[s / L::count];
  const Vector3<Pack> pull = step.from.transpose().lazyProduct(moment);
  const TurnFunctions<Pack>& f = step.f;
  const Vector3<Pack>& Omega = step.magnus.Omega;
  const Vector3<Pack> across = pull.cross(Omega), outer = Omega.cross(Vector3<Pack>(-across));
  // T^T pull, and how it changes with Omega.
  const Vector3<Pack> turned = pull + f.A * across + f.G * outer;
  Matrix3<Pack> change = (2.0 * (f.dA * across + f.dG * outer - f.G * pull)) * Omega.transpose() +
                         (f.G * Omega) * pull.transpose();
  change += turn(f.G * Omega.dot(pull), f.A, Pack(0.0), pull);
  std::array<Matrix3<Pack>, 3> slope;
  step.magnus.slopes(slope);
  Eigen::Matrix<Pack, 3, 9> slopes;
  slopes << slope[0], slope[1], slope[2];
  const Eigen::Matrix<Pack, 3, 9> changes = change.lazyProduct(slopes);
  return step.magnus.curvature(turned) + slopes.transpose().lazyProduct(changes);
}

template <class S>
void RodFrames<S>::subtract_curvature(const Vector3<S>& g, double mass, const Vector3<S>& h,
                                      MatrixRef H) const {
  const RodRule& rule = rod->rule;
  const int num_frames = rod->num_frames(), size = rod->size();
  // The work of weight is g.(sum of value dr/dx + slope d2r/dx2 at the frames).
  std::array<RodNode::Weight, max_rod_frames + 1> weights{};
  for (int k = rod->num_nodes() - 1; k >= 0; --k) {
    mass += rule.mass[k];
    const RodNode& node = rule.nodes[k];
    for (int j = 0; j < num_neighbours; ++j) {
      weights[node.first_neighbour + j].value += mass * node.integral[j].value;
      weights[node.first_neighbour + j].slope += mass * node.integral[j].slope;
    }
  }
  // What turns with each frame, and the moment of its weight and of all beyond it.
  std::array<Vector3<S>, max_rod_frames + 2> arm, moment;
  moment[num_frames + 1].setZero();
  const auto strain_at = [&](int k) {
    const Strain& e = strain[k / L::count];
    const int lane = k % L::count;
    return std::array<S, 4>{L::get(e.q_x, lane), L::get(e.q_y, lane),
                            rod->length + L::get(e.stretch, lane), L::get(e.stretch_slope, lane)};
  };
  for (int k = num_frames; k > 0; --k) {
    const auto [q_x, q_y, length, length_slope] = strain_at(k);
    const double value = weights[k].value, slope = weights[k].slope;
    arm[k] = (slope * length) * (q_x * axes_at.x.get(k) + q_y * axes_at.y.get(k)) +
             (value * length + slope * length_slope) * axes_at.z.get(k);
    if (k == num_frames) arm[k] += h;
    moment[k] = moment[k + 1] + arm[k].cross(g);
  }

  with_width<S>(size, [&](auto width) {
    constexpr int widest_row = widest<decltype(width)>, max_packs = widest_row / Rows<S>::count;
    const int n = width / Rows<S>::count;
    alignas(row_alignment) std::array<S, widest_row * widest_row> sums;
    for (int i = 0; i < width * width; ++i) sums[i] = S(0.0);
    // Adds left^T right of so many rows.
    const auto add_products = [&](const S* left, const S* right, int num_rows) {
      for (int c = 0; c < size; ++c) {
        RowPack* to = packs_of(sums.data() + c * width);
        for (int row = 0; row < num_rows; ++row) {
          const S share = left[row * width + c];
          const RowPack* from = packs_of(right + row * width);
          for (int i = 0; i < n; ++i) to[i] += share * from[i];
        }
      }
    };
    alignas(row_alignment) std::array<S, 3 * widest_row> right, own;
    // Along each frame, by the turning of both coordinates and by its own strains.
    for (int k = 0; k <= num_frames; ++k) {
      const auto [q_x, q_y, length, length_slope] = strain_at(k);
      const double value = weights[k].value, slope = weights[k].slope;
      const Vector3<S> x = axes_at.x.get(k), y = axes_at.y.get(k), z = axes_at.z.get(k);
      const S on_x = slope * x.dot(g), on_y = slope * y.dot(g);
      for (int i = 0; i < rod->num_bending; ++i) {
        for (int j = 0; j < rod->num_stretch; ++j) {
          const double both = rule.legendre[i][k] * rule.legendre[j][k];
          const int row = rod->first_stretch + j;
          sums[row * width + 2 * i] += both * on_x;
          sums[row * width + 2 * i + 1] += both * on_y;
        }
      }
      if (k == 0) continue;  // it does not turn
      for (S& one : own) one = S(0.0);
      const auto put = [&](int column, const Vector3<S>& v) {
        const Vector3<S> pull = v.cross(g);
        for (int c = 0; c < 3; ++c) own[c * width + column] = pull[c];
      };
      for (int i = 0; i < rod->num_bending; ++i) {
        const double P = rule.legendre[i][k];
        put(2 * i, (slope * P * length) * x);
        put(2 * i + 1, (slope * P * length) * y);
      }
      for (int i = 0; i < rod->num_stretch; ++i) {
        const double P = rule.legendre[i][k];
        put(rod->first_stretch + i, (slope * P) * (q_x * x + q_y * y) +
                                        (value * P + slope * rule.legendre_slope[i][k]) * z);
      }
      const S* turning = turning_rows(width, k);
      const RowPack *w_x = packs_of(turning), *w_y = w_x + n, *w_z = w_y + n;
      const S along = arm[k].dot(g);
      for (int i = 0; i < n; ++i) {
        const RowPack w_g = g[0] * w_x[i] + g[1] * w_y[i] + g[2] * w_z[i];
        for (int c = 0; c < 3; ++c) {
          packs_of(right.data())[c * n + i] =
              arm[k][c] * w_g - along * w_x[c * n + i] + packs_of(own.data())[c * n + i];
        }
      }
      add_products(turning, right.data(), 3);
      add_products(own.data(), turning, 3);
    }

    // Along each step: what it adds to the turning turns with what came before, and bends itself.
    alignas(row_alignment) std::array<S, 3 * widest_row * max_rod_steps> columns;
    for (int row = 0; row < 3 * rule.steps.count; ++row) {
      for (int i = rod->first_stretch; i < width; ++i) columns[row * width + i] = S(0.0);
    }
    turns.slopes(*rod, columns.data(), width);
    RowPack before[3 * max_packs];  // NOLINT(modernize-avoid-c-arrays): of a typedef
    Rows<S>::clear(before, 3 * n);
    std::array<std::array<Pack, widest_row>, widest_row> bends;
    for (auto& row : bends) row.fill(Pack(0.0));
    const auto axis_of = [&](int c) { return c >= rod->first_twist ? 2 : 1 - c % 2; };
    const auto order_of = [&](int c) {
      return c >= rod->first_twist ? c - rod->first_twist : c / 2;
    };
    const auto weight_of = [&](int i, int c, int s) {
      const auto weight = L::weights(&rule.steps.weights[i][order_of(c)][s]);
      return axis_of(c) == 0 ? -weight : weight;
    };
    int frame = 1;
    for (int s = 0; s < rule.steps.count; s += L::count) {
      Vector3<Pack> beyond = Vector3<Pack>::Zero();
      for (int lane = 0; lane < L::count; ++lane) {
        while (frame <= num_frames && s + lane >= rule.frames[frame].steps_before) ++frame;
        const Vector3<S>& M = moment[frame];
        for (int c = 0; c < 3; ++c) L::set(beyond[c], lane, M[c]);
        const S* step = columns.data() + 3 * (s + lane) * width;
        for (int c = 0; c < 3; ++c) {
          const int a = (c + 1) % 3, b = (c + 2) % 3;
          for (int i = 0; i < n; ++i) {
            packs_of(right.data())[c * n + i] = M[a] * before[b * n + i] - M[b] * before[a * n + i];
          }
        }
        add_products(step, right.data(), 3);
        for (int i = 0; i < 3 * n; ++i) before[i] += packs_of(step)[i];
      }
      const auto curvature = turns.curvature(s, beyond);
      for (int j = 0; j < rod->first_stretch; ++j) {
        Eigen::Matrix<Pack, 9, 1> column = Eigen::Matrix<Pack, 9, 1>::Zero();
        for (int i = 0; i <= order_of(j) && i < 3; ++i) {
          column += curvature.col(3 * i + axis_of(j)) * weight_of(i, j, s);
        }
        for (int c = j; c < rod->first_stretch; ++c) {
          for (int i = 0; i <= order_of(c) && i < 3; ++i) {
            bends[c][j] += weight_of(i, c, s) * column[3 * i + axis_of(c)];
          }
        }
      }
    }
    for (int c = 0; c < size; ++c) {
      for (int j = 0; j <= c; ++j) {
        const S sum = sums[c * width + j] + L::total(bends[c][j]);
        H(c, j) -= sum;
        if (j < c) H(j, c) -= sum;
      }
    }
  });
}

template void RodFrames<double>::subtract_curvature(const Vector3d&, double, const Vector3d&,
                                                    MatrixRef) const;
template void weight_hessian(const Chain&, const RodChainState<double>&, const double*,
                             MatrixRef) noexcept;

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming)
