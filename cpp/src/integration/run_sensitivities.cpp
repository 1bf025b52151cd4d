#include "integration/run_sensitivities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/arguments.hpp"
#include "cdcr/linearization.hpp"

namespace cdcr {

Index Sensitivities::columns(const Model& model) const noexcept {
  const Index d = model.num_coordinates();
  return (q0 ? d : 0) + (qd0 ? d : 0) + (command ? model.num_cables() : 0) +
         (parameters ? parameters->size() : 0);
}

namespace detail {
namespace {

// Of h^2 dqdd/dq + h dqdd/dqd: a step over which the equations do not change anything.
constexpr double still = 1e-4;
// Tolerance from which on three stages are as good as the run.
constexpr double coarse = 2e-6;

// Five stages where the run's steps are long for three, which cost little more than half.
int stages_for(Method method, const Options& options) {
  const bool high =
      method == Method::dop853 || method == Method::adams || method == Method::automatic;
  return high && Tolerances(options, method).rtol < coarse ? 5 : 3;
}

bool has_fixed_steps(Method method) {
  return method == Method::rk4 || method == Method::rosenbrock;
}

}  // namespace

RunSensitivities::RunSensitivities(RobotOde& ode, const Sensitivities& asked, double start,
                                   Method method, const Options& options)
    : ode_(ode),
      asked_(asked),
      d_(ode.model().num_coordinates()),
      columns_(asked.columns(ode.model())),
      first_command_((asked.q0 ? d_ : 0) + (asked.qd0 ? d_ : 0)),
      first_parameter_(first_command_ + (asked.command ? ode.model().num_cables() : 0)),
      method_(Collocation::radau(stages_for(method, options))),
      data_(ode.model()),
      room_(ode.model()),
      largest_error_(has_fixed_steps(method) ? std::numeric_limits<double>::infinity()
                                             : 2.0 * std::sqrt(Tolerances(options, method).rtol)),
      y_(2 * d_),
      on_q_(d_, d_),
      on_qd_(d_, d_),
      on_command_(d_, ode.model().num_cables()),
      on_parameters_(d_, columns_ - first_parameter_),
      equations_(method_.stages() * d_, method_.stages() * d_),
      slopes_(method_.stages() * d_, columns_),
      errors_(2 * d_, columns_),
      factors_(equations_.rows()) {
  require(ode.model().num_deflections() == 0 && !ode.model().has_backlash(),
          "a run has no sensitivities where cables or drives remember: presliding_stiffness and "
          "backlash must be 0");
  if (asked.command_slopes) {
    const Index size = on_parameters_.cols() * ode.model().num_cables();
    require(asked.command_slopes->size() == size, "command_slopes must have ", size,
            " values, got ", asked.command_slopes->size());
    command_slopes_ = asked.command_slopes->since(start);
    command_slope_.resize(size);
  }
  set_start(asked);
}

void RunSensitivities::set_start(const Sensitivities& asked) {
  here_.setZero(2 * d_, columns_);
  if (asked.q0) here_.topLeftCorner(d_, d_).setIdentity();
  if (asked.qd0) here_.block(d_, asked.q0 ? d_ : 0, d_, d_).setIdentity();
  if (asked.start.size() == 0) return;
  require(asked.start.rows() == 2 * d_ && asked.start.cols() == columns_,
          "sensitivities at the start must be of shape (", 2 * d_, ", ", columns_, "), got (",
          asked.start.rows(), ", ", asked.start.cols(), ")");
  here_ = asked.start;
}

void RunSensitivities::differentiate(Integrator& integrator, double t, Index segment) {
  if (t == integrator.time()) {
    y_ = integrator.state();
  } else {
    integrator.interpolate(t, y_);
  }
  ode_.update_inputs(t, y_.data());
  const Model& model = ode_.model();
  const ConstVectorRef q = y_.head(d_), qd = y_.tail(d_);
  const VectorXd& command = ode_.command();
  const Wrenches& wrenches = ode_.wrenches();
  on_wrenches_.resize(d_, 6 * static_cast<Index>(wrenches.size()));
  acceleration_derivatives(model, data_, q, qd, command, wrenches, on_q_, on_qd_, on_command_,
                           on_wrenches_);
  if (!asked_.parameters) return;
  parameter_derivatives(model, data_, *asked_.parameters, room_, q, qd, command, wrenches,
                        on_parameters_);
  if (!command_slopes_) return;
  command_slopes_->evaluate(t, segment, q, qd, command_slope_);
  on_parameters_ +=
      on_command_ *
      Eigen::Map<const MatrixXd>(command_slope_.data(), on_command_.cols(), on_parameters_.cols());
}

/// One step of collocation from there_ at t over h, in terms of the accelerations G of the stages:
/// S_qd = S_qd0 + h sum a G, S_q = S_q0 + h c S_qd0 + h^2 sum a2 G. Writes moved_, and returns an
/// estimate of the error, the root of which grows as the error itself. Of a step in which next to
/// nothing moves it would be rounding, where a column has just begun to grow from zero.
double RunSensitivities::step(Integrator& integrator, double t, double h) {
  const Index s = method_.stages();
  const Index segment = command_slopes_ ? command_slopes_->segment(t + 0.5 * h) : 0;
  const auto before = there_.topRows(d_), rate = there_.bottomRows(d_);
  double fastest = 0.0;
  for (Index i = 0; i < s; ++i) {
    const double c = method_.nodes[i];
    differentiate(integrator, i == s - 1 && inside_ == 0.0 ? t + h : t + (c - inside_) * h,
                  segment);
    for (Index j = 0; j < s; ++j) {
      equations_.block(i * d_, j * d_, d_, d_) =
          -(h * method_.once(i, j)) * on_qd_ - (h * h * method_.twice(i, j)) * on_q_;
    }
    equations_.block(i * d_, i * d_, d_, d_).diagonal().array() += 1.0;
    fastest = std::fmax(
        fastest, h * h * on_q_.lpNorm<Eigen::Infinity>() + h * on_qd_.lpNorm<Eigen::Infinity>());
    auto right = slopes_.middleRows(i * d_, d_);
    right.noalias() = on_q_ * (before + (c * h) * rate) + on_qd_ * rate;
    if (asked_.command) right.middleCols(first_command_, on_command_.cols()) += on_command_;
    if (asked_.parameters) right.rightCols(on_parameters_.cols()) += on_parameters_;
  }
  factors_.compute(equations_);
  slopes_ = factors_.solve(slopes_);
  moved_ = there_;
  moved_.topRows(d_) += h * rate;
  errors_.setZero();
  Eigen::RowVectorXd size = rate.cwiseAbs().colwise().maxCoeff();
  for (Index j = 0; j < s; ++j) {
    const auto slope = slopes_.middleRows(j * d_, d_);
    moved_.topRows(d_) += (h * h * method_.twice(s - 1, j)) * slope;
    moved_.bottomRows(d_) += (h * method_.once(s - 1, j)) * slope;
    errors_.topRows(d_) += (h * method_.error(0, j)) * slope;
    errors_.bottomRows(d_) += (h * method_.error(1, j)) * slope;
    size = size.cwiseMax(h * slope.cwiseAbs().colwise().maxCoeff());
  }
  if (fastest < still) return 0.0;
  size.array() += std::numeric_limits<double>::min();
  return (errors_.cwiseAbs().colwise().maxCoeff().array() / size.array()).maxCoeff();
}

/// From the time reached to t: one step where the run's own are short enough, as they are unless
/// the robot stands still.
void RunSensitivities::solve(Integrator& integrator, double t) {
  constexpr double smallest = 1e-4;  // step, of the way
  there_ = here_;
  double at = time_, h = t - time_;
  const double power = 1.0 / static_cast<double>(method_.stages());
  while (at < t) {
    const bool last = at + 1.01 * h >= t;  // rather a slightly longer step than a tiny one after it
    if (last) h = t - at;
    const double error = step(integrator, at, h);
    const double change = 0.8 * std::pow(largest_error_ / (error + 1e-300), power);
    if (error > largest_error_ && h > smallest * (t - time_)) {
      h *= std::clamp(change, 0.1, 0.5);
      continue;
    }
    there_.swap(moved_);
    at = last ? t : at + h;
    h = std::fmax(h * std::clamp(change, 0.5, 5.0), smallest * (t - time_));
  }
  there_time_ = t;
}

const MatrixXd& RunSensitivities::at(Integrator& integrator, double t) {
  if (t <= time_) return here_;
  if (t != there_time_) solve(integrator, t);
  return there_;
}

void RunSensitivities::advance(Integrator& integrator, double t) {
  if (t <= time_) return;
  here_ = at(integrator, t);
  time_ = there_time_ = t;
}

void RunSensitivities::advance_to_kink(Integrator& integrator, double t) {
  inside_ = 1e-8;
  there_time_ = time_;
  advance(integrator, t);
  inside_ = 0.0;
}

}  // namespace detail
}  // namespace cdcr
