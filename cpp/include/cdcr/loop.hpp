#pragma once

#include <memory>
#include <vector>

#include "cdcr/actuator.hpp"
#include "cdcr/controller.hpp"
#include "cdcr/estimator.hpp"
#include "cdcr/export.hpp"
#include "cdcr/sensor.hpp"
#include "cdcr/simulate.hpp"
#include "cdcr/simulator.hpp"

namespace cdcr::detail {
class PlantBase;
}

namespace CDCR_EXPORT cdcr {

class LoopLog;

struct LoopOptions {
  double step = 1e-3;               ///< of the plant [s]; all periods are whole numbers of it
  int substeps = 1;                 ///< equal steps of the method in each
  Method method = Method::rk4;      ///< of the plant: rk4 or rosenbrock, as of Simulator
  std::vector<Actuator> actuators;  ///< none, one for all cables, or one for each
  std::vector<Sensor> sensors;  ///< without one of coordinates or of rates, these are known exactly
};

/// A closed loop: the robot, its actuators and sensors and a controller, each at its own period.
///
/// In a step sensors measure, the estimator and the controller are asked where their time has come,
/// actuators move, and the robot moves under what they give. Set up: the constructor and reset
/// allocate and throw std::invalid_argument. Run: step is real-time safe where the controller is;
/// the same loop gives the same bits. After a failure the last good state stays, and each further
/// step gives the same status until reset. It refers to controller and estimator, which must
/// outlive it.
class Loop {
 public:
  Loop(const Model& plant, Controller& controller, LoopOptions options = {},
       Estimator* estimator = nullptr);
  ~Loop();
  Loop(Loop&&) noexcept;
  Loop& operator=(Loop&&) noexcept;

  /// State (d each) and time [s] at the start. Actuators give `command` (num_cables) there; by
  /// default what leaves the straight robot alone.
  void reset(const VectorXd& q, const VectorXd& qd, double start = 0.0,
             const VectorXd& command = {});

  [[nodiscard]] Status step() noexcept { return step(no_wrenches()); }
  [[nodiscard]] Status step(const Wrenches& wrenches) noexcept;
  /// The same, asking now and then whether to stop: Status::interrupted then.
  [[nodiscard]] Status step(const Wrenches& wrenches, const Interrupt& stop) noexcept;

  /// Writes each further step to a log that was made for this loop, which must outlive it; null: to
  /// none. Throws std::invalid_argument for a log of other columns.
  void set_log(LoopLog* log);

  [[nodiscard]] const Simulator& plant() const noexcept { return plant_; }
  [[nodiscard]] const VectorXd& q() const noexcept { return plant_.q(); }    ///< (d) [rad]
  [[nodiscard]] const VectorXd& qd() const noexcept { return plant_.qd(); }  ///< (d) [rad/s]
  [[nodiscard]] double time() const noexcept { return plant_.time(); }       ///< [s]
  /// What the controller last asked for, and what the cables then got (num_cables) [N], [m].
  [[nodiscard]] const VectorXd& asked() const noexcept { return asked_; }
  [[nodiscard]] const VectorXd& given() const noexcept { return actuators_.given(); }
  /// The state that the controller is told (d each).
  [[nodiscard]] const VectorXd& told_q() const noexcept { return told_q_; }
  [[nodiscard]] const VectorXd& told_qd() const noexcept { return told_qd_; }
  [[nodiscard]] const std::vector<SensorChannel>& sensors() const noexcept { return sensors_; }
  /// What they tell the estimator.
  [[nodiscard]] const std::vector<Measurement>& told() const noexcept { return told_; }
  [[nodiscard]] Status status() const noexcept { return status_; }
  [[nodiscard]] Controller& controller() const noexcept { return *controller_; }
  [[nodiscard]] Estimator* estimator() const noexcept { return estimator_; }  ///< null: none
  [[nodiscard]] const LoopOptions& options() const noexcept { return options_; }

 private:
  [[nodiscard]] Status close(const Wrenches& wrenches, const Interrupt& stop) noexcept;
  [[nodiscard]] Status look(const Wrenches& wrenches) noexcept;

  LoopOptions options_;
  Simulator plant_;
  Controller* controller_;
  Estimator* estimator_;
  Actuators actuators_;
  std::vector<SensorChannel> sensors_;
  std::unique_ptr<detail::PlantBase> base_;  // where a sensor feels it
  VectorXd on_base_;                         // and what it feels (6)
  std::vector<Measurement> told_;
  Index every_, estimator_every_ = 1;  // steps in a period of controller and estimator
  VectorXd asked_, trial_, tension_, told_q_, told_qd_;
  Status status_ = Status::not_started;
  LoopLog* log_ = nullptr;
};

/// A run of a loop, sampled.
struct LoopRun : Trajectory {
  RowMatrixXd asked;              ///< by the controller (N, num_cables), [N] or [m]
  RowMatrixXd reference;          ///< of the controller, Controller::reference_names (N, ...)
  RowMatrixXd told_q, told_qd;    ///< to the controller (N, d)
  std::vector<RowMatrixXd> told;  ///< by each sensor (N, its size)
  VectorXd durations;             ///< of the controller's last update (N) [s]
  RowMatrixXd estimated;          ///< what else the estimator has, Estimator::value_names (N, ...)
  RowMatrixXd deviations;         ///< standard deviations of that, 0 where it has none
  VectorXd innovation;            ///< of the estimator's last update (N), EstimatorDiagnostics
  VectorXd measured;              ///< values in it (N)
};

/// Steps a loop that has been reset over a duration [s], a whole number of steps; a sample at the
/// start, though it fails there, and after every so many of them. What holds over the step that
/// begins at a sample stands in its row; in the last row, of which no step begins, what held
/// before. Throws std::invalid_argument.
[[nodiscard]] LoopRun run(Loop& loop, double duration, Index record_every = 1,
                          const Wrenches& wrenches = no_wrenches(), const Interrupt& stop = {});

}  // namespace CDCR_EXPORT cdcr
