#pragma once

#include "chain/functions.hpp"
#include "derivatives/motion_derivatives.hpp"
#include "derivatives/rod_rates.hpp"
#include "derivatives/weight_hessian.hpp"

// The functions of MotionDerivatives, for the two files that make them of their kind of section.
// NOLINTBEGIN(readability-identifier-naming): letters of the equations

namespace cdcr::detail {

[[nodiscard]] inline Index size_of(const Chain& chain, Index section) {
  return chain.first[section + 1] - chain.first[section];
}
/// The part of a section.
template <class Vectorm>
[[nodiscard]] Eigen::Map<const Vectorm> part_of(const Chain& chain, Index section,
                                                const double* x) {
  return {x + chain.first[section], size_of(chain, section)};
}
template <class Columns>
[[nodiscard]] Quad dot(const Columns& columns, Index c, const Vector3<Quad>& v) {
  return columns(0, c) * v[0] + columns(1, c) * v[1] + columns(2, c) * v[2];
}
/// to + a x r, in registers: what Eigen makes of it is not.
inline void add_cross(Vector3<Quad>& to, const Vector3<Quad>& a, const Vector3d& r) {
  const Quad x = a[1] * r[2] - a[2] * r[1];
  const Quad y = a[2] * r[0] - a[0] * r[2];
  const Quad z = a[0] * r[1] - a[1] * r[0];
  to[0] += x;
  to[1] += y;
  to[2] += z;
}
[[nodiscard]] inline Vector3<Quad> slopes_of(const Vector3<Dual>& v) {
  return {v[0].slopes, v[1].slopes, v[2].slopes};
}
[[nodiscard]] inline Vector3<Quad> in_lanes(const Vector3d& v) {
  return v.cast<Quad>();
}
[[nodiscard]] inline Vector3<Dual> constant(const Vector3d& v) {
  return v.cast<Dual>();
}

template <template <class> class Kind>
MotionDerivatives<Kind>::MotionDerivatives(const Chain& chain, Index num_commands)
    : lanes(chain, num_commands),
      rows(static_cast<std::size_t>(chain.num_coordinates() * lanes.width())),
      qdd(chain.num_coordinates()),
      mass_(chain.num_coordinates()),
      bodies_(chain.sections.size()),
      pushes_(3, chain.num_coordinates()),
      twists_(3, chain.num_coordinates()),
      gyros_(3, chain.num_coordinates()),
      motions_(static_cast<std::size_t>(lanes.num_state_quads())),
      loads_(motions_.size()) {}

template <template <class> class Kind>
void MotionDerivatives<Kind>::update(const Chain& chain, const ChainState<Section>& state,
                                     const double* q, const double* qd,
                                     const double* force) noexcept {
  with_fma<double>([&] {
    add_up_mass(chain, state);
    mass_.factorize();
  });
  inverse_motion(chain, state, nullptr, qdd.data());
  with_fma<double>([&] {
    for (Index i = 0; i < qdd.size(); ++i) qdd[i] = force[i] - qdd[i];
    mass_.solve(qdd.data());
    accelerate(chain, state, qd);
    differentiate_inwards(chain, state, q, qd);
    differentiate_outwards(chain, state);
    clear_commands();
  });
}

template <template <class> class Kind>
void MotionDerivatives<Kind>::solve(Index width) noexcept {
  with_fma<double>([&] { mass_.solve(rows.data(), lanes.width(), width); });
}

/// The mass matrix, and what accelerations of each coordinate ask of its section's base.
template <template <class> class Kind>
void MotionDerivatives<Kind>::add_up_mass(const Chain& chain, const ChainState<Section>& state) {
  MatrixXd& M = mass_.matrix;
  Articulated<double> outboard = articulated_payload(chain.payload, state.tip);
  for (Index i = chain.num_sections() - 1; i >= 0; --i) {
    const Section& section = state.sections[i];
    const Index at = chain.first[i], size = size_of(chain, i);
    Matrix3m F =
        outboard.G.transpose().lazyProduct(section.J_omega) + outboard.M.lazyProduct(section.J_v);
    Matrix3m T = outboard.J.lazyProduct(section.J_omega) + outboard.G.lazyProduct(section.J_v);
    M.block<Section::m, Section::m>(at, at, size, size) =
        section.own_mass() + section.J_omega.transpose().lazyProduct(T) +
        section.J_v.transpose().lazyProduct(F);
    for (Index k = 0; k < size; ++k) T.col(k) += section.r.cross(F.col(k));
    F += section.linear_coupling();
    T += section.angular_coupling();
    pushes_.middleCols<Section::m>(at, size) = F;
    twists_.middleCols<Section::m>(at, size) = T;
    for (Index k = 0; k < size; ++k) {
      const Vector3d f = F.col(k);
      Vector3d t = T.col(k);
      for (Index j = i - 1; j >= 0; --j) {
        const Section& before = state.sections[j];
        Eigen::Map<Vectorm>(&M(chain.first[j], at + k), size_of(chain, j)) =
            before.J_omega.transpose().lazyProduct(t) + before.J_v.transpose().lazyProduct(f);
        t += before.r.cross(f);
      }
    }
    shift(outboard, section.r);
    add_section(outboard, chain.sections[i].mass, section);
  }
}

/// Accelerations of all bases and tips.
template <template <class> class Kind>
void MotionDerivatives<Kind>::accelerate(const Chain& chain, const ChainState<Section>& state,
                                         const double* qd) {
  Vector3d alpha = Vector3d::Zero(), a = -chain.gravity;  // weight: an acceleration upwards
  for (Index i = 0; i < chain.num_sections(); ++i) {
    const Section& section = state.sections[i];
    Body& body = bodies_[i];
    const auto rate = part_of<Vectorm>(chain, i, qd);
    const auto acceleration = part_of<Vectorm>(chain, i, qdd.data());
    body.alpha = alpha;
    body.a = a;
    body.moving = section.base.omega.cross(section.r) + section.J_v.lazyProduct(rate);
    a += alpha.cross(section.r) + section.J_v.lazyProduct(acceleration) + section.tip_linear_bias;
    alpha += section.J_omega.lazyProduct(acceleration) + section.tip_angular_bias;
    body.tip_alpha = alpha;
    body.tip_a = a;
    body.tip_omega = section.turning_rate();
  }
}

/// Rows of each section for its own lanes and for those of the sections that it carries.
template <template <class> class Kind>
void MotionDerivatives<Kind>::differentiate_inwards(const Chain& chain,
                                                    const ChainState<Section>& state,
                                                    const double* q, const double* qd, bool base) {
  Outboard outboard(chain.payload, state.tip, bodies_[chain.num_sections() - 1].tip_alpha,
                    bodies_[chain.num_sections() - 1].tip_a);
  for (Index i = chain.num_sections() - 1; i >= 0; --i) {
    const Section& section = state.sections[i];
    carry_loads(chain, section, i);
    Matrix3d J_own = Matrix3d::Zero();
    if (i == 0 && !base) {
      return differentiate_section<false>(chain, section, i, q, qd, outboard, J_own);
    }
    set_gyros(section, outboard, i, chain.first[i], size_of(chain, i));
    differentiate_section<true>(chain, section, i, q, qd, outboard, J_own);
    if (i == 0) return;
    outboard.shift(section.r, bodies_[i].moving);
    outboard.add(chain.sections[i].mass, section, part_of<Vectorm>(chain, i, qd),
                 part_of<Vectorm>(chain, i, qdd.data()), bodies_[i].alpha, bodies_[i].a, J_own);
  }
}

/// Rows of a section for the lanes of those beyond its tip, whose loads move to its base.
template <template <class> class Kind>
void MotionDerivatives<Kind>::carry_loads(const Chain& chain, const Section& section, Index i) {
  const Vector3d back = -section.r;
  for (Index g = lanes.first_quad(i + 1); g < lanes.num_state_quads(); ++g) {
    Load& load = loads_[g];
    for (Index c = 0; c < size_of(chain, i); ++c) {
      rows[(chain.first[i] + c) * lanes.width() + g] =
          -(dot(section.J_omega, c, load.T) + dot(section.J_v, c, load.F));
    }
    add_cross(load.T, load.F, back);
  }
}

/// The share of what lies beyond the tip in what turning rates ask, eq. (78).
template <template <class> class Kind>
void MotionDerivatives<Kind>::set_gyros(const Section& section, const Outboard& outboard, Index i,
                                        Index first, Index size) {
  const Vector3d& moving = bodies_[i].moving;
  const Vector3d momentum = outboard.P + outboard.mass * moving;
  for (Index c = 0; c < size; ++c) {
    const Vector3d turn = section.J_omega.col(c), move = section.J_v.col(c);
    gyros_.col(first + c) =
        2.0 * (momentum.cross(move) + moving.cross(Vector3d(turn.cross(outboard.h)))) +
        outboard.J_rate.lazyProduct(turn) + outboard.L.cross(turn);
  }
}

/// A section on dual numbers, four directions at a time: its own rows, and what its base and its
/// tip do to the others.
template <template <class> class Kind>
template <bool turns>
void MotionDerivatives<Kind>::differentiate_section(const Chain& chain, const Section& section,
                                                    Index i, const double* q, const double* qd,
                                                    const Outboard& outboard, Matrix3d& J_own) {
  const SectionParameters& fixed = chain.sections[i];
  const Index at = chain.first[i], m = size_of(chain, i);
  const Body& body = bodies_[i];
  const auto acceleration = part_of<Vectorm>(chain, i, qdd.data());
  const auto rate = part_of<Vectorm>(chain, i, qd);
  const Vector3d& omega = section.base.omega;
  Inputs in;
  in.base = {constant(section.base.x), constant(section.base.y), constant(section.base.z),
             constant(omega)};
  for (Index k = 0; k < m; ++k) {
    in.q[k] = Dual(q[at + k]);
    in.qd[k] = Dual(qd[at + k]);
  }
  for (Index g = lanes.first_quad(i), first = 0; g < lanes.first_quad(i + 1);
       ++g, first += Quad::count) {
    const Index num_seeds = std::min<Index>(Quad::count, (rates_apart ? m : 2 * m) - first);
    const auto seed = [&](double slope) {
      for (int lane = 0; lane < num_seeds; ++lane) {
        const Index k = first + lane;
        (k < m ? in.q[k] : in.qd[k - m]).slopes[lane] = slope;
      }
    };
    Vector3<Quad> turn = in_lanes(Vector3d::Zero());  // of what the tip carries
    for (int lane = 0; lane < Quad::count && first + lane < m; ++lane) {
      for (int c = 0; c < 3; ++c) turn[c][lane] = section.J_omega(c, first + lane);
    }
    OwnSlopes slopes;
    slopes.clear();
    if (num_seeds > 0) {
      seed(1.0);
      place(dual, fixed, in.base, in.q.data());
      dual.template update_velocity<turns>(fixed, constant(omega), in.qd.data());
      seed(0.0);
      const typename DualSection::Matrix3m H = dual.linear_coupling();
      typename DualSection::Vectorm force =
          dual.bias + dual.own_mass().lazyProduct(acceleration) + H.transpose().lazyProduct(body.a);
      Vector3<Dual> tip_a = dual.J_v.lazyProduct(acceleration) + dual.tip_linear_bias;
      if constexpr (turns) {
        const typename DualSection::Matrix3m N = dual.angular_coupling();
        const Matrix3<Dual> J = dual.second_moment();
        const Vector3<Dual> h = dual.first_moment();
        force += N.transpose().lazyProduct(body.alpha);
        tip_a += body.alpha.cross(dual.r);
        const Vector3<Dual> push = dual.force + H.lazyProduct(acceleration) + body.alpha.cross(h);
        const Vector3<Dual> twist =
            dual.moment + N.lazyProduct(acceleration) + J.lazyProduct(body.alpha) + h.cross(body.a);
        slopes.push = slopes_of(push);
        slopes.twist = slopes_of(twist);
        const Vector3<Dual> momentum = J.lazyProduct(omega) + N.lazyProduct(rate);
        for (int lane = 0; lane < Quad::count && first + lane < m; ++lane) {
          const Index k = first + lane;
          for (int c = 0; c < 3; ++c) {
            gyros_(c, at + k) -= momentum[c].slopes[lane];
            for (Index l = 0; l < m; ++l) gyros_(c, at + l) += N(c, l).slopes[lane] * rate[k];
            for (int l = 0; l < 3; ++l) J_own(c, l) += J(c, l).slopes[lane] * rate[k];
          }
        }
      }
      for (Index c = 0; c < m; ++c) slopes.force[c] = force[c].slopes;
      slopes.tip_alpha = slopes_of(dual.J_omega.lazyProduct(acceleration) + dual.tip_angular_bias);
      slopes.tip_a = slopes_of(tip_a);
      slopes.tip_omega = slopes_of(dual.turning_rate());
    }
    if constexpr (rates_apart) {
      for (Index lane = std::max<Index>(0, m - first); lane < Quad::count && first + lane < 2 * m;
           ++lane) {
        differentiate_by_rate<turns>(fixed, section, rate, first + lane - m, static_cast<int>(lane),
                                     slopes);
      }
    }

    // What is carried: turned as it is, and accelerated otherwise, eqs. (73) to (76).
    const Vector3<Quad> tip_omega = in_lanes(body.tip_omega);
    Motion& motion = motions_[g];
    motion.w = slopes.tip_omega - turn.cross(tip_omega);
    motion.e = slopes.tip_alpha - turn.cross(in_lanes(body.tip_alpha)) + tip_omega.cross(motion.w);
    motion.b = slopes.tip_a - turn.cross(in_lanes(body.tip_a));
    const Vector3<Quad> F = turn.cross(in_lanes(outboard.F)) + outboard.force_of(motion);
    const Vector3<Quad> T = turn.cross(in_lanes(outboard.T)) + outboard.moment_of(motion);
    for (Index c = 0; c < m; ++c) {
      Quad row = slopes.force[c] + dot(section.J_omega, c, T) + dot(section.J_v, c, F);
      for (int l = 0; num_seeds > 0 && l < 3; ++l) {
        row += dual.J_omega(l, c).slopes * outboard.T[l] + dual.J_v(l, c).slopes * outboard.F[l];
      }
      rows[(at + c) * lanes.width() + g] = -row;
    }
    if constexpr (turns) {
      loads_[g] = {slopes.push + F, slopes.twist + T + in_lanes(section.r).cross(F)};
      if (num_seeds > 0) loads_[g].T += slopes_of(dual.r).cross(in_lanes(outboard.F));
    }
  }
  if constexpr (turns) {
    const Matrix3m N = section.angular_coupling();
    for (Index c = 0; c < m; ++c) gyros_.col(at + c) += omega.cross(N.col(c));
  }
}

/// Slopes with respect to one rate. Terms from velocities alone are of second degree in these once
/// the elastic force is left out, so their central difference has no error but rounding.
template <template <class> class Kind>
template <bool turns>
void MotionDerivatives<Kind>::differentiate_by_rate(const SectionParameters& fixed,
                                                    const Section& section, const Vectorm& qd,
                                                    Index k, int lane, OwnSlopes& slopes) {
  const Vector3d& omega = section.base.omega;
  if (k == 0) {
    moved_ = section;
    moved_.elastic.setZero();
  }
  const double step = std::max({1.0, qd.cwiseAbs().maxCoeff(), omega.norm()});
  Vectorm rates = qd;
  for (const double side : {1.0, -1.0}) {
    rates[k] = qd[k] + side * step;
    update_rates(moved_, fixed, omega, rates.data(), turns);
    const double share = side / (2.0 * step);
    for (Index c = 0; c < qd.size(); ++c) slopes.force[c][lane] += share * moved_.bias[c];
    for (int c = 0; c < 3; ++c) {
      slopes.tip_alpha[c][lane] += share * moved_.tip_angular_bias[c];
      slopes.tip_a[c][lane] += share * moved_.tip_linear_bias[c];
      if (turns) slopes.push[c][lane] += share * moved_.force[c];
      if (turns) slopes.twist[c][lane] += share * moved_.moment[c];
    }
  }
  for (int c = 0; c < 3; ++c) slopes.tip_omega[c][lane] += section.J_omega(c, k);
}

/// Rows of sections for the lanes of those that carry them, whose motions move to their tips.
template <template <class> class Kind>
void MotionDerivatives<Kind>::differentiate_outwards(const Chain& chain,
                                                     const ChainState<Section>& state) {
  for (Index i = 1; i < chain.num_sections(); ++i) {
    const Vector3d r = state.sections[i].r, moving = 2.0 * bodies_[i].moving;
    for (Index g = 0; g < lanes.first_quad(i); ++g) {
      Motion& motion = motions_[g];
      for (Index c = chain.first[i]; c < chain.first[i + 1]; ++c) {
        rows[c * lanes.width() + g] =
            -(dot(pushes_, c, motion.b) + dot(twists_, c, motion.e) + dot(gyros_, c, motion.w));
      }
      add_cross(motion.b, motion.e, r);
      add_cross(motion.b, motion.w, moving);
    }
  }
}

template <template <class> class Kind>
void MotionDerivatives<Kind>::clear_commands() {
  for (Index i = 0; i < qdd.size(); ++i) {
    for (Index g = lanes.num_state_quads(); g < lanes.width(); ++g) {
      rows[i * lanes.width() + g] = Quad(0.0);
    }
  }
}

}  // namespace cdcr::detail

// NOLINTEND(readability-identifier-naming)
