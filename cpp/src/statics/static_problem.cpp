#include "statics/static_problem.hpp"

#include <cmath>

#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/statics.hpp"
#include "derivatives/cable_curvature.hpp"
#include "derivatives/weight_hessian.hpp"
#include "dynamics/kept.hpp"
#include "loads/cable_force.hpp"
#include "loads/force_derivatives.hpp"
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

/// Adds to the lower half of K the second derivatives of the lengths of some cables through rods,
/// times pull_of(cable).
template <class F>
void add_path_curvature(const Model& model, const ConstVectorRef& q, Index first, Index count,
                        const F& pull_of, MatrixRef K) {
  const Chain& chain = chain_of(model);
  for (Index k = 0; k < chain.num_sections(); ++k) {
    const Index at = chain.first[k], size = chain.first[k + 1] - at;
    CableCurvature sum(*chain.sections[k].rod, q.data() + at);
    for (Index j = first; j < first + count; ++j) {
      const RodCable* cable = path_of(model, j).in(k);
      if (cable == nullptr) continue;
      const double pull = pull_of(j);
      if (pull != 0.0) sum.add(*cable, pull, K.block(at, at, size, size));
    }
    sum.finish(K.block(at, at, size, size));
  }
}

/// Adds to K the stiffness of the cables of rods at rest, without friction: each pulls along
/// -dl/dq, which changes with the shape, and a spring pulls more where it is longer.
void add_path_stiffness(const Model& model, const ConstVectorRef& q, const ConstVectorRef& command,
                        MatrixRef K) noexcept {
  const auto tension = [&](Index j) { return is_length_driven(model, j) ? 0.0 : command[j]; };
  add_path_curvature(model, q, 0, model.num_cables(), tension, K);
  for (Index j = 0; j < model.num_cables(); ++j) {
    if (!is_length_driven(model, j)) continue;
    const CableSlope<double> slope(chain_of(model), path_of(model, j), q.data());
    const double longer = slope.length - (command[j] + model.slack_offset()[j]);
    if (!(longer > 0.0)) continue;
    const double stiffness = model.cables()[static_cast<std::size_t>(j)].stiffness;
    add_path_curvature(model, q, j, 1, [&](Index /*j*/) { return stiffness * longer; }, K);
    for (Index i = 0; i < q.size(); ++i) {
      for (Index k = i; k < q.size(); ++k) {
        K(k, i) += slope.column[k] * stiffness * slope.column[i];
      }
    }
  }
}

}  // namespace

StaticProblem::StaticProblem(const Model& model, const ConstVectorRef& command,
                             const Wrenches& wrenches)
    : model_(model),
      command_(command),
      wrenches_(wrenches),
      kept_(model.has_closed_form() ? nullptr : std::make_unique<KeptChain>(model)),
      constant_force_(VectorXd::Zero(model.num_coordinates())),
      force_(constant_force_),
      has_energy_(conservative(wrenches)),
      has_paths_(!model.has_constant_actuation()) {
  const MatrixXd& B = model.actuation_matrix();
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    if (cable.length_driven()) {
      has_springs_ = true;
      size_ += B.col(j).lpNorm<Eigen::Infinity>() *
               (cable.stiffness * model.straight_lengths()[j] + cable.pretension);
    } else if (has_paths_) {
      size_ += B.col(j).lpNorm<Eigen::Infinity>() * command[j];
      straight_work_ += command[j] * model.straight_lengths()[j];
    } else {
      constant_force_ += B.col(j) * command[j];
    }
  }
  size_ += constant_force_.lpNorm<Eigen::Infinity>() + moment_of(model, wrenches);
}

void StaticProblem::residual(const ConstVectorRef& q, VectorRef r) noexcept {
  potential_gradient(model_, kept_.get(), q, r);
  r -= constant_force_;
  if (has_paths_) {
    force_.setZero();
    static_cast<void>(add_smooth_forces(model_, q.data(), command_.data(), force_.data()));
    r -= force_;
  }
  for (Index j = 0; has_springs_ && j < model_.num_cables(); ++j) {
    const Cable& cable = model_.cables()[static_cast<std::size_t>(j)];
    if (!cable.length_driven()) continue;
    if (has_paths_) {
      const CableSlope<double> slope(chain_of(model_), path_of(model_, j), q.data());
      const double longer = slope.length - command_[j] - model_.slack_offset()[j];
      const double pull = cable.stiffness * std::fmax(0.0, longer);
      for (Index i = 0; i < q.size(); ++i) r[i] -= slope.column[i] * pull;
      continue;
    }
    const double longer = elongation(model_, j, q.data(), double{command_[j]});
    if (longer > 0.0) r -= model_.actuation_matrix().col(j) * (cable.stiffness * longer);
  }
  if (!wrenches_.empty()) {
    force_.setZero();
    add_wrench_force(model_, q, wrenches_, force_);
    r -= force_;
  }
  if (load_factor_ == 1.0) return;
  elastic_.noalias() = model_.elastic_stiffness().lazyProduct(q - model_.rest());
  r = elastic_ + load_factor_ * (r - elastic_);
}

void StaticProblem::stiffness(const ConstVectorRef& q, MatrixRef K) noexcept {
  static_stiffness(model_, kept_.get(), q, command_, wrenches_, K);
  if (load_factor_ == 1.0) return;
  K = load_factor_ * K + (1.0 - load_factor_) * model_.elastic_stiffness();
}

double StaticProblem::energy(const ConstVectorRef& q) noexcept {
  double U = energy_from_base(model_, kept_.get(), q) - constant_force_.dot(q);
  if (has_springs_) U += cable_energy(model_, q, command_);
  if (has_paths_) {
    double unused[max_coordinates] = {};
    U += add_smooth_forces(model_, q.data(), command_.data(), unused) - straight_work_;
  }
  for (const Wrench& w : wrenches_) U -= w.force.dot(pose(model_, q, w.section, w.fraction).p);
  if (load_factor_ == 1.0) return U;
  elastic_.noalias() = model_.elastic_stiffness().lazyProduct(q - model_.rest());
  const double elastic = 0.5 * elastic_.dot(q - model_.rest());
  return elastic + load_factor_ * (U - elastic);
}

double StaticProblem::rounding_bound(const ConstVectorRef& q) const noexcept {
  const double elastic =
      model_.has_rods()
          ? model_.elastic_stiffness().diagonal().cwiseProduct(q).lpNorm<Eigen::Infinity>()
          : model_.stiffness().maxCoeff() * q.lpNorm<Eigen::Infinity>();
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

namespace {

/// Adds to the stiffness of the backbone and its weight those of cables and wrenches.
void add_load_stiffness(const Model& model, const ConstVectorRef& q, const ConstVectorRef& command,
                        const Wrenches& wrenches, MatrixRef K) noexcept {
  assert(detail::of_coordinates(model, q) && detail::of_cables(model, command));
  assert(check_wrenches(model, wrenches) == Status::ok);
  if (!model.has_constant_actuation()) {
    detail::add_path_stiffness(model, q, command, K);
    K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
    return detail::subtract_wrench_stiffness(model, q, wrenches, K);
  }
  detail::subtract_wrench_stiffness(model, q, wrenches, K);
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

}  // namespace

void detail::static_stiffness(const Model& model, KeptChain* kept, const ConstVectorRef& q,
                              const ConstVectorRef& command, const Wrenches& wrenches,
                              MatrixRef K) noexcept {
  potential_hessian(model, kept, q, K);
  add_load_stiffness(model, q, command, wrenches, K);
}

void static_stiffness(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& command, const Wrenches& wrenches,
                      MatrixRef K) noexcept {
  assert(data.belongs_to(model));
  detail::static_stiffness(model, data.kept(), q, command, wrenches, K);
}

void static_stiffness(const Model& model, const ConstVectorRef& q, const ConstVectorRef& command,
                      const Wrenches& wrenches, MatrixRef K) noexcept {
  assert(detail::has_size(K, model.num_coordinates(), model.num_coordinates()));
  if (model.has_rods()) {
    detail::KeptChain kept(model);
    return detail::static_stiffness(model, &kept, q, command, wrenches, K);
  }
  if (model.has_closed_form()) {
    detail::closed_form::potential_hessian(detail::single_of(model), q, K);
  } else {
    detail::MotionState state;
    update_position(detail::chain_of(model), state, q.data());
    detail::weight_hessian(detail::chain_of(model), state, q.data(), K);
  }
  add_load_stiffness(model, q, command, wrenches, K);
}

}  // namespace cdcr
