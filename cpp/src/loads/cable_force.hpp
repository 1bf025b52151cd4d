#pragma once

#include <cmath>

#include "cdcr/model.hpp"
#include "dynamics/parts.hpp"
#include "loads/friction_entry.hpp"
#include "section/constant_curvature.hpp"

// Forces of cables, cpp/several-sections.md eqs. (36) to (39) and cpp/rods.md eqs. (63) to (67), on
// any scalar.

namespace cdcr::detail {

[[nodiscard]] inline bool is_length_driven(const Model& model, Index cable) noexcept {
  return model.cables()[static_cast<std::size_t>(cable)].length_driven();
}

/// Rate at which the part of a cable in a section shortens, or with q in place of qd its change.
template <class S>
[[nodiscard]] S shortening(const Model& model, Index cable, Index section, const S* rate) {
  S sum(0.0);
  for (Index i = model.first_coordinate(section); i < model.first_coordinate(section + 1); ++i) {
    sum += model.actuation_matrix()(i, cable) * rate[i];
  }
  return sum;
}

/// Length that a cable driven by length misses, l - l_commanded and what its pretension adds [m];
/// negative when it hangs slack.
template <class S>
[[nodiscard]] S elongation(const Model& model, Index j, const S* q, const S& command) {
  if (model.has_rods()) {
    return CableSlope<S>(chain_of(model), path_of(model, j), q).length - command -
           model.slack_offset()[j];
  }
  S length(model.straight_lengths()[j] - model.slack_offset()[j]);
  for (Index k = 0; k <= model.cables()[static_cast<std::size_t>(j)].end_section; ++k) {
    length -= shortening(model, j, k, q);
  }
  return length - command;
}

/// Pull of a length-driven cable's spring and damper; negative where it would have to push.
template <class S>
[[nodiscard]] S spring_force(const Model& model, Index j, const S* q, const S* qd,
                             const S& command) {
  const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
  if (model.has_rods()) {
    const CableSlope<S> slope(chain_of(model), path_of(model, j), q);
    return cable.stiffness * (slope.length - command - model.slack_offset()[j]) +
           cable.damping * slope.rate(chain_of(model), qd);
  }
  S rate(0.0);
  for (Index k = 0; k <= cable.end_section; ++k) rate -= shortening(model, j, k, qd);
  return cable.stiffness * elongation(model, j, q, command) + cable.damping * rate;
}

/// Tension at the base, eq. (36).
template <class S>
[[nodiscard]] S base_tension(const Model& model, Index j, const S* q, const S* qd,
                             const S& command) {
  if (!is_length_driven(model, j)) return command;
  const S pull = spring_force(model, j, q, qd, command);
  return pull > 0.0 ? pull : S(0.0);
}

/// (1 - e^-z)/z = e^-h sinh(h)/h with h = z/2, which loses no digits.
template <class S>
[[nodiscard]] S mean_decay(const S& z) {
  using std::abs;
  using std::exp;
  using std::sinh;
  const S h = 0.5 * z, decay = exp(S(-h));
  if (abs(z) < 1e-2) return decay * (1.0 + h * h * (1.0 / 6.0 + h * h / 120.0));
  return decay * sinh(h) / h;
}

/// Shift of the centre of weights e^-zx on [0, 1] from 1/2 towards 0, coth(h)/2 - 1/z.
template <class S>
[[nodiscard]] S centre_shift(const S& z) {
  using std::abs;
  using std::tanh;
  if (abs(z) < 1e-2) return z * (1.0 / 12.0 - z * z * (1.0 / 720.0 - z * z / 30240.0));
  return 0.5 / tanh(S(0.5 * z)) - 1.0 / z;
}

template <class S>
[[nodiscard]] S larger(const S& a, const S& b) {
  return a < b ? b : a;
}
template <class S>
[[nodiscard]] S smaller(const S& a, const S& b) {
  return b < a ? b : a;
}

/// Adds the generalised force of one cable that rubs in its holes, eqs. (37) to (39).
///
/// Within section k the tension falls as e^-zx with z = mu theta_k s. The direction s comes from
/// the cable's speed v(x) through the holes, which is linear in x. What friction takes is
/// mu theta_k s times the integral of e^-zx v; so s follows the mean of v where that has the sign
/// of the weighted mean, and is zero in the small gap where it has not: friction never gives
/// work. The tension that is left beyond each section goes to `beyond_sections` where that is
/// wanted.
template <class S>
void add_capstan_force(const Model& model, Index j, const S* q, const S* qd,
                       const S& tension_at_base, S* force, S* beyond_sections = nullptr) {
  using std::sqrt;
  using std::tanh;
  const MatrixXd& B = model.actuation_matrix();
  const auto end = static_cast<Index>(model.cables()[static_cast<std::size_t>(j)].end_section);
  S beyond(0.0);  // rate of the length from here to the cable's end
  for (Index k = 0; k <= end; ++k) beyond -= shortening(model, j, k, qd);
  S tension = entry_tension(model, j, tension_at_base, S(-beyond));
  for (Index k = 0; k <= end; ++k) {
    const S rate = -shortening(model, j, k, qd);
    const Index first = model.first_coordinate(k), next = model.first_coordinate(k + 1);
    const S sigma = ConstantCurvature<S>::squared_angle(q + first);
    const double mu = model.friction()(k, j);
    S effective = tension;
    if (mu > 0.0 && sigma > 0.0) {
      const S turn = mu * sqrt(sigma);
      const S mean = beyond - 0.5 * rate;
      const S shift = rate * centre_shift(turn);
      const S none(0.0), forward = mean + shift, backward = mean - shift;
      const S speed = smaller(larger(mean, forward), none) + larger(smaller(mean, backward), none);
      const S z = turn * tanh(S(speed * (-1.0 / model.robot().sliding_speed)));
      effective = tension * mean_decay(z);
      using std::exp;
      tension = tension * exp(S(-z));
    }
    for (Index i = first; i < next; ++i) force[i] += B(i, j) * effective;
    beyond -= rate;
    if (beyond_sections != nullptr) beyond_sections[k] = tension;
  }
}

/// The force of a cable through rods; the tension that is left beyond each section goes to
/// `beyond_sections` where that is wanted.
template <class S>
void add_rod_cable_force(const Model& model, Index j, const S* q, const S* qd, const S& tension,
                         S* force, S* beyond_sections = nullptr) {
  const Chain& chain = chain_of(model);
  const CablePath& path = path_of(model, j);
  if (!model.has_friction() && beyond_sections == nullptr) {
    static_cast<void>(path.length(chain, q, tension, force));
    return;
  }
  const S rate = CableSlope<S>(chain, path, q).rate(chain, qd);
  path.rub(chain, q, qd, model.friction().data() + j * model.num_sections(),
           model.robot().sliding_speed, entry_tension(model, j, tension, S(-rate)), rate, force,
           beyond_sections);
}

/// Q = B F. Cables pull alike on every section from the base to their end, so each pulls on the one
/// it ends on, and what a section feels is passed on to the one before. Cables of rods, and those
/// that begin farther out, are added up one by one.
template <class S>
void actuation_force(const Model& model, const S* tension, S* force) {
  const double* column = model.actuation_matrix().data();
  const Index d = model.num_coordinates();
  const Index m = model.first_coordinate(1);
  for (Index i = 0; i < d; ++i) force[i] = S(0.0);
  if (!model.has_nested_cables()) {
    for (Index j = 0; j < model.num_cables(); ++j, column += d) {
      const Index rows = model.cable_rows()[static_cast<std::size_t>(j)];
      for (Index i = 0; i < rows; ++i) force[i] += column[i] * tension[j];
    }
    return;
  }
  for (Index j = 0; j < model.num_cables(); ++j, column += d) {
    const Index rows = model.cable_rows()[static_cast<std::size_t>(j)];
    for (Index i = rows - m; i < rows; ++i) force[i] += column[i] * tension[j];
  }
  for (Index i = d - m - 1; i >= 0; --i) force[i] += force[i + m];
}

/// Q = B F of one section, whose sums stay in registers.
template <class S>
void single_actuation_force(const Model& model, const S* tension, S* force) noexcept {
  const double* B = model.actuation_matrix().data();
  S x(0.0), y(0.0);
  for (Index j = 0; j < model.num_cables(); ++j) {
    x += B[2 * j] * tension[j];
    y += B[2 * j + 1] * tension[j];
  }
  force[0] = x;
  force[1] = y;
}

/// Adds the generalised force of one cable with this tension at the base.
template <class S>
void add_pulled_force(const Model& model, Index j, const S* q, const S* qd, const S& tension,
                      S* force) {
  if (model.has_rods()) return add_rod_cable_force(model, j, q, qd, tension, force);
  if (model.has_friction()) return add_capstan_force(model, j, q, qd, tension, force);
  const Index rows = model.cable_rows()[static_cast<std::size_t>(j)];
  for (Index i = 0; i < rows; ++i) force[i] += model.actuation_matrix()(i, j) * tension;
}

/// Adds the generalised force of one cable.
template <class S>
void add_cable_force(const Model& model, Index j, const S* q, const S* qd, const S& command,
                     S* force) {
  add_pulled_force(model, j, q, qd, base_tension(model, j, q, qd, command), force);
}

/// Adds those of all cables that tensions drive through rods, without friction. The sum of tensions
/// times lengths.
template <class S>
S add_smooth_forces(const Model& model, const S* q, const S* tension, S* force) {
  const Chain& chain = chain_of(model);
  S work(0.0);
  for (Index k = 0; k < chain.num_sections(); ++k) {
    with_fma<S>([&] {
      RodCables<S> cables(*chain.sections[k].rod, q + chain.first[k], force + chain.first[k]);
      for (Index j = 0; j < model.num_cables(); ++j) {
        const RodCable* cable = path_of(model, j).in(k);
        if (cable == nullptr || is_length_driven(model, j)) continue;
        work += tension[j] * cables.add(*cable, tension[j]);
      }
      cables.finish();
    });
  }
  return work;
}

/// Generalised force of all cables.
template <class S>
void cable_force(const Model& model, const S* q, const S* qd, const S* command, S* force) {
  if (model.has_plain_cables()) return actuation_force(model, command, force);
  for (Index i = 0; i < model.num_coordinates(); ++i) force[i] = S(0.0);
  const bool together = model.has_rods() && !model.has_friction();
  if (together) static_cast<void>(add_smooth_forces(model, q, command, force));
  for (Index j = 0; j < model.num_cables(); ++j) {
    if (together && !is_length_driven(model, j)) continue;
    add_cable_force(model, j, q, qd, command[j], force);
  }
}

}  // namespace cdcr::detail
