#pragma once

#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/status.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// What each cable does at a sample.
enum class Sliding : signed char { paid_out = -1, sticks = 0, pulled_in = 1 };

/// A robot that followed commands so slowly that it was at rest all along.
struct QuasiStatic {
  RowMatrixXd q;            ///< a row for each sample reached (T, d) [rad]
  RowMatrixXd tension;      ///< of the cables at their drives (T, num_cables) [N]
  RowMatrixXd end_tension;  ///< and at their ends (T, num_cables) [N]
  RowMatrixXd friction;     ///< what friction takes on the way, with its sign (T, num_cables) [N]
  RowMatrixXd deflection;   ///< of cables against where they stick (T, num_cables) [m]
  RowMatrixXd felt;         ///< commands behind the play of drives (T, num_cables) [N], [m]
  std::vector<Sliding> sliding;  ///< row by row, cable by cable (T num_cables)
  long iterations = 0;           ///< Newton steps
  long substeps = 0;             ///< parts of steps between samples that were cut
  Status status = Status::ok;
  std::string message;  ///< empty when ok
};

/// Where such a run begins.
struct QuasiStaticStart {
  VectorXd q;           ///< near which it rests under the first command; or empty
  VectorXd deflection;  ///< (num_cables) [m]; or empty: none, as if friction were new
  VectorXd felt;        ///< (num_cables); or empty: the first command
};

/// Follows commands (T, num_cables), tensions [N] or lengths [m], one after another, at rest at
/// each: friction remembers the way, cpp/friction.md eqs. (113) to (115).
///
/// Each cable sticks or slides from one sample to the next, without time: a return mapping per
/// sample. A cable that sticks gives way by Robot::presliding_stiffness; where that is zero, by
/// a two-hundredth of what the robot does. Without friction these are the points of rest that
/// equilibrium() finds, each from the one before. Where a step does not converge it is cut; a jump
/// to another shape (a buckling arm) is followed to where it comes to rest. Samples after a failure
/// are left out, and with status interrupted those from where `interrupt`, asked before each, says
/// true. Throws std::invalid_argument for wrong sizes, negative or non-finite commands, and
/// wrenches that validate() refuses.
[[nodiscard]] QuasiStatic quasi_static(const Model& model, const RowMatrixXd& commands,
                                       const QuasiStaticStart& start = {},
                                       const Wrenches& wrenches = no_wrenches(),
                                       const Interrupt& interrupt = {});

}  // namespace CDCR_EXPORT cdcr
