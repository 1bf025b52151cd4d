#pragma once

#include <algorithm>
#include <type_traits>

#include "loads/cable_force.hpp"
#include "loads/friction_lanes.hpp"
#include "loads/friction_profile.hpp"

// Forces of cables whose friction remembers, cpp/friction.md eqs. (105) to (111), on any scalar.

namespace cdcr::detail {

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
    set_ways(j);
  }

  /// How fast the cable is pulled into section k by these rates of q, or how far by changes of q.
  [[nodiscard]] S pulled_in(int k, const S* rates) const {
    const Index first = model_.first_coordinate(k), end = model_.first_coordinate(k + 1);
    if (end - first == 2)  // mostly: no loop for two
      return column_[first] * rates[first] + column_[first + 1] * rates[first + 1];
    S sum(0.0);
    for (Index i = first; i < end; ++i) sum += column_[i] * rates[i];
    return sum;
  }
  /// Adds what a tension in section k pulls.
  void add_pull(int k, const S& tension, S* force) const {
    for (Index i = model_.first_coordinate(k); i < model_.first_coordinate(k + 1); ++i) {
      force[i] += column_[i] * tension;
    }
  }

  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return last_; }
  /// Of a cable driven by length [m].
  [[nodiscard]] const S& length() const { return length_; }
  [[nodiscard]] const S* column() const { return column_; }
  [[nodiscard]] const S& turn(int k) const { return turn_[k]; }
  /// Of each section alone, and from the cable's entry through each.
  [[nodiscard]] const CapstanFactors<S>& factors(int k) const { return factors_[k]; }
  [[nodiscard]] const CapstanFactors<S>* ways() const { return ways_; }

 private:
  /// A cable through rods, whose path bends otherwise from shape to shape.
  [[gnu::noinline]] void set_path(Index j) {
    const CableSlope<S> slope(chain_of(model_), path_of(model_, j), q_);
    length_ = slope.length;
    std::copy_n(slope.column, model_.num_coordinates(), own_column_);
    for (int k = first_; k <= last_; ++k) {
      turn_[k] =
          model_.friction()(k, j) > 0.0 ? path_of(model_, j).turn(chain_of(model_), k, q_) : S(0.0);
      mu_[k] = -1.0;
    }
    set_ways(j);
  }
  /// Those that are known from another cable stay.
  void set_ways(Index j) {
    if (known_from_ != first_) known_to_ = first_ - 1;
    known_from_ = first_;
    for (int k = first_; k <= last_; ++k) {
      const double mu = model_.friction()(k, j);
      if (k <= known_to_ && mu == mu_[k]) continue;
      // Not read from where it was just stored: that waits.
      CapstanFactors<S> own;
      if (mu == mu_[k]) {
        own = factors_[k];
      } else {
        own = mu > 0.0 ? CapstanFactors<S>(S(mu * turn_[k])) : CapstanFactors<S>::free();
        mu_[k] = mu;
        factors_[k] = own;
      }
      ways_[k] = k == first_ ? own : own.after(ways_[k - 1]);
      known_to_ = k;
    }
  }

  const Model& model_;
  const S* q_;
  int first_ = 0, last_ = 0;
  S length_{0.0};
  S own_column_[max_coordinates], turn_[max_sections];
  const S* column_ = own_column_;
  double mu_[max_sections];
  CapstanFactors<S> factors_[max_sections], ways_[max_sections];
  int known_from_ = 0, known_to_ = -1;  // sections whose ways hold
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
  const CapstanFactors<S>* ways = at.ways();
  // Of the speeds at which it is pulled into its sections: their sum, and those of their shares.
  S speed(0.0), lost_speed(0.0), gained_speed(0.0);
  for (int k = at.first(); k <= at.last(); ++k) {
    const S pulled = at.pulled_in(k, qd);
    speed += pulled;
    lost_speed += ways[k].mean_lost * pulled;
    gained_speed += ways[k].mean_gained * pulled;
  }
  S tension = command;
  if (cable.length_driven()) {
    tension =
        cable.stiffness * (at.length() - command - model.slack_offset()[j]) - cable.damping * speed;
    if (!(tension > 0.0)) tension = S(0.0);
  }
  FrictionProfile<S> profile(tension, S(cable.entry_friction), S(model.sheath_decay()[j]),
                             ways[at.last()], S(model.least_friction()));
  const S spring = model.robot().presliding_stiffness * deflection;
  profile.set_friction(limited(spring, profile.most_in(), profile.most_out()));
  const S viscous = cable.viscosity * speed;
  const Shares<S> shares = profile.shares();
  const S slid = shares.of(speed, lost_speed, gained_speed), friction = profile.friction();
  const S at_entry = tension - viscous - friction * shares.at_entry, lost = friction * shares.lost,
          gained = friction * shares.gained;
  for (int k = at.first(); k <= at.last(); ++k) {
    const S mean = at_entry - lost * ways[k].mean_lost - gained * ways[k].mean_gained;
    at.add_pull(k, mean, force);
  }
  rate = deflection_rate(spring, slid, profile);
  return {tension, S(profile.end() - viscous), friction,
          S(friction * slid + viscous * speed - spring * rate)};
}

/// Generalised force of all cables and the rates of their deflections.
template <class S>
void memory_force(const Model& model, const S* q, const S* qd, const S* command,
                  const S* deflection, S* force, S* rate) {
  if constexpr (std::is_same_v<S, double>) {
    if (!model.has_rods() && model.num_deflections() > 0)
      return memory_force_of_arcs(model, q, qd, command, deflection, force, rate);
  }
  for (Index i = 0; i < model.num_coordinates(); ++i) force[i] = S(0.0);
  CableGeometry<S> geometry(model, q);
  for (Index j = 0; j < model.num_cables(); ++j) {
    geometry.set_cable(j);
    static_cast<void>(
        add_memory_force(model, geometry, j, qd, command[j], deflection[j], force, rate[j]));
  }
}

}  // namespace cdcr::detail
