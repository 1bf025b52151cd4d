#include "estimation/transition.hpp"

#include <cmath>

namespace cdcr::detail {

Transition::Transition(Index num_coordinates, const VectorXd& density, double period, int substeps)
    : d_(num_coordinates),
      doublings_(static_cast<int>(std::ceil(std::log2(substeps)))),
      root_(density.cwiseSqrt()) {
  step_ = std::ldexp(period, -doublings_);
  const Index size = d_ + density.size();
  half_ = whole_ = noise_ = product_ = MatrixXd::Identity(size, size);
  spread_ = MatrixXd::Zero(size, density.size());
}

/// exp(A t) to the fourth power of A, as far as a Runge-Kutta step of the linear system goes.
void Transition::expand(const MatrixXd& slopes, double time, MatrixXd& out) noexcept {
  out.setIdentity();
  for (int k = 4; k >= 1; --k) {
    const double part = time / k;
    product_.topRows(d_) = part * out.middleRows(d_, d_);
    product_.middleRows(d_, d_).noalias() = part * slopes * out;
    product_.bottomRows(out.rows() - 2 * d_).setZero();
    product_.diagonal().array() += 1.0;
    out.swap(product_);
  }
}

void Transition::add_noise(double weight, const MatrixXd& moved) noexcept {
  spread_ = moved.rightCols(root_.size()) * (std::sqrt(weight) * root_).asDiagonal();
  noise_.noalias() += spread_ * spread_.transpose();
}

void Transition::update(const MatrixXd& slopes) noexcept {
  expand(slopes, 0.5 * step_, half_);
  expand(slopes, step_, whole_);
  noise_.setZero();
  noise_.diagonal().tail(root_.size()) = (step_ / 6.0) * root_.cwiseAbs2();
  add_noise(4.0 * step_ / 6.0, half_);
  add_noise(step_ / 6.0, whole_);
  for (int i = 0; i < doublings_; ++i) {
    product_.noalias() = whole_ * noise_;
    noise_.noalias() += product_ * whole_.transpose();
    product_.noalias() = whole_ * whole_;
    whole_.swap(product_);
  }
}

}  // namespace cdcr::detail
