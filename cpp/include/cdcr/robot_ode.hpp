#pragma once

#include <vector>

#include "cdcr/command_input.hpp"
#include "cdcr/controller.hpp"
#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/status.hpp"
#include "cdcr/wrench_input.hpp"

namespace CDCR_EXPORT cdcr {

/// The robot under its cables and wrenches as one ordinary differential equation: y = (q, qd), or
/// (q, qd, w) with the deflections of cables whose friction remembers; y' = f(t, y).
///
/// Refers to the model, the input and the loads, which must outlive it. One for each thread.
class RobotOde {
 public:
  /// Throws std::invalid_argument when the robot has no inertia, the input's cables differ or a
  /// wrench is out of range.
  RobotOde(const Model& model, const CommandInput& input, const WrenchInput& loads = no_loads());
  /// Under a controller, sampled at its own period with zero-order hold. Throws also where it was
  /// made for a robot of other sizes, or gives tensions to a cable driven by length.
  RobotOde(const Model& model, Controller& controller, const WrenchInput& loads = no_loads());

  [[nodiscard]] const Model& model() const noexcept { return *model_; }  ///< as given
  [[nodiscard]] Index num_states() const noexcept {
    return 2 * model_->num_coordinates() + model_->num_deflections();
  }

  /// Begins the stretch of smooth motion that starts at t in state y: asks the controller, or
  /// moves to the input's segment. Forces that hold over the stretch are made here, once.
  Status start_segment(double t, const VectorXd& y);
  /// Where that stretch ends [s]; infinite when nothing more is to come.
  [[nodiscard]] double segment_end() const noexcept { return segment_end_; }

  /// y' at (t, y); y and dydt of num_states. Throws only when the input or a load is a function:
  /// what it throws, or std::invalid_argument when it gives a negative or non-finite value.
  void derivative(double t, const double* y, double* dydt);
  /// Brings command() and wrenches() to (t, y) within the stretch.
  void update_inputs(double t, const double* y);
  [[nodiscard]] const VectorXd& command() const noexcept { return command_; }
  [[nodiscard]] const Wrenches& wrenches() const noexcept { return wrenches_; }
  /// df/dy (num_states, num_states), column-major. Feedback in the input is left out.
  void jacobian(double t, const double* y, double* J);
  /// Commands (num_cables) at (t, y) within the stretch, [N] or [m], and the tensions that the
  /// cables then have at the base [N].
  void cables(double t, const VectorXd& y, VectorRef command, VectorRef tension);

  /// Length-driven cables, in order. Each has a pull [N] at (t, y): its tension where that is
  /// positive; where it changes sign the cable turns slack or taut.
  [[nodiscard]] const std::vector<Index>& length_driven() const noexcept { return length_driven_; }
  void pulls(double t, const double* y, double* pull);

  /// Throws std::invalid_argument unless an integrator can go from state y at t to t_stop.
  void require_stretch(double t, const VectorXd& y, double t_stop) const;
  /// check_state of y.
  [[nodiscard]] Status check(const double* y) const noexcept;

 private:
  RobotOde(const Model& model, const CommandInput* input, Controller* controller,
           const WrenchInput& loads);
  /// Brings command_ up to date.
  void update_command(double t, const ConstVectorRef& q, const ConstVectorRef& qd);
  /// y' under command_ and wrenches_ as they are, where friction remembers.
  void memory_derivative(const double* y, double* dydt) noexcept;
  /// df/dy there, by differences.
  void memory_jacobian(const double* y, double* J) noexcept;

  const Model* model_;
  const CommandInput* input_;  // one of the two
  Controller* controller_;
  const WrenchInput* loads_;
  Data data_;
  VectorXd command_, force_;
  VectorXd asked_, felt_;  // where drives have play: before it, and behind it as the segment began
  VectorXd moved_, slope_, slope_there_;  // where friction remembers
  Wrenches wrenches_;
  std::vector<Index> length_driven_;
  Index segment_ = 0;   // of the input, or periods of the controller made
  double start_ = 0.0;  // of the controller's first period
  double segment_start_ = 0.0, segment_end_ = 0.0, command_end_ = 0.0;
  bool command_holds_ = false;  // over the whole segment
};

/// ok, bending_limit or compression_limit for finite coordinates (d). Real-time safe.
[[nodiscard]] Status check_shape(const Model& model, const ConstVectorRef& q) noexcept;
/// Throws std::invalid_argument, naming the item and the section, where check_shape is not ok.
void require_shape(const char* item, const Model& model, const ConstVectorRef& q);

/// ok, wrong_size, non_finite_state, bending_limit or compression_limit for a state (q, qd) (2d).
/// Real-time safe.
[[nodiscard]] Status check_state(const Model& model, const ConstVectorRef& y) noexcept;

/// ok, or invalid_tension for a wrong size, a negative or a non-finite command. Real-time safe.
[[nodiscard]] Status check_tension(const Model& model, const ConstVectorRef& tension) noexcept;
/// Throws std::invalid_argument where check_tension is not ok.
void require_command(const Model& model, const VectorXd& command);

using Plant = RobotOde;  ///< its earlier name

}  // namespace CDCR_EXPORT cdcr
