#include "cdcr/allocation.hpp"

#include <Eigen/QR>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cdcr/dynamics.hpp"

namespace cdcr {
namespace {

enum class Place { lower, free, upper };

/// Minimises |F|^2/2 + |B F - Q|^2/(2 epsilon) within the limits, by an active set that releases
/// one cable at a time. The objective is strictly convex and falls at each change of the set, so
/// the search ends. A tiny epsilon makes it least-norm where Q can be met and nearest elsewhere.
class ActiveSet {
 public:
  ActiveSet(MatrixXd B, VectorXd Q, double low, double high)
      : B_(std::move(B)),
        Q_(std::move(Q)),
        low_(low),
        high_(high),
        F_(VectorXd::Constant(B_.cols(), low)),
        place_(static_cast<std::size_t>(B_.cols()), Place::lower) {}

  VectorXd solve() {
    // Each cable is released and caught a few times at most; the limit only guards rounding.
    const Index max_changes = 50 * (B_.cols() + 1);
    for (Index change = 0; change < max_changes; ++change) {
      if (fix_first_beyond()) continue;
      if (!release_most_wanted()) break;
    }
    polish();
    return F_;
  }

  [[nodiscard]] bool at_limit(Index j) const { return place_[j] != Place::free; }

 private:
  static constexpr double epsilon = 1e-12;

  [[nodiscard]] MatrixXd free_columns() const {
    MatrixXd columns(B_.rows(), 0);
    for (Index j = 0; j < B_.cols(); ++j) {
      if (place_[j] != Place::free) continue;
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      columns.rightCols<1>() = B_.col(j);
    }
    return columns;
  }

  [[nodiscard]] VectorXd left_for_free() const {
    VectorXd rest = Q_;
    for (Index j = 0; j < B_.cols(); ++j) {
      if (place_[j] != Place::free) rest -= B_.col(j) * F_[j];
    }
    return rest;
  }

  /// Moves towards the minimum over the free cables; true when one reached a limit on the way.
  bool fix_first_beyond() {
    const MatrixXd columns = free_columns();
    MatrixXd normal = columns * columns.transpose();
    normal.diagonal().array() += epsilon;
    lambda_ = normal.ldlt().solve(left_for_free());
    double share = 1.0;
    Index first = -1;
    Place side = Place::free;
    for (Index j = 0; j < B_.cols(); ++j) {
      if (place_[j] != Place::free) continue;
      const double wanted = B_.col(j).dot(lambda_);
      if (wanted >= low_ && wanted <= high_) continue;
      const double limit = wanted < low_ ? low_ : high_;
      const double part = (limit - F_[j]) / (wanted - F_[j]);
      if (part < share || first < 0) {
        share = part;
        first = j;
        side = wanted < low_ ? Place::lower : Place::upper;
      }
    }
    for (Index j = 0; j < B_.cols(); ++j) {
      if (place_[j] == Place::free) F_[j] += share * (B_.col(j).dot(lambda_) - F_[j]);
    }
    if (first < 0) return false;
    F_[first] = side == Place::lower ? low_ : high_;
    place_[first] = side;
    return true;
  }

  /// Releases the fixed cable that most wants to move inwards; false when none does.
  bool release_most_wanted() {
    Index best = -1;
    double most = 1e-9 * (1.0 + lambda_.norm());
    for (Index j = 0; j < B_.cols(); ++j) {
      if (place_[j] == Place::free || low_ == high_) continue;
      const double wanted = B_.col(j).dot(lambda_) - F_[j];
      const double inwards = place_[j] == Place::lower ? wanted : -wanted;
      if (inwards > most) {
        most = inwards;
        best = j;
      }
    }
    if (best < 0) return false;
    place_[best] = Place::free;
    return true;
  }

  /// With the set known, meets Q to rounding: epsilon has done its work.
  void polish() {
    const MatrixXd columns = free_columns();
    if (columns.cols() == 0) return;
    const VectorXd exact =
        columns.completeOrthogonalDecomposition().solve(left_for_free());
    Index k = 0;
    for (Index j = 0; j < B_.cols(); ++j) {
      if (place_[j] == Place::free) F_[j] = std::fmin(std::fmax(exact[k++], low_), high_);
    }
  }

  MatrixXd B_;
  VectorXd Q_;
  double low_, high_;
  VectorXd F_, lambda_;
  std::vector<Place> place_;
};

void check(const Model& model, const VectorXd& force, double low, double high) {
  std::ostringstream text;
  if (force.size() != model.num_coordinates() || !force.allFinite()) {
    text << "force must be " << model.num_coordinates() << " finite values, got ["
         << force.transpose() << "]";
    throw std::invalid_argument(text.str());
  }
  if (!(low >= 0.0) || !std::isfinite(low) || !(high >= low)) {
    text << "tension limits must satisfy 0 <= min_tension <= max_tension with min_tension finite, "
         << "got min_tension " << low << " N and max_tension " << high << " N";
    throw std::invalid_argument(text.str());
  }
}

}  // namespace

Allocation allocate(const Model& model, const VectorXd& force, double min_tension,
                    double max_tension) {
  check(model, force, min_tension, max_tension);
  const MatrixXd& B = model.actuation_matrix();
  Allocation result;
  result.force = VectorXd::Zero(force.size());
  if (B.cols() > 0) {
    // Lengths of the order of one make epsilon mean the same for every robot.
    const double scale = B.colwise().norm().maxCoeff();
    ActiveSet set(B / scale, force / scale, min_tension, max_tension);
    result.tension = set.solve();
    actuation_force(model, result.tension, result.force);
    for (Index j = 0; j < B.cols(); ++j) {
      if (set.at_limit(j)) result.limiting.push_back(j);
    }
  }
  result.distance = (result.force - force).norm();
  double size = force.norm();
  if (B.cols() > 0) size += B.norm() * result.tension.norm();
  result.feasible = result.distance <= 1e-10 * size;
  if (result.feasible) result.limiting.clear();
  return result;
}

}  // namespace cdcr
