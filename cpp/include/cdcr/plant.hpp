#pragma once

#include "cdcr/controller.hpp"
#include "cdcr/model.hpp"
#include "cdcr/status.hpp"
#include "cdcr/tension_input.hpp"

namespace cdcr {

/// The robot under its tensions as one ordinary differential equation: y = (q, qd), y' = f(t, y).
///
/// Refers to the model and the input, which must outlive it. One plant for each thread.
class Plant {
 public:
  /// Throws std::invalid_argument when the robot has no inertia or the input's cables differ.
  Plant(const Model& model, const TensionInput& input);
  /// Under a controller, sampled at its own period with zero-order hold.
  Plant(const Model& model, Controller& controller);

  [[nodiscard]] const Model& model() const noexcept { return *model_; }
  [[nodiscard]] Index num_states() const noexcept { return 2 * model_->num_coordinates(); }

  /// Begins the stretch of smooth motion that starts at t in state y: asks the controller, or
  /// moves to the input's segment. Tensions that hold over the stretch become a force here, once.
  Status start_segment(double t, const VectorXd& y);
  /// Where that stretch ends [s]; infinite when nothing more is to come.
  [[nodiscard]] double segment_end() const noexcept { return segment_end_; }

  /// y' at (t, y); y and dydt of num_states. Throws only when the input is a function: what it
  /// throws, or std::invalid_argument when it gives a negative or non-finite tension.
  void derivative(double t, const double* y, double* dydt);
  /// df/dy (num_states, num_states), column-major. Feedback in the input is left out.
  void jacobian(double t, const double* y, double* J);
  /// Tensions (num_cables) [N] at (t, y) within the stretch.
  void tension(double t, const VectorXd& y, VectorRef tension);

  /// check_state of y.
  [[nodiscard]] Status check(const double* y) const noexcept;

 private:
  Plant(const Model& model, const TensionInput* input, Controller* controller, Index num_cables);
  /// Brings tension_ and force_ up to date.
  void update_force(double t, const ConstVectorRef& q, const ConstVectorRef& qd);

  const Model* model_;
  const TensionInput* input_;  // one of the two
  Controller* controller_;
  Data data_;
  VectorXd tension_, force_;
  Index segment_ = 0;   // of the input, or periods of the controller made
  double start_ = 0.0;  // of the controller's first period
  double segment_end_ = 0.0;
  bool force_holds_ = false;  // over the whole segment
};

/// ok, non_finite_state or bending_limit for a state (q, qd) (4n). Real-time safe.
[[nodiscard]] Status check_state(const Model& model, const ConstVectorRef& y) noexcept;

/// ok, or invalid_tension for a wrong size, a negative or a non-finite tension. Real-time safe.
[[nodiscard]] Status check_tension(const Model& model, const ConstVectorRef& tension) noexcept;

}  // namespace cdcr
