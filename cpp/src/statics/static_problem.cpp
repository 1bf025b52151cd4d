#include "statics/static_problem.hpp"

#include <cmath>

#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/statics.hpp"
#include "chain/dual.hpp"
#include "chain/gradient.hpp"
#include "dynamics/parts.hpp"
#include "loads/cable_force.hpp"
#include "loads/wrench_force.hpp"

namespace cdcr {
namespace detail {
namespace {

/// Size of the moments at the base that weight and wrenches can make.
double moment_of(const Model& model, const Wrenches& wrenches) {
  const Chain& chain = chain_of(model);
  double mass = chain.payload.mass, length = 0.0, sum = 0.0;
  for (const SectionParameters& section : chain.sections) {
    mass += section.mass;
    length += section.length;
  }
  for (const Wrench& w : wrenches) sum += w.force.norm() * length + w.moment.norm();
  return sum + mass * (length + chain.payload.position.norm()) * chain.gravity.norm();
}

}  // namespace

StaticProblem::StaticProblem(const Model& model, const ConstVectorRef& command,
                             const Wrenches& wrenches)
    : model_(model),
      command_(command),
      wrenches_(wrenches),
      data_(model),
      constant_force_(VectorXd::Zero(model.num_coordinates())),
      has_energy_(conservative(wrenches)) {
  const MatrixXd& B = model.actuation_matrix();
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    if (cable.length_driven()) {
      has_springs_ = true;
      size_ += B.col(j).lpNorm<Eigen::Infinity>() * cable.stiffness * model.straight_lengths()[j];
    } else {
      constant_force_ += B.col(j) * command[j];
    }
  }
  size_ += constant_force_.lpNorm<Eigen::Infinity>() + moment_of(model, wrenches);
}

void StaticProblem::residual(const ConstVectorRef& q, VectorRef r) noexcept {
  potential_gradient(model_, data_, q, r);
  r -= constant_force_;
  for (Index j = 0; has_springs_ && j < model_.num_cables(); ++j) {
    const Cable& cable = model_.cables()[static_cast<std::size_t>(j)];
    if (!cable.length_driven()) continue;
    const double longer = elongation(model_, j, q.data(), double{command_[j]});
    if (longer > 0.0) r -= model_.actuation_matrix().col(j) * (cable.stiffness * longer);
  }
  if (!wrenches_.empty()) {
    data_.force.setZero();
    add_wrench_force(model_, q, wrenches_, data_.force);
    r -= data_.force;
  }
  if (load_factor_ == 1.0) return;
  for (Index i = 0; i < q.size(); ++i) {
    const double elastic = model_.coordinate_stiffness()[i] * q[i];
    r[i] = elastic + load_factor_ * (r[i] - elastic);
  }
}

void StaticProblem::stiffness(const ConstVectorRef& q, MatrixRef K) noexcept {
  static_stiffness(model_, q, command_, wrenches_, K);
  if (load_factor_ == 1.0) return;
  K *= load_factor_;
  for (Index i = 0; i < q.size(); ++i)
    K(i, i) += (1.0 - load_factor_) * model_.coordinate_stiffness()[i];
}

double StaticProblem::energy(const ConstVectorRef& q) noexcept {
  double U = energy_from_base(model_, data_, q) - constant_force_.dot(q);
  if (has_springs_) U += cable_energy(model_, q, command_);
  for (const Wrench& w : wrenches_) U -= w.force.dot(pose(model_, q, w.section, w.fraction).p);
  if (load_factor_ == 1.0) return U;
  double elastic = 0.0;
  for (Index i = 0; i < q.size(); ++i)
    elastic += 0.5 * model_.coordinate_stiffness()[i] * q[i] * q[i];
  return elastic + load_factor_ * (U - elastic);
}

double StaticProblem::rounding_bound(const ConstVectorRef& q) const noexcept {
  const double elastic = model_.stiffness().maxCoeff() * q.lpNorm<Eigen::Infinity>();
  return 1e-15 * (elastic + size_);
}

}  // namespace detail

bool conservative(const Wrenches& wrenches) noexcept {
  for (const Wrench& w : wrenches) {
    const bool follows = w.frame == Wrench::Frame::local && !w.force.isZero(0.0);
    if (follows || !w.moment.isZero(0.0)) return false;
  }
  return true;
}

void static_stiffness(const Model& model, const ConstVectorRef& q, const ConstVectorRef& command,
                      const Wrenches& wrenches, MatrixRef K) noexcept {
  using detail::Dual;
  const Index m = model.num_coordinates();
  assert(detail::of_coordinates(model, q) && detail::of_cables(model, command));
  assert(check_wrenches(model, wrenches) == Status::ok && detail::has_size(K, m, m));
  if (model.has_closed_form() && wrenches.empty()) {
    detail::closed_form::potential_hessian(detail::single_of(model), q, K);
  } else {
    const detail::Chain& chain = detail::chain_of(model);
    const auto size = static_cast<int>(m);
    detail::ArcChainState<Dual> state;
    detail::differentiate(size, size, q.data(), K, [&](const Dual* x, Dual* y) {
      state.update_position(chain, x);
      detail::potential_gradient(chain, state, x, y);
      if (wrenches.empty()) return;
      Dual pull[max_coordinates];
      for (int i = 0; i < size; ++i) pull[i] = Dual(0.0);
      detail::add_wrench_force<Dual>(chain, x, wrenches, pull);
      for (int i = 0; i < size; ++i) y[i] -= pull[i];
    });
  }
  const MatrixXd& B = model.actuation_matrix();
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    if (!cable.length_driven() ||
        !(detail::elongation(model, j, q.data(), double{command[j]}) > 0.0)) {
      continue;
    }
    const Index rows = model.cable_rows()[static_cast<std::size_t>(j)];
    for (Index k = 0; k < rows; ++k) {
      K.col(k).head(rows) += B.col(j).head(rows) * (cable.stiffness * B(k, j));
    }
  }
}

}  // namespace cdcr
