#pragma once

#include <functional>
#include <vector>

#include "cdcr/integrator.hpp"

namespace cdcr::detail {

/// A function that changed its sign.
struct Crossing {
  double time = 0.0;
  Index function = 0;
  bool rising = false;
};

/// Finds where functions of time and state change sign within the steps of an integrator, on the
/// interpolant that it gives: also twice within one step, where the function is smooth enough.
class Crossings {
 public:
  /// Writes the values of all functions at (t, y); may throw.
  using Values = std::function<void(double t, const VectorXd& y, VectorRef values)>;

  /// Values within `dead_band` (one for each function) of zero have not changed sign yet.
  Crossings(VectorXd dead_band, Index num_states, Values values);

  /// Starts at (t, y); lists the functions that a jump has taken to the other side.
  const std::vector<Crossing>& start(double t, const VectorXd& y);
  /// Goes on from (t, y), within the last step.
  void resume(double t, const VectorXd& y);
  /// Lists the crossings within the step just made, which began at `begin`, in order of time.
  const std::vector<Crossing>& find(Integrator& integrator, double begin);
  /// Takes a crossing for made: from now on the function is looked at from its other side.
  void accept(const Crossing& crossing);

 private:
  struct Point {
    double time, value;
  };

  double value(Integrator& integrator, double t, Index function);
  void add_extremes(Integrator& integrator, Index function);
  double locate(Integrator& integrator, Point before, Point after, Index function);

  Values evaluate_;
  VectorXd dead_band_, signs_, values_, y_;
  MatrixXd nodes_;  // a column of values for each node of a step
  std::vector<Point> points_;
  std::vector<Crossing> found_;
};

}  // namespace cdcr::detail
