#include "cdcr/allocation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "allocation/check_limits.hpp"
#include "base/arguments.hpp"
#include "cdcr/cables.hpp"

namespace cdcr {
namespace {

// The search minimises |F|^2/2 + |B F - Q|^2/(2 epsilon): least-norm where Q can be met, nearest
// elsewhere. Strictly convex, so an active set that lowers it at each change comes to an end. Where
// cables pull almost against each other, the least norm outweighs a little of Q: then the finer one
// is tried, which rounding makes too coarse where Q cannot be met.
constexpr double coarse = 1e-9, fine = 1e-13;
// Distance from Q, relative to the sizes at hand, that still counts as met.
constexpr double met = 1e-10;
// Bend that a force missed would make, which counts as none [rad]: what rounding leaves of zero.
constexpr double no_bend = 1e-12;
// Forces beyond this would overflow when squared, and so would tensions.
constexpr double huge = 1e100;
// Passes that refine the tensions, and the share of an error that one leaves while they go on.
constexpr int least_passes = 3, max_passes = 100;
constexpr double shrinks = 0.9;

}  // namespace

Allocator::Allocator(const Model& model, const TensionLimits& limits)
    : lower_(VectorXd::Constant(model.num_cables(), limits.min_tension)),
      upper_(VectorXd::Constant(model.num_cables(), limits.max_tension)),
      ldlt_(model.num_coordinates()) {
  detail::check(model, limits);
  const Index m = model.num_coordinates(), c = model.num_cables();
  place_.assign(static_cast<std::size_t>(c), limits.cables.empty() ? Place::lower : Place::unused);
  for (const Index cable : limits.cables) place_[cable] = Place::lower;
  if (!model.has_constant_actuation()) model_ = model;
  softest_ = model.stiffness().minCoeff();
  B_ = model.actuation_matrix();
  scale_ = VectorXd::Ones(m);
  along_.assign(static_cast<std::size_t>(m), false);
  for (Index k = 0; k < model.num_sections(); ++k) {
    const int stretches = model.robot().sections[static_cast<std::size_t>(k)].stretch_order + 1;
    std::fill_n(along_.begin() + model.first_coordinate(k + 1) - stretches, stretches, true);
  }
  set_actuation();
  normal_ = MatrixXd::Identity(m, m);
  ldlt_.compute(normal_);
  Q_ = rest_ = lambda_ = force_ = VectorXd::Zero(m);
  F_ = tension_ = coarse_F_ = VectorXd::Zero(c);
  coarse_place_ = place_;
  if (limits.pretension.size() == c) lower_ = lower_.cwiseMax(limits.pretension);
  low_ = lower_;
  high_ = upper_;

  const bool nested = model.has_nested_cables() && limits.cables.empty();
  if (limits.method != AllocationMethod::search && nested) find_triples(model);
  detail::require(limits.method != AllocationMethod::sections || !triples_.empty(),
                  "method sections needs three cables, not on one side of the backbone, that end "
                  "at every section, and all of them in use");
}

void Allocator::set_shape(const ConstVectorRef& q) noexcept {
  if (!model_) return;
  actuation_matrix(*model_, q, B_);
  set_actuation();
}

void Allocator::set_limits(const ConstVectorRef& lower, const ConstVectorRef& upper) noexcept {
  assert(lower.size() == lower_.size() && upper.size() == upper_.size());
  lower_ = lower;
  upper_ = upper;
}

/// Leaves out the cables not in use, and scales.
void Allocator::set_actuation() noexcept {
  for (Index j = 0; j < B_.cols(); ++j) {
    if (place_[j] == Place::unused) B_.col(j).setZero();
  }
  for (const bool along : {false, true}) {
    double largest = 0.0;  // column of rows of this kind
    for (Index j = 0; j < B_.cols(); ++j) {
      double square = 0.0;
      for (Index i = 0; i < B_.rows(); ++i) {
        if (along_[i] == along) square += B_(i, j) * B_(i, j);
      }
      largest = std::fmax(largest, std::sqrt(square));
    }
    if (!(largest > 0.0)) largest = 1.0;
    if (!along) moment_ = largest;
    for (Index i = 0; i < B_.rows(); ++i) {
      if (along_[i] == along) scale_[i] = largest;
    }
  }
  for (Index j = 0; j < B_.cols(); ++j) B_.col(j).array() /= scale_.array();
  negligible_ = no_bend * softest_ / moment_;
}

void Allocator::find_triples(const Model& model) {
  for (Index k = 0; k < model.num_sections(); ++k) {
    Triple triple{};
    triple.first = model.first_coordinate(k);
    int count = 0;
    for (Index j = 0; j < model.num_cables(); ++j) {
      if (model.cables()[static_cast<std::size_t>(j)].end_section != k) continue;
      if (count < 3) triple.cables[count] = j;
      ++count;
    }
    MatrixXd b(2, 3);
    for (int i = 0; count == 3 && i < 3; ++i)
      b.col(i) = B_.col(triple.cables[i]).segment<2>(triple.first);
    // The cross product of the rows of b spans its null space.
    const Vector3d top = b.row(0).transpose(), bottom = b.row(1).transpose();
    triple.null = top.cross(bottom);
    if (count != 3 || !(triple.null.minCoeff() * triple.null.maxCoeff() > 0.0)) {
      triples_.clear();
      return;
    }
    triple.null *= (triple.null[0] > 0.0 ? 1.0 : -1.0) / triple.null.norm();
    const Eigen::Matrix2d gram = b * b.transpose();
    triple.pseudo_inverse = b.transpose() * gram.inverse();
    triples_.push_back(triple);
  }
}

bool Allocator::at_limit(Index cable) const noexcept {
  assert(cable >= 0 && cable < F_.size());
  return place_[cable] == Place::lower || place_[cable] == Place::upper;
}

/// The pseudo-inverse's part plus a multiple of the null vector; the multiple nearest to zero is
/// least-norm.
bool Allocator::solve_triple(const Triple& triple, const Eigen::Vector2d& force) noexcept {
  Vector3d base;
  base.noalias() = triple.pseudo_inverse * force;
  double least = -HUGE_VAL, most = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const Index j = triple.cables[i];
    least = std::fmax(least, (low_[j] - base[i]) / triple.null[i]);
    most = std::fmin(most, (high_[j] - base[i]) / triple.null[i]);
  }
  if (!(least <= most)) return false;
  const double common = std::clamp(0.0, least, most);
  for (int i = 0; i < 3; ++i) {
    const Index j = triple.cables[i];
    F_[j] = std::fmin(std::fmax(base[i] + common * triple.null[i], low_[j]), high_[j]);
    place_[j] = F_[j] == low_[j] ? Place::lower : F_[j] == high_[j] ? Place::upper : Place::free;
  }
  return true;
}

/// Cables pull on all sections alike, so those that end at a section give what the next ones do
/// not.
bool Allocator::solve_in_closed_form() noexcept {
  for (std::size_t k = 0; k < triples_.size(); ++k) {
    const Triple& triple = triples_[k];
    Eigen::Vector2d own = Q_.segment<2>(triple.first);
    if (k + 1 < triples_.size()) own -= Q_.segment<2>(triples_[k + 1].first);
    if (!solve_triple(triple, own)) return false;
  }
  return !triples_.empty();
}

void Allocator::initialise_active_set() noexcept {
  for (Index j = 0; j < F_.size(); ++j) {
    if (place_[j] == Place::unused) continue;
    F_[j] = std::fmin(std::fmax(0.0, low_[j]), high_[j]);
    place_[j] = low_[j] >= 0.0 ? Place::lower : high_[j] <= 0.0 ? Place::upper : Place::free;
  }
}

void Allocator::left_for_free() noexcept {
  rest_ = Q_;
  for (Index j = 0; j < F_.size(); ++j) {
    if (place_[j] != Place::free) rest_ -= B_.col(j) * F_[j];
  }
}

void Allocator::solve_free() noexcept {
  normal_.setZero();
  for (Index j = 0; j < F_.size(); ++j) {
    if (place_[j] == Place::free) normal_.noalias() += B_.col(j) * B_.col(j).transpose();
  }
  normal_.diagonal().array() += epsilon_;
  ldlt_.compute(normal_);
  left_for_free();
  lambda_ = rest_;
  ldlt_.solveInPlace(lambda_);
}

/// Moves towards the minimum over the free cables; true when one reached a limit on the way.
bool Allocator::step_to_first_bound() noexcept {
  solve_free();
  double share = 1.0;
  Index first = -1;
  Place side = Place::free;
  for (Index j = 0; j < F_.size(); ++j) {
    if (place_[j] != Place::free) continue;
    const double wanted = B_.col(j).dot(lambda_);
    if (wanted >= low_[j] && wanted <= high_[j]) continue;
    const double limit = wanted < low_[j] ? low_[j] : high_[j];
    const double part = (limit - F_[j]) / (wanted - F_[j]);
    if (first < 0 || part < share) {
      share = part;
      first = j;
      side = wanted < low_[j] ? Place::lower : Place::upper;
    }
  }
  for (Index j = 0; j < F_.size(); ++j) {
    if (place_[j] == Place::free) F_[j] += share * (B_.col(j).dot(lambda_) - F_[j]);
  }
  if (first < 0) return false;
  F_[first] = side == Place::lower ? low_[first] : high_[first];
  place_[first] = side;
  return true;
}

/// Releases the fixed cable that most wants to move inwards; false when none does.
bool Allocator::release_by_multiplier() noexcept {
  Index best = -1;
  double most = 1e-9 * (1.0 + lambda_.norm());
  for (Index j = 0; j < F_.size(); ++j) {
    if (!at_limit(j) || low_[j] == high_[j]) continue;
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

/// With the set known, refines the free tensions until Q is met to rounding: each pass leaves
/// epsilon / (s^2 + epsilon) of the error along a singular value s of the free cables, and what
/// cannot be met does not move them.
void Allocator::polish() noexcept {
  solve_free();
  double last = HUGE_VAL;
  for (int pass = 0; pass < max_passes; ++pass) {
    for (Index j = 0; j < F_.size(); ++j) {
      if (place_[j] == Place::free) rest_ -= B_.col(j) * B_.col(j).dot(lambda_);
    }
    // rest_ is now the error of the force with F = B^T lambda on the free cables.
    const double error = rest_.norm();
    if (pass >= least_passes && !(error < shrinks * last)) break;
    last = error;
    ldlt_.solveInPlace(rest_);
    lambda_ += rest_;
    left_for_free();
  }
  for (Index j = 0; j < F_.size(); ++j) {
    if (place_[j] == Place::free) {
      F_[j] = std::fmin(std::fmax(B_.col(j).dot(lambda_), low_[j]), high_[j]);
    }
  }
}

void Allocator::find_active_set() noexcept {
  // Each cable is released and caught a few times at most; the limit only guards rounding.
  const Index max_changes = 50 * (F_.size() + 1);
  for (Index change = 0; change < max_changes; ++change) {
    if (step_to_first_bound()) continue;
    if (!release_by_multiplier()) break;
  }
  polish();
}

void Allocator::search() noexcept {
  initialise_active_set();
  epsilon_ = coarse;
  find_active_set();
  if (is_met()) return;
  coarse_F_ = F_;
  coarse_place_ = place_;
  epsilon_ = fine;
  find_active_set();
  if (is_met()) return;
  F_ = coarse_F_;
  place_ = coarse_place_;
}

/// Whether F gives Q; rest_ is what it does not.
bool Allocator::is_met() noexcept {
  rest_ = Q_;
  double size = Q_.norm();
  for (Index j = 0; j < F_.size(); ++j) {
    rest_ -= B_.col(j) * F_[j];
    size += std::abs(F_[j]) * B_.col(j).norm();
  }
  return rest_.norm() <= met * size + negligible_ / unit_;
}

bool Allocator::solve(const ConstVectorRef& force) noexcept {
  if (force.size() != Q_.size() || !force.allFinite()) return false;
  // All of it grows with the force: in a unit of its size, nothing that is squared overflows.
  const double largest = force.lpNorm<Eigen::Infinity>();
  unit_ = largest > huge ? largest : 1.0;
  low_ = lower_ / unit_;
  high_ = upper_ / unit_;
  Q_ = (force / unit_).cwiseQuotient(scale_);
  if (!solve_in_closed_form()) search();
  const bool feasible = is_met();
  for (Index j = 0; j < F_.size(); ++j) {
    tension_[j] = place_[j] == Place::lower   ? lower_[j]
                  : place_[j] == Place::upper ? upper_[j]
                                              : F_[j] * unit_;
  }
  force_ = unit_ * scale_.cwiseProduct(Q_ - rest_);
  return feasible && tension_.allFinite();
}

}  // namespace cdcr
