#include "loads/base_wrench.hpp"

#include "base/sizes.hpp"
#include "chain/inertia.hpp"
#include "chain/reach.hpp"
#include "dynamics/parts.hpp"

namespace cdcr {
namespace {

using detail::Vector3;

/// Takes from a wrench (6) the rate of momentum less the weight of all that moves, from base to
/// tip, cpp/base-wrench.md eq. (123). `section` is room for one at a time.
template <class Section, class S = typename Section::Scalar>
void take_inertia(const detail::Chain& chain, Section& section, const S* q, const S* qd,
                  const S* qdd, S* wrench) noexcept {
  using Vectorm = typename Section::Vectorm;
  using Matrix3m = typename Section::Matrix3m;
  detail::FrameState<S> at = detail::root_of<S>(chain);
  Vector3<S> p = Vector3<S>::Zero(), alpha = p, force = p, moment = p;
  // At a base at rest weight is an acceleration upwards.
  Vector3<S> v = -chain.gravity.template cast<S>();
  const auto add = [&](const Vector3<S>& f, const Vector3<S>& m) {
    force += f;
    moment += m + p.cross(f);
  };
  for (Index i = 0; i < chain.num_sections(); ++i) {
    const detail::SectionParameters& fixed = chain.sections[i];
    const Index first = chain.first[i], size = chain.first[i + 1] - first;
    section.update_position(fixed, at, q + first);
    section.template update_velocity<true>(fixed, at.omega, qd + first);
    const Vectorm rate = Eigen::Map<const Vectorm>(qdd + first, size);
    const Vector3<S> h = section.first_moment();
    const Matrix3m H = section.linear_coupling(), N = section.angular_coupling();
    add(section.force + fixed.mass * v + alpha.cross(h) + H.lazyProduct(rate),
        section.moment + section.second_moment().lazyProduct(alpha) + h.cross(v) +
            N.lazyProduct(rate));
    v += alpha.cross(section.r) + section.J_v.lazyProduct(rate) + section.tip_linear_bias;
    alpha += section.J_omega.lazyProduct(rate) + section.tip_angular_bias;
    p += section.r;
    const Vector3<S> omega = section.turning_rate();
    at = section.end();
    at.omega = omega;
  }
  const auto payload = detail::articulated_payload(chain.payload, at);
  add(payload.force + payload.G.transpose() * alpha + payload.M * v,
      payload.moment + payload.J * alpha + payload.G * v);
  for (int c = 0; c < 3; ++c) {
    wrench[c] -= force[c];
    wrench[3 + c] -= moment[c];
  }
}

/// f(place of a wrench from the base, force, moment), all in the base frame.
template <class F>
void with_wrench(const Model& model, const ConstVectorRef& q, const Wrench& w, const F& f) {
  detail::with_reach(detail::chain_of(model), q.data(), w.section, w.fraction,
                     [&](const auto& reach) {
                       const bool local = w.frame == Wrench::Frame::local;
                       f(reach, local ? reach.frame.rotate(w.force) : w.force,
                         local ? reach.frame.rotate(w.moment) : w.moment);
                     });
}

}  // namespace

void base_wrench(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& qdd, const Wrenches& wrenches, VectorRef wrench) noexcept {
  assert(detail::of_coordinates(model, q, qd, qdd) && detail::has_size(wrench, 6, 1));
  assert(check_wrenches(model, wrenches) == Status::ok);
  const detail::Chain& chain = detail::chain_of(model);
  wrench.setZero();
  if (chain.has_rods()) {
    detail::Rod<double> section;
    take_inertia(chain, section, q.data(), qd.data(), qdd.data(), wrench.data());
  } else {
    detail::ConstantCurvature<double> section;
    take_inertia(chain, section, q.data(), qd.data(), qdd.data(), wrench.data());
  }
  for (const Wrench& w : wrenches) {
    with_wrench(model, q, w, [&](const auto& reach, const Vector3d& f, const Vector3d& m) {
      wrench.head<3>() += f;
      wrench.tail<3>() += m + reach.p.cross(f);
    });
  }
}

namespace detail {

void add_wrench_slopes(const Model& model, const ConstVectorRef& q, const Wrenches& wrenches,
                       MatrixRef slopes) noexcept {
  assert(of_coordinates(model, q) && has_size(slopes, 6, model.num_coordinates()));
  for (const Wrench& w : wrenches) {
    const bool local = w.frame == Wrench::Frame::local;
    with_wrench(model, q, w, [&](const auto& reach, const Vector3d& f, const Vector3d& m) {
      for (Index i = 0; i <= reach.last; ++i) {
        const auto& part = reach.parts[i];
        for (Index k = 0; k < part.J_omega.cols(); ++k) {
          const Vector3d turning = part.J_omega.col(k);
          const Vector3d moving =
              part.J_v.col(k) + turning.cross(Vector3d(reach.p - reach.ends[i]));
          auto column = slopes.col(model.first_coordinate(i) + k);
          column.template tail<3>() += moving.cross(f);
          if (!local) continue;
          column.template head<3>() += turning.cross(f);
          column.template tail<3>() += turning.cross(m) + reach.p.cross(turning.cross(f));
        }
      }
    });
  }
}

}  // namespace detail
}  // namespace cdcr
