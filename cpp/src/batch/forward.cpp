#include "batch/motion_lanes.hpp"
#include "cdcr/dynamics.hpp"
#include "loads/cable_force.hpp"

namespace cdcr {
namespace {

/// The states of some rows in the lanes of packs, the last again where there are too few.
template <class P>
[[gnu::always_inline]] inline void gather(const StateRows& rows, Index first, Index last,
                                          Index size, P* to) {
  for (int lane = 0; lane < P::size; ++lane) {
    const double* from = rows.data + std::min(first + lane, last) * rows.apart;
    for (Index i = 0; i < size; ++i) set_lane(to[i], lane, from[i]);
  }
}

template <int W, bool closed>
void accelerate_all(const Model& model, Index count, const StateRows& q, const StateRows& qd,
                    const StateRows& tension, double* qdd) {
  const Index d = closed ? 2 : model.num_coordinates(), cables = model.num_cables();
  using P = typename detail::MotionLanes<W, closed>::Scalar;
  detail::MotionLanes<W, closed> lanes(model);
  std::vector<P> room(static_cast<std::size_t>(4 * d + cables));
  P *at = room.data(), *rate = at + d, *force = rate + d, *found = force + d, *pull = found + d;
  detail::in_lanes_of(std::integral_constant<int, W>(), [&](auto /*width*/) {
    for (Index first = 0; first < count; first += P::size) {
      gather(q, first, count - 1, d, at);
      gather(qd, first, count - 1, d, rate);
      gather(tension, first, count - 1, cables, pull);
      detail::actuation_force(model, pull, force);
      lanes.accelerate(at, rate, force, found);
      for (int lane = 0; lane < P::size && first + lane < count; ++lane) {
        for (Index i = 0; i < d; ++i) qdd[(first + lane) * d + i] = get_lane(found[i], lane);
      }
    }
  });
}

}  // namespace

void forward_dynamics(const Model& model, Data& data, Index count, const StateRows& q,
                      const StateRows& qd, const StateRows& tension, double* qdd) {
  if (detail::fits_lanes(model)) {
    return detail::with_motion_lanes(model, [&](auto width, auto closed) {
      accelerate_all<width.value, closed.value>(model, count, q, qd, tension, qdd);
    });
  }
  const Index d = model.num_coordinates(), cables = model.num_cables();
  using Vector = Eigen::Map<const VectorXd>;
  for (Index i = 0; i < count; ++i) {
    forward_dynamics(
        model, data, Vector(q.data + i * q.apart, d), Vector(qd.data + i * qd.apart, d),
        Vector(tension.data + i * tension.apart, cables), Eigen::Map<VectorXd>(qdd + i * d, d));
  }
}

}  // namespace cdcr
