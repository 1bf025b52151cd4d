#pragma once

#include "cdcr/cable_drive.hpp"
#include "cdcr/controller.hpp"
#include "cdcr/export.hpp"
#include "cdcr/reference_path.hpp"

namespace CDCR_EXPORT cdcr {

/// Limits of what a controller asks of the cables.
struct CommandLimits {
  TensionLimits tension;
  double max_rate = std::numeric_limits<double>::infinity();  ///< of a command [N/s], [m/s], > 0
};

/// A controller with a model that follows a reference and keeps its commands within limits.
///
/// What it derives from this is a law alone, `control`: this class looks at the reference, refuses
/// states that are none, measures how long it took, and holds the CableDrive of the commands. Set
/// up: constructor, set_reference and set_path may allocate and throw std::invalid_argument.
class TrackingController : public Controller {
 public:
  /// What a reference is of: the coordinates (d) [rad]; the tip's position (3) [m]; that and the
  /// tip's orientation, a rotation vector (6) [m], [rad]. Both of the tip are in the base frame.
  enum class Follows { coordinates, position, pose };
  [[nodiscard]] Follows follows() const noexcept { return follows_; }

  /// What to reach and hold (reference_size), the same at all times.
  void set_reference(const VectorXd& value) { set_path(ReferencePath::constant(value)); }
  /// A motion to follow, over the time of the run.
  void set_path(const ReferencePath& path);
  [[nodiscard]] const ReferencePath& path() const noexcept { return path_; }
  /// What is followed at the last update; before it, at the start of the path.
  [[nodiscard]] const Setpoint& setpoint() const noexcept { return setpoint_; }

  void reset() noexcept override;
  /// What it remembers of a run: a controller made alike that takes it up goes on as this one
  /// would. Not real-time safe.
  [[nodiscard]] virtual VectorXd memory() const;
  /// Throws std::invalid_argument where that is not of a controller made alike.
  virtual void set_memory(const VectorXd& memory);
  void hold(const ConstVectorRef& command) noexcept override { drive_.hold(command); }
  [[nodiscard]] Status update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                              VectorRef command) noexcept final;
  [[nodiscard]] double period() const noexcept override { return drive_.period(); }
  [[nodiscard]] Index num_coordinates() const noexcept override {
    return model().num_coordinates();
  }
  [[nodiscard]] Index num_cables() const noexcept override { return model().num_cables(); }
  [[nodiscard]] const Model* reckons_with() const noexcept override { return &model(); }
  [[nodiscard]] ControlDiagnostics diagnostics() const noexcept override { return diagnostics_; }
  [[nodiscard]] std::vector<std::string> reference_names() const override;
  void write_reference(VectorRef values) const noexcept override { values = setpoint_.value; }
  [[nodiscard]] const CommandLimits& limits() const noexcept { return limits_; }

 protected:
  TrackingController(const Model& model, double period, CommandLimits limits,
                     Follows follows = Follows::coordinates);

  /// The law: finds the drive's commands for a finite state; a force (d) it wants goes to `give`.
  virtual Status control(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                         const Setpoint& wanted) noexcept = 0;
  /// Throws std::invalid_argument where it cannot follow that: another size, values not finite or,
  /// of coordinates, beyond what the robot bends.
  virtual void accept(const ReferencePath& path);

  /// Asks the drive for a force; true when it is met. Notes what is missing.
  bool give(const ConstVectorRef& q, const ConstVectorRef& qd,
            const ConstVectorRef& force) noexcept;
  /// The same by tensions near to `preferred`.
  bool give(const ConstVectorRef& q, const ConstVectorRef& qd, const ConstVectorRef& force,
            const ConstVectorRef& preferred) noexcept;
  void note_error(double error) noexcept { diagnostics_.error = error; }

  [[nodiscard]] const Model& model() const noexcept { return drive_.model(); }
  [[nodiscard]] CableDrive& drive() noexcept { return drive_; }
  [[nodiscard]] const CableDrive& drive() const noexcept { return drive_; }

 private:
  bool note(bool met, const ConstVectorRef& force) noexcept;

  CommandLimits limits_;
  Follows follows_;
  CableDrive drive_;
  ReferencePath path_;
  Setpoint setpoint_;
  ControlDiagnostics diagnostics_;
};

}  // namespace CDCR_EXPORT cdcr
