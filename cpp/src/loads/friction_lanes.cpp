#include "loads/friction_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/pack.hpp"
#include "dynamics/parts.hpp"
#include "loads/friction_profile.hpp"

namespace cdcr::detail {
namespace {

/// Forces of cables in one shape of a robot of arcs, W cables at once.
template <int W>
class ForcesOfArcs {
 public:
  using S = Pack<W>;

  ForcesOfArcs(const Model& model, const double* q, const double* qd)
      : model_(model), cables_(model.parts()->cable_lanes), q_(q), qd_(qd) {
    for (Index k = 0; k < model.num_sections(); ++k) {
      turn_[k] = std::sqrt(q[2 * k] * q[2 * k] + q[2 * k + 1] * q[2 * k + 1]);
      const double mu = cables_.alike[k];
      if (mu >= 0.0) alike_[k] = factors(mu * turn_[k]);
      force_[2 * k] = force_[2 * k + 1] = S(0.0);
    }
  }

  /// Cables from j on.
  void add(Index j, const double* commands, const double* deflections, double* rates) {
    const auto four = static_cast<std::size_t>(j / CableLanes::together);
    const int first = cables_.first[four], last = cables_.last[four];
    CapstanFactors<S> way = CapstanFactors<S>::free();
    S mean_lost[max_sections], mean_gained[max_sections];
    // Of the speeds at which cables are pulled into sections: their sum, and those of their shares.
    S speed(0.0), lost_speed(0.0), gained_speed(0.0);
    for (int k = first; k <= last; ++k) {
      const CapstanFactors<S> own = factors_of(j, k);
      way = own.after(way);
      mean_lost[k] = way.mean_lost;
      mean_gained[k] = way.mean_gained;
      const S pulled = pulled_in(j, k, qd_);
      speed += pulled;
      lost_speed += way.mean_lost * pulled;
      gained_speed += way.mean_gained * pulled;
    }
    S tension = commanded(commands, j);
    if (cables_.driven[four]) {
      S longer = at(cables_.taut_from, j) - tension;
      for (int k = first; k <= last; ++k) longer -= pulled_in(j, k, q_);
      const S stiffness = at(cables_.stiffness, j);
      const S pull = stiffness * longer - at(cables_.damping, j) * speed;
      tension = choose(stiffness > S(0.0), choose(pull > S(0.0), pull, S(0.0)), tension);
    }
    FrictionProfile<S> profile(tension, at(cables_.entry, j), at(cables_.sheath_decay, j), way,
                               S(model_.least_friction()));
    const S spring = S(model_.robot().presliding_stiffness) * commanded(deflections, j);
    profile.set_friction(limited(spring, profile.most_in(), profile.most_out()));
    const Shares<S>& shares = profile.shares();
    const S& friction = profile.friction();
    const S at_entry = tension - at(cables_.viscosity, j) * speed - friction * shares.at_entry;
    const S lost = friction * shares.lost, gained = friction * shares.gained;
    for (int k = first; k <= last; ++k) {
      const S mean = at_entry - lost * mean_lost[k] - gained * mean_gained[k];
      force_[2 * k] += at(cables_.columns, j, 2 * k) * mean;
      force_[2 * k + 1] += at(cables_.columns, j, 2 * k + 1) * mean;
    }
    const S slid = shares.of(speed, lost_speed, gained_speed);
    write(deflection_rate(spring, slid, profile), j, rates);
  }

  void get(double* force) const {
    for (Index i = 0; i < model_.num_coordinates(); ++i) {
      force[i] = 0.0;
      for (Index lane = 0; lane < W; ++lane) force[i] += get_lane(force_[i], lane);
    }
  }

 private:
  [[nodiscard]] static CapstanFactors<double> factors(double z) {
    return z > 0.0 ? CapstanFactors<double>(z) : CapstanFactors<double>::free();
  }
  [[nodiscard]] static S load(const double* from) {
    S pack;
    std::memcpy(&pack.lanes, from, sizeof pack.lanes);
    return pack;
  }
  [[nodiscard]] static S at(const VectorXd& numbers, Index j) { return load(numbers.data() + j); }
  [[nodiscard]] static S at(const MatrixXd& numbers, Index j, Index column) {
    return load(numbers.data() + column * numbers.rows() + j);
  }
  [[nodiscard]] S pulled_in(Index j, Index k, const double* rates) const {
    return at(cables_.columns, j, 2 * k) * S(rates[2 * k]) +
           at(cables_.columns, j, 2 * k + 1) * S(rates[2 * k + 1]);
  }
  [[nodiscard]] CapstanFactors<S> factors_of(Index j, int k) const {
    if (cables_.alike[k] >= 0.0) {
      const S rubs = at(cables_.rubs, j, k);
      const CapstanFactors<double>& one = alike_[k];
      return {rubs * S(one.lost), rubs * S(one.mean_lost), rubs * S(one.gained),
              rubs * S(one.mean_gained)};
    }
    CapstanFactors<double> each[W];
    for (Index lane = 0; lane < W; ++lane) {
      each[lane] = factors(cables_.friction(j + lane, k) * turn_[k]);
    }
    return {S::of_lanes([&](Index lane) { return each[lane].lost; }),
            S::of_lanes([&](Index lane) { return each[lane].mean_lost; }),
            S::of_lanes([&](Index lane) { return each[lane].gained; }),
            S::of_lanes([&](Index lane) { return each[lane].mean_gained; })};
  }
  /// Of what there is for true cables alone.
  [[nodiscard]] S commanded(const double* numbers, Index j) const {
    const Index size = model_.num_cables();
    if (j + W <= size) return load(numbers + j);
    return S::of_lanes([&](Index lane) { return j + lane < size ? numbers[j + lane] : 0.0; });
  }
  void write(const S& pack, Index j, double* numbers) const {
    const Index size = model_.num_cables();
    if (j + W <= size) {
      std::memcpy(numbers + j, &pack.lanes, sizeof pack.lanes);
      return;
    }
    for (Index lane = 0; j + lane < size; ++lane) numbers[j + lane] = get_lane(pack, lane);
  }

  const Model& model_;
  const CableLanes& cables_;
  const double *q_, *qd_;
  double turn_[max_sections];
  CapstanFactors<double> alike_[max_sections];
  S force_[2 * max_sections];
};

}  // namespace

CableLanes::CableLanes(const Model& model) {
  const Index m = model.num_cables(), n = model.num_sections();
  const Index fours = (m + together - 1) / together, size = fours * together;
  columns = MatrixXd::Zero(size, model.num_coordinates());
  columns.topRows(m) = model.actuation_matrix().transpose();
  friction = MatrixXd::Zero(size, n);
  friction.topRows(m) = model.friction().transpose();
  rubs = (friction.array() > 0.0).cast<double>();
  alike = friction.colwise().maxCoeff().transpose();
  for (Index k = 0; k < n; ++k) {
    if (friction.col(k) != alike[k] * rubs.col(k)) alike[k] = -1.0;
  }
  sheath_decay = VectorXd::Ones(size);
  sheath_decay.head(m) = model.sheath_decay();
  taut_from = VectorXd::Zero(size);
  taut_from.head(m) = model.straight_lengths() - model.slack_offset();
  entry = stiffness = damping = viscosity = VectorXd::Zero(size);
  first.assign(static_cast<std::size_t>(fours), static_cast<int>(n));
  last.assign(static_cast<std::size_t>(fours), -1);
  driven.assign(static_cast<std::size_t>(fours), false);
  for (Index j = 0; j < m; ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    entry[j] = cable.entry_friction;
    viscosity[j] = cable.viscosity;
    const auto four = static_cast<std::size_t>(j / together);
    first[four] = std::min(first[four], cable.start_section);
    last[four] = std::max(last[four], cable.end_section);
    if (!cable.length_driven()) continue;
    stiffness[j] = cable.stiffness;
    damping[j] = cable.damping;
    driven[four] = true;
  }
}

double least_friction(const Model& model) noexcept {
  double least = HUGE_VAL;
  for (Index k = 0; k < model.num_sections(); ++k) {
    if (model.robot().sections[static_cast<std::size_t>(k)].bending_order < 0) continue;
    const auto levers = model.actuation_matrix().middleRows(model.first_coordinate(k), 2);
    const double arm = levers.size() > 0 ? levers.cwiseAbs().maxCoeff() : 0.0;
    if (arm > 0.0) least = std::fmin(least, 1e-4 * model.stiffness()[k] / arm);
  }
  return std::isfinite(least) ? least : 0.0;
}

void memory_force_of_arcs(const Model& model, const double* q, const double* qd,
                          const double* command, const double* deflection, double* force,
                          double* rate, int lanes) noexcept {
  const auto add_up = [&](auto width) {
    ForcesOfArcs<width> forces(model, q, qd);
    for (Index j = 0; j < model.num_cables(); j += width) {
      forces.add(j, command, deflection, rate);
    }
    forces.get(force);
  };
  with_lanes([&](auto width) { in_lanes_of(width, add_up); }, lanes);
}

}  // namespace cdcr::detail
