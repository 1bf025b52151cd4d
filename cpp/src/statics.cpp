#include "cdcr/statics.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cdcr/dynamics.hpp"
#include "cdcr/plant.hpp"

namespace cdcr {
namespace {

constexpr int max_iterations = 200;
// A stiffness this small beside the largest is zero but for rounding.
constexpr double neutral = 1e-12;

/// Energy to be minimised: Pi(q) = U(q) - (B F).q, whose gradient is zero at rest.
class Energy {
 public:
  Energy(const Model& model, VectorXd force)
      : model_(model), data_(model), force_(std::move(force)) {}

  double value(const VectorXd& q) { return potential_energy(model_, data_, q) - force_.dot(q); }
  VectorXd gradient(const VectorXd& q) {
    VectorXd g(q.size());
    potential_gradient(model_, data_, q, g);
    return g - force_;
  }
  MatrixXd hessian(const VectorXd& q) {
    MatrixXd H(q.size(), q.size());
    potential_hessian(model_, data_, q, H);
    return H;
  }
  /// Rounding error that the gradient cannot get below.
  [[nodiscard]] double noise(const VectorXd& q) const {
    const double elastic = model_.stiffness().maxCoeff() * q.lpNorm<Eigen::Infinity>();
    return 1e-15 * (elastic + force_.lpNorm<Eigen::Infinity>() + weight_moment());
  }

 private:
  [[nodiscard]] double weight_moment() const {
    double mass = model_.robot().payload, length = 0.0;
    for (const Section& s : model_.robot().sections) {
      mass += s.backbone_mass + s.num_disks * s.disk_mass;
      length += s.length;
    }
    return mass * length * model_.robot().gravity.norm();
  }

  const Model& model_;
  Data data_;
  VectorXd force_;
};

bool within_limit(const VectorXd& q) {
  for (Index i = 0; i < q.size(); i += 2) {
    if (!(q.segment<2>(i).norm() <= max_bending)) return false;
  }
  return true;
}

/// Newton step with the eigenvalues of H made positive, so that it always points downhill.
VectorXd downhill_step(const MatrixXd& H, const VectorXd& g) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(H);
  const double floor = 1e-6 * eigen.eigenvalues().cwiseAbs().maxCoeff();
  const VectorXd curvature = eigen.eigenvalues().cwiseAbs().cwiseMax(floor);
  const VectorXd in_eigenbasis = eigen.eigenvectors().transpose() * g;
  return -(eigen.eigenvectors() * in_eigenbasis.cwiseQuotient(curvature));
}

}  // namespace

Equilibrium equilibrium(const Model& model, const VectorXd& tension, const VectorXd& q0) {
  if (check_tension(model, tension) != Status::ok) {
    std::ostringstream text;
    text << "tension must be " << model.num_cables()
         << " finite values >= 0 N (a cable cannot push), got [" << tension.transpose() << "]";
    throw std::invalid_argument(text.str());
  }
  if (q0.size() != 0 && (q0.size() != model.num_coordinates() || !q0.allFinite())) {
    std::ostringstream text;
    text << "q0 must be " << model.num_coordinates() << " finite values, got [" << q0.transpose()
         << "]";
    throw std::invalid_argument(text.str());
  }

  const VectorXd force = model.actuation_matrix() * tension;
  Energy energy(model, force);
  Equilibrium result;
  result.q = q0;
  if (q0.size() == 0) {
    result.q = force;
    for (Index i = 0; i < model.num_sections(); ++i) {
      result.q.segment<2>(2 * i) /= model.stiffness()[i];
    }
  }
  if (!within_limit(result.q)) {
    result.status = Status::bending_limit;
    result.q.setZero();
  }

  VectorXd& q = result.q;
  VectorXd gradient = energy.gradient(q);
  double value = energy.value(q);
  bool converged = false;
  for (; result.iterations < max_iterations; ++result.iterations) {
    result.residual = gradient.lpNorm<Eigen::Infinity>();
    if (result.residual <= energy.noise(q)) {
      converged = true;
      break;
    }
    VectorXd step = downhill_step(energy.hessian(q), gradient);
    const double limit = 1.0;  // [rad]: farther than this the quadratic model means little
    if (step.norm() > limit) step *= limit / step.norm();
    // Armijo's rule; near the end energy differences drown in rounding, so there a smaller
    // gradient counts as progress too.
    const double slope = gradient.dot(step);
    bool moved = false;
    double factor = 1.0;
    for (int halving = 0; halving < 33 && !moved; ++halving, factor = std::ldexp(1.0, -halving)) {
      const VectorXd trial = q + factor * step;
      if (!within_limit(trial)) continue;
      const double trial_value = energy.value(trial);
      const VectorXd trial_gradient = energy.gradient(trial);
      if (trial_value <= value + 1e-4 * factor * slope ||
          (halving == 0 && trial_gradient.norm() < 0.5 * gradient.norm() &&
           trial_value <= value + 1e-12 * std::abs(value))) {
        q = trial;
        value = trial_value;
        gradient = trial_gradient;
        moved = true;
      }
    }
    if (!moved) break;
  }
  result.residual = gradient.lpNorm<Eigen::Infinity>();
  // A search stalled by rounding has converged as far as the arithmetic allows.
  converged = converged || result.residual <= 1e3 * energy.noise(q);
  const bool at_limit = q.segment<2>(0).norm() > 0.999 * max_bending;
  result.status = converged ? Status::ok : at_limit ? Status::bending_limit : Status::not_converged;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(energy.hessian(q));
  result.eigenvalues = eigen.eigenvalues();
  result.stable = result.eigenvalues.minCoeff() > neutral * result.eigenvalues.maxCoeff();
  return result;
}

}  // namespace cdcr
