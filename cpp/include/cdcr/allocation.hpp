#pragma once

#include <Eigen/Cholesky>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"

namespace CDCR_EXPORT cdcr {

/// How tensions are found. sections: each section's three cables in closed form; search: an active
/// set, for any cables; automatic: the first where it applies.
enum class AllocationMethod { automatic, sections, search };

/// Limits of every tension [N] and the cables that may be used (all when empty). A min_tension
/// below zero describes an ideal actuator that can push; no cable does.
struct TensionLimits {
  double min_tension = 0.0;
  double max_tension = std::numeric_limits<double>::infinity();
  std::vector<Index> cables;
  AllocationMethod method = AllocationMethod::automatic;
  /// Least tension of each cable (num_cables) [N], where that is above min_tension; or empty.
  // NOLINTNEXTLINE(readability-redundant-member-init): so that lists may end before it
  VectorXd pretension = {};
};

/// Finds the least-norm tensions that give a generalised force, eq. (20):
/// min |F|^2 with B F = Q and F within the limits; where none exist, the tensions whose force
/// comes nearest to Q. Where rods stretch, forces along the backbone [N] and moments [N m] each
/// count over the most that one cable gives of them by 1 N.
///
/// Where three cables, not on one side of the backbone, end at every section: closed form, from tip
/// to base, each section's pseudo-inverse plus a tension common to its three, eq. (46). That is the
/// least-norm answer of all cables together. Otherwise, and where the limits leave no answer, an
/// active-set search. Set up: the constructor allocates and throws std::invalid_argument. Run:
/// solve and what follows it are real-time safe.
class Allocator {
 public:
  explicit Allocator(const Model& model, const TensionLimits& limits = {});

  /// Takes B at q (d) from now on. For robots whose B depends on q; made for q = 0. Real-time safe.
  void set_shape(const ConstVectorRef& q) noexcept;
  /// Limits of each cable (num_cables) [N], lower <= upper, from now on. Real-time safe.
  void set_limits(const ConstVectorRef& lower, const ConstVectorRef& upper) noexcept;
  /// Solves for force (d) [N m]; true when the force is met. One of another size or not finite is
  /// not, and leaves the last answer in place.
  bool solve(const ConstVectorRef& force) noexcept;

  /// Tensions found (num_cables) [N]; zero for cables that may not be used.
  [[nodiscard]] const VectorXd& tension() const noexcept { return tension_; }
  /// The generalised force they give (d) [N m].
  [[nodiscard]] const VectorXd& force() const noexcept { return force_; }
  /// Whether a cable stands at one of its limits.
  [[nodiscard]] bool at_limit(Index cable) const noexcept;
  /// Limits of each cable (num_cables) [N].
  [[nodiscard]] const VectorXd& lower() const noexcept { return lower_; }
  [[nodiscard]] const VectorXd& upper() const noexcept { return upper_; }
  /// Whether the closed form applies to these cables.
  [[nodiscard]] bool has_closed_form() const noexcept { return !triples_.empty(); }

 private:
  enum class Place : char { lower, free, upper, unused };
  /// The three cables that end at a section: b null = 0 with null > 0, and b's pseudo-inverse, of
  /// their directions b (2, 3).
  struct Triple {
    Index first;  // coordinate of the section
    Index cables[3];
    Vector3d null;
    MatrixXd pseudo_inverse;
  };

  void set_actuation() noexcept;
  void find_triples(const Model& model);
  bool solve_triple(const Triple& triple, const Eigen::Vector2d& force) noexcept;
  void initialise_active_set() noexcept;
  bool solve_in_closed_form() noexcept;
  void search() noexcept;
  void find_active_set() noexcept;
  bool is_met() noexcept;
  void solve_free() noexcept;
  bool step_to_first_bound() noexcept;
  bool release_by_multiplier() noexcept;
  void polish() noexcept;
  void left_for_free() noexcept;

  std::optional<Model> model_;  // where B depends on q
  VectorXd lower_, upper_;      // limits of the tensions [N]
  VectorXd low_, high_;         // the same in the unit of the force at hand
  std::vector<bool> along_;     // whether a coordinate is a stretch: its force is in N
  VectorXd scale_;              // largest column of B in moments, and in forces: then all near one
  double moment_ = 1.0;         // that in moments [m]
  double unit_ = 1.0;           // of the force at hand [N m]
  double epsilon_ = 0.0;        // of the search
  double softest_ = 0.0;        // least bending stiffness [N m/rad]
  double negligible_ = 0.0;     // force/scale that bends the robot no more than rounding
  MatrixXd B_, normal_;         // B/scale; sum of b b^T over the free cables
  VectorXd Q_, rest_, lambda_;  // Q/scale; what the free cables must give; multipliers
  VectorXd F_, tension_, force_;
  VectorXd coarse_F_;            // before the finer search
  std::vector<Triple> triples_;  // one for each section, or none
  std::vector<Place> place_, coarse_place_;
  Eigen::LDLT<MatrixXd> ldlt_;
};

/// Tensions found for a generalised force, and how well they do.
struct Allocation {
  VectorXd tension;                 ///< (num_cables) [N], within the limits
  VectorXd force;                   ///< B F, the generalised force they give (d) [N m]
  double distance = 0.0;            ///< |B F - Q|, rounding error when feasible [N m]
  bool feasible = false;            ///< the force is met
  std::vector<Index> limiting;      ///< cables whose limit keeps it from Q, when infeasible
  std::vector<std::string> limits;  ///< these in words: "cable 2 of section 1 at 0 N (min)"
};

/// One call of Allocator. Throws std::invalid_argument for wrong sizes and non-finite forces too.
[[nodiscard]] Allocation allocate(const Model& model, const VectorXd& force,
                                  const TensionLimits& limits = {});
/// The same with B at q, for robots whose B depends on q.
[[nodiscard]] Allocation allocate_at(const Model& model, const VectorXd& q, const VectorXd& force,
                                     const TensionLimits& limits = {});
/// Throws std::invalid_argument where B depends on q, for a function that is given none.
void require_constant_actuation(const Model& model);

/// "cable 2 of section 1": the second of those that end there. Counts from 1, in their order.
/// Throws std::invalid_argument for a cable that the robot has not.
[[nodiscard]] std::string cable_name(const Model& model, Index cable);

/// Commands (num_cables) that hold the tensions [N] at rest in q: the tension itself, or for a
/// cable driven by length l(q) - F/k [m]. Real-time safe.
void cable_commands(const Model& model, const ConstVectorRef& q, const ConstVectorRef& tension,
                    VectorRef command) noexcept;

}  // namespace CDCR_EXPORT cdcr
