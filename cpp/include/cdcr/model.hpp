#pragma once

#include <memory>
#include <vector>

#include "cdcr/formulation.hpp"
#include "cdcr/robot.hpp"
#include "cdcr/shape_table.hpp"
#include "cdcr/types.hpp"

namespace cdcr {

namespace detail {
struct Chain;
}

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
  /// Rows of B that are not zero by construction, 2 (end_section + 1) for each cable.
  [[nodiscard]] const std::vector<Index>& cable_rows() const noexcept { return cable_rows_; }
  /// Cable lengths of the straight robot (num_cables) [m].
  [[nodiscard]] const VectorXd& straight_lengths() const noexcept { return straight_lengths_; }
  /// Bending stiffness K of each section (n) [N m/rad].
  [[nodiscard]] const VectorXd& stiffness() const noexcept { return stiffness_; }
  /// Viscous damping of each section (n) [N m s/rad].
  [[nodiscard]] const VectorXd& damping() const noexcept { return damping_; }
  /// Coulomb's coefficient of each cable in the holes of each section (n, num_cables).
  [[nodiscard]] const MatrixXd& friction() const noexcept { return friction_; }
  [[nodiscard]] bool has_friction() const noexcept { return has_friction_; }
  /// Whether every cable is driven by tension and free of friction: then Q = B F.
  [[nodiscard]] bool has_plain_cables() const noexcept { return has_plain_cables_; }
  /// False when nothing resists some acceleration: such a robot has statics but no dynamics.
  [[nodiscard]] bool has_inertia() const noexcept { return singular_section_ < 0; }
  /// The section, nearest the tip, that moves no mass of its own; -1 when there is none.
  [[nodiscard]] Index singular_section() const noexcept { return singular_section_; }
  /// Gravity as the first section sees it, R^T g with the base orientation R [m/s^2].
  [[nodiscard]] const Vector3d& root_gravity() const noexcept { return root_gravity_; }
  [[nodiscard]] bool has_gravity() const noexcept { return has_gravity_; }

  /// One section with nothing but a point on its tip; such a robot has a table().
  [[nodiscard]] bool has_closed_form() const noexcept { return table_ != nullptr; }
  [[nodiscard]] const detail::ShapeTable& table() const noexcept { return *table_; }
  [[nodiscard]] const detail::Chain& chain() const noexcept { return *chain_; }

 private:
  Robot robot_;
  std::vector<Cable> cables_;
  std::vector<Index> cable_rows_;
  Formulation formulation_;
  std::shared_ptr<const detail::ShapeTable> table_;
  std::shared_ptr<const detail::Chain> chain_;
  VectorXd stiffness_, damping_, straight_lengths_;
  MatrixXd actuation_, friction_;
  Vector3d root_gravity_ = Vector3d::Zero();
  Index singular_section_ = -1;
  bool has_gravity_ = false, has_friction_ = false, has_plain_cables_ = true;
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
