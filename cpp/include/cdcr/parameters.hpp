#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// One number that a robot depends on.
struct Parameter {
  std::string name;                       ///< what messages call it
  double value = 0.0;                     ///< that the robot has
  std::function<Robot(double)> robot_at;  ///< the robot with another value; called at set-up
  double scale = 0.0;                     ///< a size of it that matters; 0: |value|, or 1
};

/// Two robots that differ in one number, as models, and by how much.
struct ParameterSides {
  std::string name;
  Model above, below;
  double width = 0.0;
};

/// Parameters of a model, with the models beside it that their derivatives are made of
/// (cpp/sensitivities.md eqs. (116) to (118)).
///
/// The equations of motion are polynomials of second degree in masses, stiffnesses, damping,
/// gravity and the like: their derivative is a difference of two, exact to rounding. Of all else,
/// such as lengths and diameters, it is a difference of eighth order, good to about 1e-12. Which of
/// the two a parameter needs is found at set-up, from three states. The constructor throws
/// std::invalid_argument where a parameter may not change, and where it changes what kind of robot
/// it is. Afterwards a set never changes, so any number of threads may read it.
class ParameterSet {
 public:
  ParameterSet(const Model& model, const std::vector<Parameter>& parameters);
  /// Of differences of two given models beside the one, so far from each other in the parameter:
  /// quicker to make, and as accurate as such differences are.
  ParameterSet(const Model& model, const std::vector<ParameterSides>& parameters);

  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(names_.size()); }
  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  /// Whether the derivative with respect to a parameter is exact to rounding.
  [[nodiscard]] bool is_exact(Index parameter) const noexcept;

  /// Of one parameter, models beside the one and what each counts; private to the library.
  struct Slope;
  [[nodiscard]] const std::vector<Slope>& slopes() const noexcept { return *slopes_; }

 private:
  Model model_;
  std::shared_ptr<const std::vector<Slope>> slopes_;  // shared by copies of a set
  std::vector<std::string> names_;
};

/// Scratch space of a model and its parameters. One for each thread.
class ParameterData {
 public:
  explicit ParameterData(const Model& model);
  ParameterData(ParameterData&& other) noexcept;
  ParameterData& operator=(ParameterData&& other) noexcept;
  ~ParameterData();

  class Rooms;
  [[nodiscard]] Rooms& rooms() noexcept { return *rooms_; }

 private:
  std::unique_ptr<Rooms> rooms_;
};

/// d(M qdd + h - Q)/dp (d, size) at a state, accelerations and commands that stay: by how much the
/// generalised force that they need changes, and that of the cables and wrenches less. Real-time
/// safe.
void imbalance_derivatives(const ParameterSet& parameters, ParameterData& room,
                           const ConstVectorRef& q, const ConstVectorRef& qd,
                           const ConstVectorRef& qdd, const ConstVectorRef& command,
                           const Wrenches& wrenches, MatrixRef slopes) noexcept;

/// d(qdd)/dp (d, size) of forward_dynamics at a state, cpp/sensitivities.md eq. (116). NaN where
/// the mass matrix is singular. Real-time safe.
void parameter_derivatives(const Model& model, Data& data, const ParameterSet& parameters,
                           ParameterData& room, const ConstVectorRef& q, const ConstVectorRef& qd,
                           const ConstVectorRef& command, const Wrenches& wrenches,
                           MatrixRef slopes) noexcept;

/// dq/dp (d, size) of an equilibrium q under constant commands and wrenches, eq. (119); infinite or
/// NaN where the stiffness is singular. It allocates.
[[nodiscard]] MatrixXd equilibrium_derivatives(const Model& model, const ParameterSet& parameters,
                                               const VectorXd& q, const VectorXd& command,
                                               const Wrenches& wrenches = no_wrenches());

}  // namespace CDCR_EXPORT cdcr
