#include "batch/rk4_lanes.hpp"

#include <algorithm>

namespace cdcr::detail {
namespace {

template <int W, bool closed>
class Rk4Of final : public Rk4Lanes {
 public:
  using P = typename MotionLanes<W, closed>::Scalar;

  Rk4Of(const Model& model, Index motions)
      : d_(model.num_coordinates()),
        packs_(std::clamp<Index>((motions + P::size - 1) / P::size, 1, most)),
        lanes_(model) {
    const auto size = static_cast<std::size_t>(d_), packs = static_cast<std::size_t>(packs_);
    for (std::vector<P>* v : {&y_, &slope_, &sum_}) v->assign(2 * size * packs, P(0.0));
    trial_.assign(2 * size, P(0.0));
    force_.assign(size * packs, P(0.0));
  }

  [[nodiscard]] Index size() const noexcept override { return P::size * packs_; }

  void set_state(Index motion, const VectorXd& y) noexcept override {
    P* to = y_.data() + motion / P::size * 2 * d_;
    for (Index i = 0; i < 2 * d_; ++i) set_lane(to[i], motion % P::size, y[i]);
  }
  void get_state(Index motion, VectorXd& y) const noexcept override {
    const P* from = y_.data() + motion / P::size * 2 * d_;
    for (Index i = 0; i < 2 * d_; ++i) y[i] = get_lane(from[i], motion % P::size);
  }
  void set_force(Index motion, const VectorXd& force) noexcept override {
    P* to = force_.data() + motion / P::size * d_;
    for (Index i = 0; i < d_; ++i) set_lane(to[i], motion % P::size, force[i]);
  }

  void step(double h) noexcept override {
    in_lanes_of(std::integral_constant<int, W>(), [&](auto /*width*/) {
      stage(0.0, h / 6.0, std::true_type());
      for (const double share : {0.5, 0.5, 1.0}) {
        stage(share * h, share < 1.0 ? h / 3.0 : h / 6.0, std::false_type());
      }
      y_.swap(sum_);
    });
  }

 private:
  // Of one section several at once, since each waits for its own last result.
  static constexpr Index most = closed ? 4 : 1;

  /// Slopes at y + share slope, which are added to the sum by their weight.
  template <class First>
  [[gnu::always_inline]] void stage(double share, double weight, First first) noexcept {
    const Index d = closed ? 2 : d_;
    for (Index b = 0; b < packs_; ++b) {
      const P *y = y_.data() + b * 2 * d, *force = force_.data() + b * d;
      P *slope = slope_.data() + b * 2 * d, *sum = sum_.data() + b * 2 * d, *at = trial_.data();
      for (Index i = 0; i < 2 * d; ++i) at[i] = first ? y[i] : y[i] + share * slope[i];
      for (Index i = 0; i < d; ++i) slope[i] = at[d + i];
      lanes_.accelerate(at, at + d, force, slope + d);
      for (Index i = 0; i < 2 * d; ++i) sum[i] = (first ? y : sum)[i] + weight * slope[i];
    }
  }

  Index d_, packs_;
  MotionLanes<W, closed> lanes_;
  std::vector<P> y_, slope_, sum_, trial_, force_;
};

}  // namespace

std::unique_ptr<Rk4Lanes> make_rk4_lanes(const Model& model, Index motions, int lanes) {
  return with_motion_lanes(
      model,
      [&](auto width, auto closed) -> std::unique_ptr<Rk4Lanes> {
        return std::make_unique<Rk4Of<width.value, closed.value>>(model, motions);
      },
      lanes);
}

}  // namespace cdcr::detail
