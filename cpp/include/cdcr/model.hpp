#pragma once

#include <vector>

#include "cdcr/formulation.hpp"
#include "cdcr/robot.hpp"
#include "cdcr/shape_table.hpp"
#include "cdcr/types.hpp"

namespace cdcr {

/// Largest bending angle of a section [rad]: one and a half turns. The section's polynomials end
/// there, and functions of the shape return NaN beyond it.
inline constexpr double max_bending = 3.0 * 3.14159265358979323846;

/// A robot made ready for computing: its polynomials, stiffnesses and cable geometry.
///
/// Set up: the constructor allocates and throws std::invalid_argument. Afterwards the model never
/// changes, so any number of threads may read one model, each with a Data of its own.
class Model {
 public:
  explicit Model(Robot robot, Formulation formulation = Formulation::exact);

  [[nodiscard]] const Robot& robot() const noexcept { return robot_; }
  [[nodiscard]] Formulation formulation() const noexcept { return formulation_; }
  [[nodiscard]] Index num_sections() const noexcept { return stiffness_.size(); }
  [[nodiscard]] Index num_coordinates() const noexcept { return 2 * num_sections(); }
  [[nodiscard]] Index num_cables() const noexcept { return actuation_.cols(); }

  /// Every cable, in the order of tensions (num_cables).
  [[nodiscard]] const std::vector<Cable>& cables() const noexcept { return cables_; }
  /// B of Q = B F (2n, num_cables) [m]: tensions to generalised force. Constant.
  [[nodiscard]] const MatrixXd& actuation_matrix() const noexcept { return actuation_; }
  /// Cable lengths of the straight robot (num_cables) [m].
  [[nodiscard]] const VectorXd& straight_lengths() const noexcept { return straight_lengths_; }
  /// Bending stiffness K of each section (n) [N m/rad].
  [[nodiscard]] const VectorXd& stiffness() const noexcept { return stiffness_; }
  /// Viscous damping of each section (n) [N m s/rad].
  [[nodiscard]] const VectorXd& damping() const noexcept { return damping_; }
  /// False when nothing resists acceleration: such a robot has statics but no dynamics.
  [[nodiscard]] bool has_inertia() const noexcept { return has_inertia_; }
  [[nodiscard]] bool has_gravity() const noexcept { return has_gravity_; }

  [[nodiscard]] const detail::ShapeTable& table(Index section) const noexcept {
    return tables_[static_cast<std::size_t>(section)];
  }

 private:
  Robot robot_;
  std::vector<Cable> cables_;
  Formulation formulation_;
  std::vector<detail::ShapeTable> tables_;
  VectorXd stiffness_, damping_, straight_lengths_;
  MatrixXd actuation_;
  bool has_inertia_ = false;
  bool has_gravity_ = false;
};

/// Throws std::invalid_argument with a sentence when the model cannot be accelerated.
void require_inertia(const Model& model);

/// Scratch space of the dynamics functions: one for each thread.
struct Data {
  explicit Data(const Model& model);
  VectorXd force;         ///< generalised force (2n) [N m]
  VectorXd acceleration;  ///< (2n) [rad/s^2]
};

}  // namespace cdcr
