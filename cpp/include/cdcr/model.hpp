#pragma once

#include <cassert>
#include <memory>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/formulation.hpp"
#include "cdcr/robot.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// A robot made ready for computing: its polynomials, stiffnesses and cable geometry.
///
/// Set up: the constructor allocates and throws std::invalid_argument. Afterwards the model never
/// changes, so any number of threads may read one model, each with a Data of its own.
class Model {
 public:
  explicit Model(Robot robot, Formulation formulation = Formulation::exact);
  /// Of the formulation of another model, whose tables it shares where sections have the same
  /// inertia: for many robots that differ in a few numbers.
  Model(Robot robot, const Model& like);

  /// The same model under another gravity [m/s^2], in the base frame. Its tables are shared, so
  /// that this costs a copy. Throws std::invalid_argument where it is not finite.
  [[nodiscard]] Model with_gravity(const Vector3d& gravity) const;

  [[nodiscard]] const Robot& robot() const noexcept { return *robot_; }
  [[nodiscard]] Formulation formulation() const noexcept { return formulation_; }
  [[nodiscard]] Index num_sections() const noexcept { return stiffness_.size(); }
  /// The size d of q: two for each section of constant curvature, cpp/rods.md for others.
  [[nodiscard]] Index num_coordinates() const noexcept { return actuation_.rows(); }
  /// Where the coordinates of a section begin in q; for num_sections, where they end.
  [[nodiscard]] Index first_coordinate(Index section) const noexcept {
    assert(section >= 0 && section <= num_sections());
    return first_[section];
  }
  /// Names of the coordinates, in the order of q, sections from 1: q1_x, q1_y, q2_x, ... of
  /// bending; t1, ... of twist; e1, ... of stretch. Higher orders are q1_x_1, q1_y_1, t1_1, e1_2,
  /// ...
  [[nodiscard]] std::vector<std::string> coordinate_names() const;
  [[nodiscard]] Index num_cables() const noexcept { return actuation_.cols(); }

  /// Every cable, in the order of tensions (num_cables).
  [[nodiscard]] const std::vector<Cable>& cables() const noexcept { return cables_; }
  /// B of Q = B F (d, num_cables) [m]: tensions to generalised force. Where
  /// has_constant_actuation() is false it is that of q = 0, and actuation_matrix(model, q, B) gives
  /// that of any q.
  [[nodiscard]] const MatrixXd& actuation_matrix() const noexcept { return actuation_; }
  /// Rows of B that are not zero by construction, one number for each cable.
  [[nodiscard]] const std::vector<Index>& cable_rows() const noexcept { return cable_rows_; }
  /// Whether B is the same at all q: no cable winds or converges, and none runs through a section
  /// that twists.
  [[nodiscard]] bool has_constant_actuation() const noexcept { return has_constant_actuation_; }
  /// Whether the sections are rods, all of them, since one of them is one or a cable winds.
  [[nodiscard]] bool has_rods() const noexcept { return has_rods_; }
  /// Whether all cables pull alike on each section from the base to their end.
  [[nodiscard]] bool has_nested_cables() const noexcept { return has_nested_cables_; }
  /// The unloaded shape (d): zero but for sections that are bent or twisted at rest.
  [[nodiscard]] const VectorXd& rest() const noexcept;
  /// Stiffness of the backbone (d, d): its elastic energy is (q - rest)^T K (q - rest)/2.
  [[nodiscard]] const MatrixXd& elastic_stiffness() const noexcept;
  /// Cable lengths of the straight robot (num_cables) [m].
  [[nodiscard]] const VectorXd& straight_lengths() const noexcept { return straight_lengths_; }
  /// Bending stiffness K of each section (n) [N m/rad].
  [[nodiscard]] const VectorXd& stiffness() const noexcept { return stiffness_; }
  /// Viscous damping of each section (n) [N m s/rad].
  [[nodiscard]] const VectorXd& damping() const noexcept { return damping_; }
  /// Coulomb's coefficient of each cable in the holes of each section (n, num_cables).
  [[nodiscard]] const MatrixXd& friction() const noexcept { return friction_; }
  /// Whether a cable rubs anywhere, in its holes or at its entry.
  [[nodiscard]] bool has_friction() const noexcept { return has_friction_; }
  /// Deflections that friction remembers: one for each cable, or none without memory.
  [[nodiscard]] Index num_deflections() const noexcept { return num_deflections_; }
  /// Friction below which a cable that remembers goes over to none [N]: cpp/friction.md eq. (107).
  [[nodiscard]] double least_friction() const noexcept { return least_friction_; }
  /// e^-mu phi of the sheath of each cable (num_cables).
  [[nodiscard]] const VectorXd& sheath_decay() const noexcept { return sheath_decay_; }
  /// What a length-driven cable is longer than commanded without pull, -F_0/k (num_cables) [m].
  [[nodiscard]] const VectorXd& slack_offset() const noexcept { return slack_offset_; }
  /// Whether the drive of some cable has play.
  [[nodiscard]] bool has_backlash() const noexcept { return has_backlash_; }
  /// Whether every cable is driven by tension and free of friction, and B is constant: then Q = B F
  /// depends on the tensions alone.
  [[nodiscard]] bool has_plain_cables() const noexcept { return has_plain_cables_; }
  /// False when nothing resists some acceleration: such a robot has statics but no dynamics.
  [[nodiscard]] bool has_inertia() const noexcept { return singular_section_ < 0; }
  /// The section, nearest the tip, that moves no mass of its own; -1 when there is none.
  [[nodiscard]] Index singular_section() const noexcept { return singular_section_; }
  /// Gravity as the first section sees it, R^T g with the base orientation R [m/s^2].
  [[nodiscard]] const Vector3d& root_gravity() const noexcept { return root_gravity_; }
  [[nodiscard]] bool has_gravity() const noexcept { return has_gravity_; }

  /// Energy of the robot's weight at base_position over that at the origin [J].
  [[nodiscard]] double base_energy() const noexcept { return base_energy_; }
  /// Whether the frame of the tip is another one than that at the end of the last section.
  [[nodiscard]] bool has_tool() const noexcept { return has_tool_; }

  /// One section with nothing but a point on its tip.
  [[nodiscard]] bool has_closed_form() const noexcept { return has_closed_form_; }

  /// What the equations of motion read; private to the library.
  struct Parts;
  [[nodiscard]] const std::shared_ptr<const Parts>& parts() const noexcept { return parts_; }

 private:
  Model(Robot robot, Formulation formulation, const Model* like);
  void set_elasticity(Parts& parts);
  void set_cables(Parts& parts);
  void set_gravity(const Vector3d& gravity, const std::shared_ptr<Parts>& parts);

  std::shared_ptr<const Robot> robot_;  // shared by copies of a model
  std::vector<Cable> cables_;
  std::vector<Index> cable_rows_;
  Formulation formulation_;
  std::shared_ptr<const Parts> parts_;
  std::vector<Index> first_;
  VectorXd stiffness_, damping_, straight_lengths_, sheath_decay_, slack_offset_;
  MatrixXd actuation_, friction_;
  Vector3d root_gravity_ = Vector3d::Zero();
  Index singular_section_ = -1, num_deflections_ = 0;
  double base_energy_ = 0.0, least_friction_ = 0.0;
  bool has_gravity_ = false, has_friction_ = false, has_plain_cables_ = true, has_tool_ = false,
       has_closed_form_ = false, has_rods_ = false, has_constant_actuation_ = true,
       has_nested_cables_ = true, has_backlash_ = false;
};

/// Throws std::invalid_argument with a sentence when the model cannot be accelerated.
void require_inertia(const Model& model);

/// What a position and a velocity of a model give, kept so that a second function of the same state
/// does not compute it again, and scratch space. One for each thread and model.
class Data {
 public:
  explicit Data(const Model& model);
  Data(const Data& other);
  Data(Data&& other) noexcept;
  Data& operator=(const Data& other);
  Data& operator=(Data&& other) noexcept;
  ~Data();

  VectorXd force;  ///< generalised force (num_coordinates) [N m]

  /// Whether it was made for this model or a copy of it.
  [[nodiscard]] bool belongs_to(const Model& model) const noexcept {
    return parts_ == model.parts();
  }

  /// What is kept; private to the library. None where the closed form is all that is asked.
  class Kept;
  [[nodiscard]] Kept* kept() noexcept { return kept_.get(); }

 private:
  std::shared_ptr<const Model::Parts> parts_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace CDCR_EXPORT cdcr
