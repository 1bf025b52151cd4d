#pragma once

#include "cdcr/wrench.hpp"
#include "chain/reach.hpp"
#include "derivatives/dual.hpp"

// NOLINTBEGIN(readability-identifier-naming): letters of the equations

namespace cdcr::detail {

/// The same part of a section on dual numbers.
template <class Part>
struct OnDuals;
template <template <class> class Kind>
struct OnDuals<Kind<double>> {
  using type = Kind<Dual>;
  static constexpr Index max_m = Kind<double>::max_m;
};

/// add(row, coordinate, slope) for each derivative of J^T w with respect to q, eqs. (81) to (83):
/// each section by itself on dual numbers, what it carries turned as one piece.
template <class Add>
void differentiate_wrench(const Chain& chain, const double* q, const Wrench& wrench,
                          const Add& add) {
  with_reach(chain, q, wrench.section, wrench.fraction, [&](const auto& reach) {
    using Part = std::decay_t<decltype(reach.parts[0])>;
    const bool local = wrench.frame == Wrench::Frame::local;
    const Vector3d f = local ? reach.frame.rotate(wrench.force) : wrench.force;
    const Vector3d m = local ? reach.frame.rotate(wrench.moment) : wrench.moment;
    typename OnDuals<Part>::type dual;
    FrameState<double> frame = root_of<double>(chain);
    for (Index i = 0; i <= reach.last; ++i) {
      const Part& part = reach.parts[i];
      const Index at = chain.first[i], size = part.J_omega.cols();
      const Vector3d lever = reach.p - reach.ends[i], moment = m + lever.cross(f);
      const FrameState<Dual> base{frame.x.cast<Dual>(), frame.y.cast<Dual>(), frame.z.cast<Dual>(),
                                  Vector3<Dual>::Zero()};
      std::array<Dual, OnDuals<Part>::max_m> x;
      for (Index k = 0; k < size; ++k) x[k] = Dual(q[at + k]);
      for (Index first = 0; first < size; first += Quad::count) {
        const int count = static_cast<int>(std::min<Index>(Quad::count, size - first));
        for (int lane = 0; lane < count; ++lane) x[first + lane].slopes[lane] = 1.0;
        dual.update_position(chain.sections[i], base, x.data(),
                             i == reach.last ? wrench.fraction : 1.0);
        for (int lane = 0; lane < count; ++lane) {
          x[first + lane].slopes[lane] = 0.0;
          const Index k = first + lane;
          const Vector3d turn = part.J_omega.col(k);
          // How the wrench and the moment at this part's end change.
          const Vector3d df = local ? turn.cross(f) : Vector3d::Zero();
          const Vector3d end_moment = (local ? turn.cross(m) : Vector3d::Zero()) +
                                      Vector3d(turn.cross(lever)).cross(f) + lever.cross(df);
          for (Index c = 0; c < size; ++c) {
            double slope = part.J_omega.col(c).dot(end_moment) + part.J_v.col(c).dot(df);
            for (int l = 0; l < 3; ++l) {
              slope +=
                  dual.J_omega(l, c).slopes[lane] * moment[l] + dual.J_v(l, c).slopes[lane] * f[l];
            }
            add(at + c, at + k, slope);
          }
          // Of the sections that carry this one.
          const Vector3d dr(dual.r[0].slopes[lane], dual.r[1].slopes[lane], dual.r[2].slopes[lane]);
          Vector3d base_moment = end_moment + dr.cross(f) + part.r.cross(df);
          for (Index j = i - 1; j >= 0; --j) {
            const Part& before = reach.parts[j];
            for (Index c = 0; c < before.J_omega.cols(); ++c) {
              add(chain.first[j] + c, at + k,
                  before.J_omega.col(c).dot(base_moment) + before.J_v.col(c).dot(df));
            }
            base_moment += before.r.cross(df);
          }
          // Of those that it carries, which a wrench of their own turns with.
          for (Index j = i + 1; !local && j <= reach.last; ++j) {
            const Part& beyond = reach.parts[j];
            for (Index c = 0; c < beyond.J_omega.cols(); ++c) {
              const Vector3d moving =
                  beyond.J_v.col(c) +
                  Vector3d(beyond.J_omega.col(c)).cross(Vector3d(reach.p - reach.ends[j]));
              add(chain.first[j] + c, at + k,
                  -turn.dot(f.cross(moving) + m.cross(Vector3d(beyond.J_omega.col(c)))));
            }
          }
        }
      }
      frame = part.end();
    }
  });
}

}  // namespace cdcr::detail

// NOLINTEND(readability-identifier-naming)
