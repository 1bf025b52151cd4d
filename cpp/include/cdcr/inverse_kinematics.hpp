#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <optional>
#include <string>

#include "cdcr/export.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/status.hpp"

// From where the tip should be to bending vectors, cpp/README.md eq. (7) and what follows it.

namespace CDCR_EXPORT cdcr {

/// How to search. What is left empty follows from the robot.
struct InverseKinematicsOptions {
  VectorXd max_theta;  ///< largest bending angle, one for all or one a section [rad]; else 2 pi
  std::optional<double> orientation_weight;  ///< what one rad is worth [m]; else length/pi
  std::optional<double> tolerance;  ///< residual that counts as reached [m]; else 1e-6 length,
                                    ///< and a descent goes on to 1e-9
  int seeds = 100;                  ///< starts at most, 1 to 100000
  int iterations = 100;             ///< steps tried from each start at most, >= 1
  Interrupt stop;                   ///< where not empty, asked before each step
};

/// How a search for bending vectors ended.
enum class IkStatus {
  reached,           ///< the tip is where it should be
  too_far,           ///< the point is farther from the base than the robot is long
  at_limit,          ///< a section stands at max_theta
  off_surface,       ///< the tip of one section moves on a surface, and the point is beside it
  too_few_sections,  ///< fewer coordinates than a position and an orientation ask for
  not_found,         ///< no start came near enough; the point may be out of reach or not
  not_finite,        ///< what was asked for is infinite or not a number
  wrong_size,        ///< q0 has neither a value for each coordinate nor none
  interrupted        ///< stopped by the caller
};
using Reach = IkStatus;  ///< its earlier name

/// Bending vectors that bring the tip to where it should be, or as near as was found.
struct InverseKinematics {
  VectorXd q;                                ///< (d) [rad], each section within max_theta
  Vector3d position = Vector3d::Zero();      ///< tip position reached [m]
  Matrix3d rotation = Matrix3d::Identity();  ///< tip orientation reached
  double distance = 0.0;                     ///< of that position from the one asked for [m]
  double angle = 0.0;      ///< of that orientation from the one asked for, 0 without [rad]
  double residual = 0.0;   ///< sqrt(distance^2 + (orientation_weight angle)^2) [m]
  bool reachable = false;  ///< the residual is within the tolerance
  IkStatus reach = IkStatus::not_finite;
  int seeds = 0;        ///< starts tried; 0: closed form
  int iterations = 0;   ///< steps tried, from all starts together
  std::string message;  ///< why not, in one sentence; empty when reachable
};

/// Searches for bending vectors by damped least squares from several starts.
///
/// One section without an orientation or a tool has a closed form, eq. (7), which looks at all
/// shapes. Set up: the constructor allocates and throws std::invalid_argument. Run: solve is
/// real-time safe; it takes at most seeds x iterations steps.
class InverseSolver {
 public:
  explicit InverseSolver(const Model& model, const InverseKinematicsOptions& options = {});

  /// Bending vectors for a tip position p [m] and, if wanted, a rotation R, both in the base frame.
  /// Starts from q0 (d) first when that is not empty. The answer has no message; it is valid
  /// until the next call. Real-time safe.
  const InverseKinematics& solve(const Vector3d& p, const std::optional<Matrix3d>& R = {},
                                 const ConstVectorRef& q0 = VectorXd()) noexcept;

  /// Why the last answer is not reachable, in one sentence; empty when it is.
  [[nodiscard]] std::string message() const;

 private:
  using Residual = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;

  void set_target(const Vector3d& p, const std::optional<Matrix3d>& R) noexcept;
  void conclude() noexcept;
  [[nodiscard]] double distance_from_base() const noexcept;
  [[nodiscard]] IkStatus why() const noexcept;
  bool stopped() noexcept;

  void search(const ConstVectorRef& q0) noexcept;
  void place_start(int seed) noexcept;
  double random() noexcept;
  void levenberg_marquardt() noexcept;
  bool step() noexcept;
  void hold_at_limits() noexcept;
  void keep_within_limits(VectorXd& q) const noexcept;
  [[nodiscard]] bool stands_at_limit(const VectorXd& q, Index section) const noexcept;
  [[nodiscard]] Residual reached(const VectorXd& q) const noexcept;
  void gradient(const VectorXd& q, const Residual& x, VectorXd& g) noexcept;
  void curvature() noexcept;

  const Model* model_;
  InverseKinematicsOptions options_;
  double tolerance_ = 0.0;              // [m]
  double length_ = 0.0;                 // of the robot [m], the unit of everything below
  double tool_reach_ = 0.0;             // of the tool's origin from the end of the robot [m]
  double weight_ = 0.0;                 // of the orientation
  double goal_ = 0.0, accepted_ = 0.0;  // costs: where a descent ends, and the search
  VectorXd max_theta_;                  // (n) [rad]
  VectorXd metric_;                     // (d) how much each coordinate is damped
  Vector3d p_ = Vector3d::Zero();       // as asked for [m]
  Matrix3d R_ = Matrix3d::Identity();
  bool with_rotation_ = false;
  IkStatus asked_ =
      IkStatus::not_finite;  // what is wrong with what was asked for; reached: nothing
  // The same in the frame of the unbent robot, in its plane of bending.
  Eigen::Vector2d towards_ = Eigen::Vector2d::UnitX();
  double rho_ = 0.0, z_ = 0.0;
  Residual target_, x_;  // the cost is |x - target|^2 / 2
  VectorXd q_, best_, trial_, step_, g_, held_g_;
  MatrixXd J_, H_, held_H_;
  double cost_ = 0.0, best_cost_ = 0.0, damping_ = 0.0, growth_ = 0.0;
  bool second_order_ = false;
  Eigen::LLT<MatrixXd> llt_;
  std::uint64_t random_state_ = 1;
  InverseKinematics answer_;
};

/// One call of InverseSolver, with its message.
///
/// Throws std::invalid_argument for wrong sizes, values that are not finite, and an R that is not a
/// rotation to 1e-5; R is rounded to the nearest rotation.
[[nodiscard]] InverseKinematics inverse_kinematics(const Model& model, const Vector3d& p,
                                                   const std::optional<Matrix3d>& R = {},
                                                   const VectorXd& q0 = {},
                                                   const InverseKinematicsOptions& options = {});

}  // namespace CDCR_EXPORT cdcr
