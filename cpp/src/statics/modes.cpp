#include "cdcr/modes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "base/arguments.hpp"
#include "base/eigenvalues.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/robot_ode.hpp"
#include "cdcr/statics.hpp"
#include "dynamics/bending.hpp"

namespace cdcr {
namespace {

// Shares of the largest that count as zero: of a squared frequency, and of an eigenvalue's real
// part, which the eigenvalue solver leaves uncertain where nothing damps.
constexpr double neutral = 1e-12, undamped = 1e-9;

void check(const Model& model, const VectorXd& q, const VectorXd& command) {
  require_inertia(model);
  detail::require_finite("q", q, model.num_coordinates());
  detail::require_bending("q", model, q);
  require_command(model, command);
}

/// w^2 and phi from the symmetric problem.
void find_shapes(const MatrixXd& K, const MatrixXd& M, Modes& modes) {
  const MatrixXd symmetric = 0.5 * (K + K.transpose());
  auto [values, vectors] = detail::symmetric_eigen(symmetric, M);
  modes.squared_frequency = std::move(values);
  modes.shape = std::move(vectors);
  for (Index i = 0; i < modes.shape.cols(); ++i) {  // the largest component points forwards
    Index largest = 0;
    modes.shape.col(i).cwiseAbs().maxCoeff(&largest);
    if (modes.shape(largest, i) < 0.0) modes.shape.col(i) *= -1.0;
  }
  modes.frequency = modes.squared_frequency.cwiseMax(0.0).cwiseSqrt();
}

/// Refuses what overflowed on the way.
void require_finite_modes(const Modes& modes) {
  detail::require(modes.squared_frequency.allFinite() && modes.shape.allFinite() &&
                      modes.damping_ratio.allFinite() && modes.eigenvalues.allFinite(),
                  "the modes at q = [", modes.q.transpose(),
                  "] are not finite: the masses, the stiffnesses or the loads are too large or too "
                  "far apart for double precision");
}

/// Eigenvalues of A, by magnitude. Scaling q by a mean frequency makes both halves of A alike.
Eigen::VectorXcd eigenvalues_of(MatrixXd A) {
  const Index m = A.rows() / 2;
  const double scale = std::sqrt(A.bottomLeftCorner(m, m).norm() + 1e-300);
  if (!std::isfinite(scale)) return VectorXd::Constant(2 * m, scale);  // to be refused
  A.topRightCorner(m, m) *= scale;
  A.bottomLeftCorner(m, m) /= scale;
  Eigen::VectorXcd values = detail::eigenvalues(A);
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  return values;
}

}  // namespace

Modes modes(const Model& model, const VectorXd& q, const VectorXd& command,
            const Wrenches& wrenches) {
  check(model, q, command);
  validate(model, wrenches);
  const Index m = model.num_coordinates();
  Data data(model);
  MatrixXd M(m, m), K(m, m), A(2 * m, 2 * m);
  mass_matrix(model, data, q, M);
  if (Eigen::LLT<MatrixXd>(M).info() != Eigen::Success) {
    detail::refuse("the mass matrix at q = [", q.transpose(),
                   "] is singular: some motion there moves no mass");
  }
  static_stiffness(model, q, command, wrenches, K);
  state_jacobian(model, data, q, VectorXd::Zero(m), command, wrenches, A);

  Modes result;
  result.q = q;
  find_shapes(K, M, result);
  const MatrixXd C = -M * A.bottomRightCorner(m, m);
  result.damping_ratio = VectorXd::Zero(m);
  for (Index i = 0; i < m; ++i) {
    const double w = result.frequency[i];
    if (w > 0.0) {
      result.damping_ratio[i] = result.shape.col(i).dot(C * result.shape.col(i)) / (2.0 * w);
    }
  }
  result.eigenvalues = eigenvalues_of(A);
  require_finite_modes(result);
  const double fastest = std::abs(result.eigenvalues[2 * m - 1]);
  result.stable = result.squared_frequency[0] > neutral * result.squared_frequency[m - 1] &&
                  result.eigenvalues.real().maxCoeff() <= undamped * fastest;
  return result;
}

}  // namespace cdcr
