#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "cases.hpp"
#include "cdcr/dynamics.hpp"
#include "chain/functions.hpp"
#include "chain_cases.hpp"
#include "rods.hpp"

// What the battery of laws is tried on: the functions of motion of a robot, by the public functions
// or by the recursions over sections of one kind.
//
// Every subject is made of a robot of arcs, as which it moves where it has as many coordinates;
// select() gives those that stand for the coordinates of that robot, or for a force on them.

namespace cdcr::test {

class Subject {
 public:
  virtual ~Subject() = default;

  [[nodiscard]] virtual VectorXd select(const VectorXd& whole) const { return whole; }
  /// False of a subject that has more coordinates than its robot of arcs; select() then spreads
  /// theirs over its own.
  [[nodiscard]] virtual bool moves_as_arcs() const { return true; }
  /// The force of damping at these rates, those of the robot of arcs being `whole`.
  [[nodiscard]] virtual VectorXd damped(const Model& model, const VectorXd& whole) const {
    VectorXd force(whole.size());
    for (Index i = 0; i < model.num_sections(); ++i) {
      force.segment(2 * i, 2) = model.damping()[i] * whole.segment(2 * i, 2);
    }
    return select(force);
  }

  [[nodiscard]] virtual Index size() const = 0;
  virtual MatrixXd mass_matrix(const VectorXd& q) = 0;
  virtual VectorXd bias(const VectorXd& q, const VectorXd& qd) = 0;
  virtual VectorXd inverse(const VectorXd& q, const VectorXd& qd, const VectorXd& qdd) = 0;
  virtual VectorXd forward(const VectorXd& q, const VectorXd& qd, const VectorXd& force) = 0;
  virtual double kinetic(const VectorXd& q, const VectorXd& qd) = 0;
  virtual double potential(const VectorXd& q) = 0;
  virtual VectorXd gradient(const VectorXd& q) = 0;
};

/// The public functions: one section without a payload in closed form.
class Library final : public Subject {
 public:
  static constexpr int m = 2;

  explicit Library(const Model& model) : model_(model), data_(model) {}

  [[nodiscard]] Index size() const override { return model_.num_coordinates(); }
  MatrixXd mass_matrix(const VectorXd& q) override {
    MatrixXd M(size(), size());
    cdcr::mass_matrix(model_, data_, q, M);
    return M;
  }
  VectorXd bias(const VectorXd& q, const VectorXd& qd) override {
    VectorXd h(size());
    cdcr::bias(model_, data_, q, qd, h);
    return h;
  }
  VectorXd inverse(const VectorXd& q, const VectorXd& qd, const VectorXd& qdd) override {
    VectorXd force(size());
    inverse_dynamics(model_, data_, q, qd, qdd, force);
    return force;
  }
  VectorXd forward(const VectorXd& q, const VectorXd& qd, const VectorXd& force) override {
    VectorXd qdd(size());
    forward_dynamics_force(model_, data_, q, qd, force, qdd);
    return qdd;
  }
  double kinetic(const VectorXd& q, const VectorXd& qd) override {
    return kinetic_energy(model_, data_, q, qd);
  }
  double potential(const VectorXd& q) override { return potential_energy(model_, data_, q); }
  VectorXd gradient(const VectorXd& q) override {
    VectorXd gradient(size());
    potential_gradient(model_, data_, q, gradient);
    return gradient;
  }

 private:
  Model model_;
  Data data_;
};

/// The recursions over sections of one kind.
template <class Section>
class Recursion : public Subject {
 public:
  static constexpr int m = Section::m;

  explicit Recursion(detail::Chain chain)
      : chain_(std::move(chain)), state_(std::make_unique<detail::ChainState<Section>>()) {}

  [[nodiscard]] Index size() const override { return chain_.num_coordinates(); }
  MatrixXd mass_matrix(const VectorXd& q) override {
    detail::update_position(chain_, *state_, q.data());
    MatrixXd M(size(), size());
    detail::mass_matrix(chain_, *state_, M);
    return M;
  }
  VectorXd bias(const VectorXd& q, const VectorXd& qd) override {
    VectorXd h(size());
    detail::update_motion(chain_, *state_, q.data(), qd.data());
    detail::inverse_motion(chain_, *state_, nullptr, h.data());
    return h;
  }
  VectorXd inverse(const VectorXd& q, const VectorXd& qd, const VectorXd& qdd) override {
    VectorXd force(size());
    detail::update_motion(chain_, *state_, q.data(), qd.data());
    detail::inverse_motion(chain_, *state_, qdd.data(), force.data());
    return force;
  }
  VectorXd forward(const VectorXd& q, const VectorXd& qd, const VectorXd& force) override {
    VectorXd qdd(size());
    detail::update_position(chain_, *state_, q.data());
    detail::update_velocity(chain_, *state_, qd.data());
    detail::forward_motion(chain_, *state_, force.data(), qdd.data());
    return qdd;
  }
  double kinetic(const VectorXd& q, const VectorXd& qd) override {
    detail::update_motion(chain_, *state_, q.data(), qd.data());
    return detail::kinetic_energy(chain_, *state_, qd.data());
  }
  double potential(const VectorXd& q) override {
    detail::update_position(chain_, *state_, q.data());
    return detail::potential_energy(chain_, *state_, q.data());
  }
  VectorXd gradient(const VectorXd& q) override {
    VectorXd gradient(size());
    detail::update_position(chain_, *state_, q.data());
    detail::weight_gradient(chain_, *state_, q.data(), gradient.data());
    return gradient;
  }

 protected:
  detail::Chain chain_;

 private:
  std::unique_ptr<detail::ChainState<Section>> state_;
};

struct Arcs final : Recursion<detail::ConstantCurvature<double>> {
  explicit Arcs(const Model& model) : Recursion(detail::Chain(model.robot())) {}
};

/// Rods of these orders in place of arcs; those of order 0 alone move as arcs.
template <int bending_order, int twist_order, int stretch_order>
struct Rods final : Recursion<detail::Rod<double>> {
  static constexpr int m = 2 * (bending_order + 1) + twist_order + 1 + stretch_order + 1;

  explicit Rods(const Model& model)
      : Recursion(chain_of_rods(detail::Chain(model.robot()), described(model.robot()))) {}

  [[nodiscard]] bool moves_as_arcs() const override { return m == 2; }
  [[nodiscard]] VectorXd select(const VectorXd& whole) const override {
    VectorXd all = VectorXd::Zero(size());
    for (Index i = 0; i < chain_.num_sections(); ++i) {
      const double x = whole[2 * i], y = whole[2 * i + 1];
      for (int k = 0; k < m; k += 2) {  // less of each order than of the one before
        const double share = std::pow(0.5, k / 2);
        all[m * i + k] = share * (k % 4 == 0 ? x : -y);
        if (k + 1 < m) all[m * i + k + 1] = share * (k % 4 == 0 ? y : x);
      }
      for (int k = m - 1 - stretch_order; k < m; ++k) {
        all[m * i + k] *= 0.1 * chain_.sections[static_cast<std::size_t>(i)].rod->length;
      }
    }
    return all;
  }
  [[nodiscard]] VectorXd damped(const Model&, const VectorXd& whole) const override {
    VectorXd force = select(whole);
    for (Index i = 0; i < chain_.num_sections(); ++i) {
      force.segment(m * i, m).array() *=
          chain_.sections[static_cast<std::size_t>(i)].rod->damping.array();
    }
    return force;
  }

 private:
  static std::vector<detail::RodDescription> described(const Robot& robot) {
    std::vector<detail::RodDescription> rods;
    for (const cdcr::Section& section : robot.sections) {
      rods.push_back(described_rod(section, bending_order, twist_order, stretch_order));
      // As exact as an arc, bent by a full turn.
      if (m == 2) rods.back().num_nodes = detail::max_rod_nodes;
    }
    return rods;
  }
};

/// A state of a subject, and the same of the robot of arcs that it is made of.
struct LawState {
  ChainState whole;
  VectorXd q, qd;
  double weight;  // size of the terms of weight in U and dU/dq [N m]
};

using LawBody = std::function<void(Subject&, const Model&, const LawState&)>;

template <class Kind>
void for_each_of(const char* kind, const std::vector<int>& numbers, const LawBody& body) {
  Random random;
  std::vector<NamedRobot> robots;
  // A point on the tip alone has not enough inertia for more than two coordinates.
  if (Kind::m == 2) robots = sample_robots(random);
  for (const int n : numbers) {
    robots.push_back({std::to_string(n) + " sections", random_chain(random, n)});
  }
  for (const NamedRobot& sample : robots) {
    const Model model(sample.robot);
    Kind subject(model);
    const double weight = static_cast<double>(ChainSum(model.robot()).weight_scale()[0]);
    for (const ChainState& whole : chain_states(model, random)) {
      INFO(random, ", ", kind, ", robot: ", sample.name, ", state: ", whole.name);
      body(subject, model,
           LawState{whole, subject.select(whole.q), subject.select(whole.qd), weight});
    }
  }
}

/// body(subject, model, state) for every kind: the sample robots, where sections of the kind can
/// carry them, and random chains of these numbers of sections, in sample states.
inline void for_each_subject(const std::vector<int>& numbers, const LawBody& body) {
  for_each_of<Library>("public functions", numbers, body);
  for_each_of<Arcs>("arcs", numbers, body);
  for_each_of<Rods<0, -1, -1>>("rods of order 0", numbers, body);
  for_each_of<Rods<2, 1, 0>>("rods", numbers, body);
}

}  // namespace cdcr::test
