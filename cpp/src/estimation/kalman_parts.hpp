#pragma once

#include <algorithm>
#include <vector>

#include "cdcr/kalman_filter.hpp"
#include "estimation/augmented_motion.hpp"
#include "estimation/measurement_slopes.hpp"
#include "estimation/transition.hpp"

namespace cdcr {

/// What filters share: the motion, the sensors, and values that wait for those of later ones.
struct KalmanFilter::Parts {
  /// Columns by age, so many as a value waits, and one.
  struct Waiting {
    Waiting(Index size, Index wait)
        : columns(MatrixXd::Zero(size, wait + 1)), held(static_cast<std::size_t>(wait + 1), 0) {}
    /// The column of an update, counted from reset.
    [[nodiscard]] Index at(long long update) const noexcept {
      return static_cast<Index>(update % columns.cols());
    }
    MatrixXd columns;
    std::vector<char> held;
  };

  Parts(const Model& model, const KalmanOptions& options, const VectorXd& density);
  /// Of any sensor.
  [[nodiscard]] Index most_values() const noexcept {
    Index most = 0;
    for (const detail::MeasurementSlopes& one : sensors) {
      most = std::max(most, one.value().size());
    }
    return most;
  }

  detail::AugmentedMotion motion;
  detail::Transition transition;
  std::vector<detail::MeasurementSlopes> sensors;
  Actuators actuators;
  std::vector<Waiting> waiting;  // of each sensor
  Waiting commands;
  Index late;              // how many periods the filter is behind
  long long updates = -1;  // since reset; below zero before the first
  VectorXd given, tension, due, between;
  MatrixXd slopes;
};

}  // namespace cdcr
