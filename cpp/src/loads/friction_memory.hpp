#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "loads/cable_force.hpp"

// Friction of cables that remembers, cpp/friction.md eqs. (105) to (111), on any scalar.

namespace cdcr::detail {

/// Share of the full friction up to which a cable that sticks springs back all the way.
inline constexpr double elastic_share = 0.5;
/// What a deflection loses of the way slid, where friction is beyond full; and so at most.
inline constexpr double greatest_loss = 2.0;

/// g(h) of eq. (110): what is lost of the way at a share h of the full friction.
template <class S>
[[nodiscard]] S lost_share(const S& h) {
  const S t = (h - elastic_share) * (1.0 / (1.0 - elastic_share));
  if (!(t > 0.0)) return S(0.0);
  if (t < 1.0) return t * t;
  const S beyond = 2.0 * t - 1.0;
  return beyond < greatest_loss ? beyond : S(greatest_loss);
}

/// What passes of a tension through the turn of one section, and its mean there, over the tension
/// where it enters: pulled in, and paid out. Eq. (103).
template <class S>
struct CapstanFactors {
  S decay, mean_in, growth, mean_out;

  CapstanFactors() = default;  // not set: there are as many as sections at most
  [[nodiscard]] static CapstanFactors free() {
    CapstanFactors factors;
    factors.decay = factors.mean_in = factors.growth = factors.mean_out = S(1.0);
    return factors;
  }
  explicit CapstanFactors(const S& turn) {
    using std::exp;
    decay = exp(S(-turn));
    growth = 1.0 / decay;
    if (turn < 1e-3) {
      mean_in = 1.0 - turn * (0.5 - turn * (1.0 / 6.0 - turn * (1.0 / 24.0)));
      mean_out = 1.0 + turn * (0.5 + turn * (1.0 / 6.0 + turn * (1.0 / 24.0)));
    } else {
      mean_in = (1.0 - decay) / turn;
      mean_out = (growth - 1.0) / turn;
    }
  }

  /// How much the mean falls with the section's own turn, over how much with one before it.
  [[nodiscard]] S own_share(const S& turn, bool in) const {
    if (turn < 1e-3) return in ? S(0.5 - turn / 12.0) : S(0.5 + turn / 12.0);
    return in ? S((1.0 - decay / mean_in) / turn) : S((growth / mean_out - 1.0) / turn);
  }
};

/// The mean tensions of a cable in its sections, at full sliding either way and at a friction in
/// between, eqs. (105) to (108).
template <class S>
class FrictionProfile {
 public:
  /// Tension F at the drive; factors of its sections, from `first` to `last`. With a `least`
  /// friction, shares go to zero where there is next to none, and so does what is slid.
  FrictionProfile(const S& F, double entry, double sheath_decay, const CapstanFactors<S>* factors,
                  int first, int last, double least = 0.0)
      : F_(F), first_(first), last_(last) {
    S in = F - entry, out = F + entry;
    if (!(in > 0.0)) in = S(0.0);
    if (sheath_decay < 1.0) {
      in *= sheath_decay;
      out /= sheath_decay;
    }
    for (int k = first; k <= last; ++k) {
      lost_in_[k] = F - in * factors[k].mean_in;
      lost_out_[k] = out * factors[k].mean_out - F;
      in *= factors[k].decay;
      out *= factors[k].growth;
    }
    most_in_ = F - in + least;
    most_out_ = out - F + least;
    if (most_in_ > 0.0) of_most_in_ = 1.0 / most_in_;
    if (most_out_ > 0.0) of_most_out_ = 1.0 / most_out_;
  }

  /// Full friction where the cable is pulled in, and where it is paid out [N].
  [[nodiscard]] const S& most_in() const { return most_in_; }
  [[nodiscard]] const S& most_out() const { return most_out_; }

  /// One over these, or 0 where there is none.
  [[nodiscard]] const S& of_most_in() const { return of_most_in_; }
  [[nodiscard]] const S& of_most_out() const { return of_most_out_; }

  /// Sets the friction f, within the full ones.
  void set_friction(const S& f) {
    friction_ = f;
    const S share = f * (f > 0.0 ? of_most_in_ : of_most_out_);
    const bool blends = most_in_ > 0.0 && most_out_ > 0.0;
    of_in_ = blends ? S((0.5 + 0.5 * share) * of_most_in_) : of_most_in_;
    of_out_ = blends ? S((0.5 - 0.5 * share) * of_most_out_) : of_most_out_;
  }
  [[nodiscard]] const S& friction() const { return friction_; }
  /// c_k of eq. (107): what section k misses of the tension, over the friction.
  [[nodiscard]] S share(int k) const { return of_in_ * lost_in_[k] + of_out_ * lost_out_[k]; }
  /// Mean tension in section k [N].
  [[nodiscard]] S mean(int k) const { return F_ - friction_ * share(k); }
  /// Tension at the cable's end [N].
  [[nodiscard]] S end() const { return F_ - friction_; }

 private:
  S F_, most_in_, most_out_, friction_{0.0}, of_in_{0.0}, of_out_{0.0};
  S of_most_in_{0.0}, of_most_out_{0.0};  // one over it, 0 where it is 0
  int first_, last_;
  S lost_in_[max_sections], lost_out_[max_sections];
};

/// Rate of a deflection w at a speed u, where k w is the friction that its spring asks for.
template <class S>
[[nodiscard]] S deflection_rate(const S& spring, const S& u, const FrictionProfile<S>& profile) {
  if (!(spring * u > 0.0)) return u;
  const bool in = spring > 0.0;
  const S most = in ? profile.most_in() : profile.most_out();
  const S asked = in ? spring : S(-spring);
  if (!(asked < greatest_loss * most)) return u * (1.0 - greatest_loss);
  return u * (1.0 - lost_share(S(asked * (in ? profile.of_most_in() : profile.of_most_out()))));
}

/// Friction within what is possible.
template <class S>
[[nodiscard]] S limited(const S& spring, const S& most_in, const S& most_out) {
  if (spring > most_in) return most_in;
  if (spring < -most_out) return S(-most_out);
  return spring;
}

/// Where cables run in one shape: their -dl/dq, how far they turn in each section, and what of a
/// tension passes there. Cables of arcs turn alike and mostly rub alike, so factors are kept.
template <class S>
class CableGeometry {
 public:
  CableGeometry(const CableGeometry&) = delete;  // it may point into itself
  CableGeometry& operator=(const CableGeometry&) = delete;
  ~CableGeometry() = default;
  CableGeometry(const Model& model, const S* q) : model_(model), q_(q) {
    if (model.has_rods()) return;
    using std::sqrt;
    for (Index k = 0; k < model.num_sections(); ++k) {
      const S sigma = ConstantCurvature<S>::squared_angle(q + model.first_coordinate(k));
      turn_[k] = sigma > 0.0 ? S(sqrt(sigma)) : S(0.0);
      mu_[k] = 0.0;
      factors_[k] = CapstanFactors<S>::free();
    }
  }

  /// Goes to cable j.
  void set_cable(Index j) {
    const Cable& cable = model_.cables()[static_cast<std::size_t>(j)];
    first_ = cable.start_section;
    last_ = cable.end_section;
    if (model_.has_rods()) return set_path(j);
    const double* column = model_.actuation_matrix().data() + j * model_.num_coordinates();
    if constexpr (std::is_same_v<S, double>) {
      column_ = column;
    } else {
      std::copy_n(column, model_.num_coordinates(), own_column_);
    }
    if (cable.length_driven()) {
      length_ = S(model_.straight_lengths()[j]);
      for (Index i = 0; i < model_.first_coordinate(last_ + 1); ++i) length_ -= column[i] * q_[i];
    }
    for (int k = first_; k <= last_; ++k) {
      const double mu = model_.friction()(k, j);
      if (mu != mu_[k]) set_factors(k, mu);
    }
  }

  /// How fast the cable is pulled into section k by these rates of q, or how far by changes of q.
  [[nodiscard]] S pulled_in(int k, const S* rates) const {
    const Index first = model_.first_coordinate(k), end = model_.first_coordinate(k + 1);
    if (end - first == 2)
      return column_[first] * rates[first] + column_[first + 1] * rates[first + 1];
    S sum(0.0);
    for (Index i = first; i < end; ++i) sum += column_[i] * rates[i];
    return sum;
  }
  void add_pull(int k, const S& tension, S* force) const {
    const Index first = model_.first_coordinate(k), end = model_.first_coordinate(k + 1);
    if (end - first == 2) {  // mostly: no loop for two
      force[first] += column_[first] * tension;
      force[first + 1] += column_[first + 1] * tension;
      return;
    }
    for (Index i = first; i < end; ++i) force[i] += column_[i] * tension;
  }

  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return last_; }
  /// Of a cable driven by length [m].
  [[nodiscard]] const S& length() const { return length_; }
  [[nodiscard]] const S* column() const { return column_; }
  [[nodiscard]] const S& turn(int k) const { return turn_[k]; }
  [[nodiscard]] const CapstanFactors<S>* factors() const { return factors_; }

 private:
  /// A cable through rods, whose path bends otherwise from shape to shape.
  [[gnu::noinline]] void set_path(Index j) {
    const CableSlope<S> slope(chain_of(model_), path_of(model_, j), q_);
    length_ = slope.length;
    std::copy_n(slope.column, model_.num_coordinates(), own_column_);
    for (int k = first_; k <= last_; ++k) {
      const double mu = model_.friction()(k, j);
      turn_[k] = mu > 0.0 ? path_of(model_, j).turn(chain_of(model_), k, q_) : S(0.0);
      set_factors(k, mu);
    }
  }
  void set_factors(int k, double mu) {
    mu_[k] = mu;
    factors_[k] = mu > 0.0 ? CapstanFactors<S>(S(mu * turn_[k])) : CapstanFactors<S>::free();
  }

  const Model& model_;
  const S* q_;
  int first_ = 0, last_ = 0;
  S length_{0.0};
  S own_column_[max_coordinates], turn_[max_sections];
  const S* column_ = own_column_;
  double mu_[max_sections];
  CapstanFactors<S> factors_[max_sections];
};

/// What a cable does that remembers: its tension at the drive and at its end, what friction does.
template <class S>
struct CableMotion {
  S tension, end, friction, heat;
};

/// Adds the generalised force of one cable, set in its geometry, and gives the rate of its
/// deflection.
template <class S>
CableMotion<S> add_memory_force(const Model& model, const CableGeometry<S>& at, Index j,
                                const S* qd, const S& command, const S& deflection, S* force,
                                S& rate) {
  const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
  S speeds[max_sections], speed(0.0);
  for (int k = at.first(); k <= at.last(); ++k) {
    speeds[k] = at.pulled_in(k, qd);
    speed += speeds[k];
  }
  S tension = command;
  if (cable.length_driven()) {
    tension =
        cable.stiffness * (at.length() - command - model.slack_offset()[j]) - cable.damping * speed;
    if (!(tension > 0.0)) tension = S(0.0);
  }
  FrictionProfile<S> profile(tension, cable.entry_friction, model.sheath_decay()[j], at.factors(),
                             at.first(), at.last(), model.least_friction());
  const S spring = model.robot().presliding_stiffness * deflection;
  profile.set_friction(limited(spring, profile.most_in(), profile.most_out()));
  const S viscous = cable.viscosity * speed;
  S slid(0.0);
  for (int k = at.first(); k <= at.last(); ++k) {
    const S share = profile.share(k);
    slid += share * speeds[k];
    at.add_pull(k, S(tension - profile.friction() * share - viscous), force);
  }
  rate = deflection_rate(spring, slid, profile);
  return {tension, S(profile.end() - viscous), profile.friction(),
          S(profile.friction() * slid + viscous * speed - spring * rate)};
}

/// Generalised force of all cables and the rates of their deflections.
template <class S>
void memory_force(const Model& model, const S* q, const S* qd, const S* command,
                  const S* deflection, S* force, S* rate) {
  for (Index i = 0; i < model.num_coordinates(); ++i) force[i] = S(0.0);
  CableGeometry<S> geometry(model, q);
  for (Index j = 0; j < model.num_cables(); ++j) {
    geometry.set_cable(j);
    static_cast<void>(
        add_memory_force(model, geometry, j, qd, command[j], deflection[j], force, rate[j]));
  }
}

}  // namespace cdcr::detail
