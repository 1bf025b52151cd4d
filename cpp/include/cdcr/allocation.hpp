#pragma once

#include <Eigen/Cholesky>
#include <limits>
#include <vector>

#include "cdcr/model.hpp"

namespace cdcr {

/// Limits of every tension [N] and the cables that may be used (all when empty). A min_tension
/// below zero describes an ideal actuator that can push; no cable does.
struct TensionLimits {
  double min_tension = 0.0;
  double max_tension = std::numeric_limits<double>::infinity();
  std::vector<Index> cables;
};

/// Finds the least-norm tensions that give a generalised force, eq. (20):
/// min |F|^2 with B F = Q and F within the limits; where none exist, the tensions whose force
/// comes nearest to Q.
///
/// Three cables around one section: closed form, the pseudo-inverse plus a common pretension.
/// Otherwise an active-set search. Set up: the constructor allocates and throws
/// std::invalid_argument. Run: solve and what follows it are real-time safe.
class Allocator {
 public:
  explicit Allocator(const Model& model, const TensionLimits& limits = {});

  /// Solves for force (2n) [N m]; true when the force is met.
  bool solve(const ConstVectorRef& force) noexcept;

  /// Tensions found (num_cables) [N]; zero for cables that may not be used.
  [[nodiscard]] const VectorXd& tension() const noexcept { return tension_; }
  /// The generalised force they give (2n) [N m].
  [[nodiscard]] const VectorXd& force() const noexcept { return force_; }
  /// Whether a cable stands at one of its limits.
  [[nodiscard]] bool at_limit(Index cable) const noexcept;

 private:
  enum class Place : char { lower, free, upper, unused };

  void place_at_start() noexcept;
  bool solve_in_closed_form() noexcept;
  void search() noexcept;
  void solve_free() noexcept;
  bool fix_first_beyond() noexcept;
  bool release_most_wanted() noexcept;
  void polish() noexcept;
  void left_for_free() noexcept;

  double low_, high_;
  double scale_ = 1.0;          // largest column of B, so that lengths are near one
  MatrixXd B_, normal_;         // B/scale; sum of b b^T over the free cables
  VectorXd Q_, rest_, lambda_;  // Q/scale; what the free cables must give; multipliers
  VectorXd F_, tension_, force_;
  // Closed form: B null = 0 with null > 0, and the pseudo-inverse of B/scale (3, 2).
  Vector3d null_ = Vector3d::Zero();
  MatrixXd pseudo_inverse_;
  bool has_closed_form_ = false;
  std::vector<Place> place_;
  Eigen::LDLT<MatrixXd> ldlt_;
};

/// Tensions found for a generalised force, and how well they do.
struct Allocation {
  VectorXd tension;             ///< (num_cables) [N], within the limits
  VectorXd force;               ///< B F, the generalised force they give (2n) [N m]
  double distance = 0.0;        ///< |B F - Q|, rounding error when feasible [N m]
  bool feasible = false;        ///< the force is met
  std::vector<Index> limiting;  ///< cables at a limit, when infeasible
};

/// One call of Allocator. Throws std::invalid_argument for wrong sizes and non-finite forces too.
[[nodiscard]] Allocation allocate(const Model& model, const VectorXd& force,
                                  const TensionLimits& limits = {});

}  // namespace cdcr
