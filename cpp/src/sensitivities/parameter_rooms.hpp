#pragma once

#include <memory>
#include <vector>

#include "cdcr/parameters.hpp"
#include "chain/functions.hpp"
#include "derivatives/cholesky.hpp"

namespace cdcr {

/// The derivative with respect to one parameter is the sum of what the models give, each times its
/// weight.
struct ParameterSet::Slope {
  struct Point {
    Model model;
    double weight;
  };
  std::vector<Point> points;
  bool exact = false;    // of second degree
  bool inertia = false;  // whether M qdd + h depends on it
  bool force = false;    // whether the force of cables and wrenches does
};

/// Motion of any model of the same kind as the one, and room for what is made of it.
class ParameterData::Rooms {
 public:
  explicit Rooms(const Model& model);

  /// M qdd + h (d).
  void inverse_dynamics(const Model& model, const double* q, const double* qd,
                        const double* accelerations, double* out) noexcept;

  /// total_force of any such model in which the cables are slack that are so in the one.
  void load(const Model& model, const double* q, const double* qd, const double* command,
            const Wrenches& wrenches, double* force) noexcept;
  /// Notes which cables are slack.
  void find_slack(const Model& model, const double* q, const double* qd,
                  const double* command) noexcept;

  VectorXd qdd, force;
  detail::Cholesky mass;

 private:
  std::vector<char> slack_;                    // of each cable
  std::unique_ptr<detail::MotionState> arcs_;  // one of the two
  std::unique_ptr<detail::RodMotionState> rods_;
};

}  // namespace cdcr
