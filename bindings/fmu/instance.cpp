#include "instance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "cdcr/cables.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/simulate.hpp"

namespace cdcr::fmu {
namespace {

[[noreturn]] void refuse(const std::string& sentence) {
  throw std::invalid_argument(sentence);
}

std::string text(double value) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(9);
  stream << value;
  return stream.str();
}

Setup checked_setup(const std::string& resources, const std::string& token) {
  Setup setup = read_setup(resources + "/setup.txt");
  if (setup.token != token) {
    refuse("the model description is of another FMU: its token is '" + token +
           "', that of the resources '" + setup.token + "'");
  }
  return setup;
}

}  // namespace

void need(bool condition, const char* sentence) {
  if (!condition) throw std::invalid_argument(sentence);
}

std::string given(const char* text) {
  if (!text) return {};
  return text;
}

Instance::Instance(const std::string& resources, const std::string& token)
    : setup_(checked_setup(resources, token)),
      model_(setup_.robot),
      data_(model_),
      variables_(model_),
      kept_(VectorXd::Zero(variables_.kept())) {
  require_inertia(model_);
  validate(setup_.options);
  segment(Kind::gravity) = model_.robot().gravity;
  rest_command(model_, segment(Kind::command));
  start_ = kept_;
}

void Instance::require_phase(Phase phase, const char* sentence) const {
  need(phase_ == phase, sentence);
}

void Instance::enter_initialization(double start, double stop) {
  require_phase(Phase::instantiated, "initialization begins once, after an instance is made");
  if (!std::isfinite(start) || !(stop >= start)) {
    refuse("the start time must be finite and not beyond the stop time, got " + text(start) +
           " s and " + text(stop) + " s");
  }
  kept_[0] = start;
  stop_ = stop;
  phase_ = Phase::initialization;
}

void Instance::exit_initialization() {
  require_phase(Phase::initialization, "initialization cannot end before it begins");
  VectorXd y(2 * model_.num_coordinates());
  y << segment(Kind::q), segment(Kind::qd);
  const Status status = check_state(model_, y);
  if (status != Status::ok) refuse(std::string("q_start and qd_start: ") + message(status));
  phase_ = Phase::step;
}

void Instance::terminate() {
  require_phase(Phase::step, "only what has been initialized can be terminated");
  phase_ = Phase::terminated;
}

void Instance::reset() {
  kept_ = start_;
  stop_ = infinite;
  phase_ = Phase::instantiated;
  use_gravity();
}

void Instance::step(double t, double h) {
  require_phase(Phase::step, "a step needs an instance that has been initialized");
  const double rounding = 1e-9 * std::max(1.0, std::abs(t));
  if (!(std::abs(t - time()) <= rounding)) {
    refuse("a step begins where the last one ended, at " + text(time()) + " s, not at " + text(t));
  }
  if (!(h > 0.0 && std::isfinite(h))) refuse("a step must be > 0 s and finite, got " + text(h));
  if (t + h > stop_ + rounding) {
    refuse("the step would end at " + text(t + h) + " s, beyond the stop time " + text(stop_));
  }
  const auto input = CommandInput::constant(segment(Kind::command));
  const Trajectory run = simulate(model_, segment(Kind::q), segment(Kind::qd),
                                  Eigen::Vector2d(0.0, h), input, setup_.method, setup_.options);
  if (run.status != Status::ok) {
    throw std::runtime_error("in the step from t = " + text(t) + " s: " + run.message);
  }
  segment(Kind::q) = run.q.row(1).transpose();
  segment(Kind::qd) = run.qd.row(1).transpose();
  kept_[0] = t + h;
}

void Instance::set_one(Variable variable, double value) {
  const auto kind = variable.kind;
  const bool parameter = kind == Kind::gravity || kind == Kind::q_start || kind == Kind::qd_start;
  if (!parameter && kind != Kind::command) refuse("it is neither an input nor a parameter");
  if (parameter && phase_ != Phase::instantiated && phase_ != Phase::initialization) {
    refuse("a parameter is fixed once the initialization has ended");
  }
  if (!std::isfinite(value) || (kind == Kind::command && value < 0.0)) {
    refuse(std::string("it must be ") + (parameter ? "" : ">= 0 and ") + "finite, got " +
           text(value));
  }
  segment(kind)[variable.i] = value;
  if (kind == Kind::q_start) segment(Kind::q)[variable.i] = value;
  if (kind == Kind::qd_start) segment(Kind::qd)[variable.i] = value;
}

void Instance::set(const std::uint32_t* references, std::size_t count, const double* values) {
  const VectorXd before = kept_;
  for (std::size_t k = 0; k < count; ++k) {
    const Variable variable = variables_.find(references[k]);
    try {
      set_one(variable, values[k]);
    } catch (const std::invalid_argument& error) {
      kept_ = before;
      refuse(variables_.name(variable) + " cannot be set: " + error.what());
    }
  }
  use_gravity();
}

void Instance::use_gravity() {
  if (segment(Kind::gravity) == model_.robot().gravity) return;
  model_ = model_.with_gravity(segment(Kind::gravity));
  data_ = Data(model_);
}

VectorXd Instance::computed() {
  const auto q = segment(Kind::q), qd = segment(Kind::qd), command = segment(Kind::command);
  const Index end = variables_.first(Kind::cable_tension) + variables_.count(Kind::cable_tension);
  VectorXd values(end - variables_.kept());
  const auto of = [&](Kind kind) {
    return values.segment(variables_.first(kind) - variables_.kept(), variables_.count(kind));
  };
  forward_dynamics(model_, data_, q, qd, command, of(Kind::acceleration));
  const Pose pose = tip(model_, q);
  of(Kind::tip_position) = pose.p;
  of(Kind::tip_rotation) = pose.R.transpose().reshaped();
  cable_lengths(model_, q, of(Kind::cable_length));
  cable_tensions(model_, q, qd, command, of(Kind::cable_tension));
  return values;
}

void Instance::get(const std::uint32_t* references, std::size_t count, double* values) {
  VectorXd others;
  for (std::size_t k = 0; k < count; ++k) {
    static_cast<void>(variables_.find(references[k]));
    const Index i = references[k];
    const bool is_kept = i < kept_.size();
    if (!is_kept && others.size() == 0) others = computed();
    values[k] = is_kept ? kept_[i] : others[i - kept_.size()];
  }
}

/// By q, qd and commands, of every variable from q on.
MatrixXd Instance::partials() {
  const auto q = segment(Kind::q), qd = segment(Kind::qd), command = segment(Kind::command);
  const Index d = model_.num_coordinates(), m = model_.num_cables();
  const Index end = variables_.first(Kind::cable_tension) + m;
  MatrixXd P = MatrixXd::Zero(end - variables_.first(Kind::q), 2 * d + m);
  const auto of = [&](Kind kind) {
    return P.middleRows(variables_.first(kind) - variables_.first(Kind::q), variables_.count(kind));
  };
  of(Kind::q).leftCols(d).setIdentity();
  of(Kind::qd).middleCols(d, d).setIdentity();

  MatrixXd A(2 * d, 2 * d), B(2 * d, m);
  linearize(model_, data_, q, qd, command, A, B);
  of(Kind::acceleration) << A.bottomRows(d), B.bottomRows(d);

  MatrixXd J(6, d);
  tip_jacobian(model_, q, J);
  of(Kind::tip_position).leftCols(d) = J.topRows(3);
  const Matrix3d R = tip(model_, q).R;
  for (Index k = 0; k < d; ++k) {  // dR = omega x R, by rows
    Matrix3d omega_R = R;
    for (Index c = 0; c < 3; ++c) omega_R.col(c) = Vector3d(J.col(k).tail(3)).cross(R.col(c));
    of(Kind::tip_rotation).col(k) = omega_R.transpose().reshaped();
  }

  MatrixXd actuation(d, m);
  actuation_matrix(model_, q, actuation);
  const MatrixXd length_by_q = -actuation.transpose();
  of(Kind::cable_length).leftCols(d) = length_by_q;
  // By q of the rates of the lengths: how fast length_by_q changes along qd.
  MatrixXd rate_by_q = MatrixXd::Zero(m, d);
  if (!model_.has_constant_actuation()) {
    constexpr double h = 1e-4;
    const double step = h / std::max(1.0, qd.cwiseAbs().maxCoeff());
    MatrixXd before(d, m), after(d, m);
    actuation_matrix(model_, q - step * qd, before);
    actuation_matrix(model_, q + step * qd, after);
    rate_by_q = (before - after).transpose() / (2.0 * step);
  }
  for (Index j = 0; j < m; ++j) {
    auto tension = of(Kind::cable_tension).row(j);
    const Cable& cable = model_.cables()[j];
    if (!cable.length_driven()) {
      tension[2 * d + j] = 1.0;
    } else if (cable_pull(model_, j, q, qd, command[j]) > 0.0) {
      tension.head(d) = cable.stiffness * length_by_q.row(j) + cable.damping * rate_by_q.row(j);
      tension.segment(d, d) = cable.damping * length_by_q.row(j);
      tension[2 * d + j] = -cable.stiffness;
    }
  }
  return P;
}

Index Instance::row(std::uint32_t reference) const {
  const Variable variable = variables_.find(reference);
  const Index i = static_cast<Index>(reference) - variables_.first(Kind::q);
  if (i < 0) refuse(variables_.name(variable) + " is not computed, so it has no derivatives");
  return i;
}

Index Instance::column(std::uint32_t reference) const {
  const auto [kind, i] = variables_.find(reference);
  const Index d = model_.num_coordinates();
  const bool starting = phase_ == Phase::instantiated || phase_ == Phase::initialization;
  if (kind == Kind::q || (kind == Kind::q_start && starting)) return i;
  if (kind == Kind::qd || (kind == Kind::qd_start && starting)) return d + i;
  if (kind == Kind::command) return 2 * d + i;
  refuse("there are no derivatives by " + variables_.name({kind, i}) + " now");
}

void Instance::derivative(const std::uint32_t* unknowns, std::size_t num_unknowns,
                          const std::uint32_t* knowns, std::size_t num_knowns, const double* seed,
                          double* sensitivity, bool adjoint) {
  MatrixXd D(num_unknowns, num_knowns);
  const MatrixXd P = partials();
  for (Index i = 0; i < D.rows(); ++i) {
    for (Index k = 0; k < D.cols(); ++k) D(i, k) = P(row(unknowns[i]), column(knowns[k]));
  }
  if (adjoint) D.transposeInPlace();
  Eigen::Map<VectorXd>(sensitivity, D.rows()) = D * Eigen::Map<const VectorXd>(seed, D.cols());
}

void Instance::output_derivatives(const std::uint32_t* references, std::size_t count,
                                  const int* orders, double* values) {
  VectorXd rate = VectorXd::Zero(2 * model_.num_coordinates() + model_.num_cables());
  rate.head(2 * model_.num_coordinates()) << segment(Kind::qd),
      computed().head(model_.num_coordinates());
  const VectorXd all = partials() * rate;
  for (std::size_t k = 0; k < count; ++k) {
    if (orders[k] != 1) refuse("derivatives of outputs are of order 1, not " + text(orders[k]));
    values[k] = all[row(references[k])];
  }
}

VectorXd Instance::save() const {
  VectorXd saved(saved_size());
  saved << static_cast<double>(phase_), stop_, kept_;
  return saved;
}

void Instance::restore(const VectorXd& saved) {
  const bool fits = saved.size() == saved_size() && saved.tail(kept_.size()).allFinite();
  const double phase = fits ? saved[0] : -1.0;
  if (!(phase >= 0.0 && phase <= static_cast<double>(Phase::terminated))) {
    refuse("the state is not one of this FMU");
  }
  phase_ = static_cast<Phase>(static_cast<int>(phase));
  stop_ = saved[1];
  kept_ = saved.tail(kept_.size());
  use_gravity();
}

}  // namespace cdcr::fmu
