#include "cdcr/cvode.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/arguments.hpp"
#include "integration/small_vector.hpp"
#include "integration/sundials_handles.hpp"

namespace cdcr {
namespace {

using detail::Owner;

/// For calls that fail only when this file is wrong or memory has run out.
void require(int flag, const char* call) {
  if (flag == CV_SUCCESS) return;
  throw std::runtime_error(std::string(call) + " failed with code " + std::to_string(flag));
}

template <typename Handle>
Owner<Handle> own(Handle handle) {
  if (handle == nullptr) throw std::bad_alloc();
  return Owner<Handle>(handle);
}

Owner<SUNContext> make_context() {
  SUNContext context = nullptr;
  require(detail::create(&context), "SUNContext_Create");
  return own(context);
}

Owner<N_Vector> make_vector(Index size, SUNContext context) {
  Owner<N_Vector> vector = own(N_VNew_Serial(static_cast<sunindextype>(size), context));
  detail::use_small_operations(vector.get());
  N_VConst(0.0, vector.get());
  return vector;
}

Eigen::Map<VectorXd> view(const Owner<N_Vector>& v) {
  return {NV_DATA_S(v.get()), NV_LENGTH_S(v.get())};
}

/// BDF or Adams steps by CVODE. Its memory holds the address of this object, which stays put.
class Cvode final : public Integrator {
 public:
  Cvode(RobotOde& ode, Method method, const Options& options);
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;
  ~Cvode() override = default;

  Status restart(double t, const VectorXd& y, double t_stop) override;
  Status step() override;
  void interpolate(double t, VectorXd& y) override;
  [[nodiscard]] double time() const noexcept override { return time_; }
  [[nodiscard]] const VectorXd& state() const noexcept override { return state_; }
  [[nodiscard]] Stats stats() const noexcept override;
  [[nodiscard]] std::vector<SlackEvent> slack_events() const override { return slack_events_; }

 private:
  // What CVODE calls: 0 means done, 1 try a smaller step, -1 give up.
  static int derivative(double t, N_Vector y, N_Vector dydt, void* self) noexcept;
  static int jacobian(double t, N_Vector y, N_Vector dydt, SUNMatrix J, void* self, N_Vector,
                      N_Vector, N_Vector) noexcept;
  static int pulls(double t, N_Vector y, double* pull, void* self) noexcept;
  template <typename Function>
  int guarded(Function function) noexcept;

  Status begin(double t, const VectorXd& y, double t_stop);
  void reinitialise();
  void note_slack();
  void note_jump();
  Status evaluate(double t, const double* y, VectorRef slope);
  [[nodiscard]] double norm(const VectorXd& v) const noexcept;
  double first_step();
  Status advance();

  RobotOde& ode_;
  Options options_;
  Owner<SUNContext> context_;
  Owner<N_Vector> trial_, between_;  // the end of a step, a point within it
  Owner<SUNMatrix> matrix_;
  Owner<SUNLinearSolver> linear_solver_;
  Owner<void*> cvode_;

  double time_ = 0.0, stop_ = 0.0;
  VectorXd state_, slope_, moved_, slope_there_;
  Status status_ = Status::not_started;
  bool at_event_ = false;   // the last step ended where a cable turned slack or taut
  VectorXd pulls_, signs_;  // of length-driven cables; the signs at the last event or restart
  std::vector<SlackEvent> slack_events_;
  Status rhs_status_ = Status::ok;  // why a derivative wanted for the step at hand does not exist
  std::exception_ptr exception_;    // thrown during a call of CVODE
  Stats stats_;  // without the failures that CVODE has counted since the last restart
};

// Newton's method serves adams too. Against fixed-point iteration it takes a fifth more time on
// the undamped robot at rtol 1e-8 and as much at 1e-11; but at a damping of 0.1 N m s/rad
// fixed-point iteration needs three times as many steps, and at 10 sixty times as many.
Cvode::Cvode(RobotOde& ode, Method method, const Options& options)
    : ode_(ode),
      options_(options),
      context_(make_context()),
      trial_(make_vector(ode.num_states(), context_.get())),
      between_(make_vector(ode.num_states(), context_.get())),
      matrix_(own(
          SUNDenseMatrix(NV_LENGTH_S(trial_.get()), NV_LENGTH_S(trial_.get()), context_.get()))),
      linear_solver_(own(SUNLinSol_Dense(trial_.get(), matrix_.get(), context_.get()))),
      cvode_(own(CVodeCreate(method == Method::bdf ? CV_BDF : CV_ADAMS, context_.get()))),
      state_(VectorXd::Zero(ode.num_states())),
      slope_(state_),
      moved_(state_),
      slope_there_(state_),
      pulls_(VectorXd::Zero(static_cast<Index>(ode.length_driven().size()))),
      signs_(pulls_) {
  void* const cvode = cvode_.get();
  require(detail::silence(context_.get(), cvode), "silence");
  require(CVodeSetUserData(cvode, this), "CVodeSetUserData");
  require(CVodeInit(cvode, derivative, time_, trial_.get()), "CVodeInit");
  require(CVodeSStolerances(cvode, options.rtol, options.atol), "CVodeSStolerances");
  require(CVodeSetLinearSolver(cvode, linear_solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
  require(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
  require(CVodeSetMaxStep(cvode, options.max_step), "CVodeSetMaxStep");
  require(CVodeSetMaxHnilWarns(cvode, -1), "CVodeSetMaxHnilWarns");
  const auto num_events = static_cast<int>(ode.length_driven().size());
  if (num_events == 0) return;
  require(CVodeRootInit(cvode, num_events, pulls), "CVodeRootInit");
  require(CVodeSetNoInactiveRootWarn(cvode), "CVodeSetNoInactiveRootWarn");
}

/// Keeps exceptions out of CVODE, which is C and could not pass them on.
template <typename Function>
int Cvode::guarded(Function function) noexcept {
  try {
    return function() ? 0 : 1;
  } catch (...) {
    exception_ = std::current_exception();
    return -1;
  }
}

int Cvode::derivative(double t, N_Vector y, N_Vector dydt, void* self) noexcept {
  Cvode& me = *static_cast<Cvode*>(self);
  return me.guarded([&] {
    Eigen::Map<VectorXd> slope(NV_DATA_S(dydt), NV_LENGTH_S(dydt));
    const Status status = me.evaluate(t, NV_DATA_S(y), slope);
    if (status != Status::ok) me.rhs_status_ = status;
    return status == Status::ok;
  });
}

int Cvode::jacobian(double t, N_Vector y, N_Vector /*dydt*/, SUNMatrix J, void* self, N_Vector,
                    N_Vector, N_Vector) noexcept {
  Cvode& me = *static_cast<Cvode*>(self);
  return me.guarded([&] {
    ++me.stats_.jacobians;
    me.ode_.jacobian(t, NV_DATA_S(y), SM_DATA_D(J));
    return Eigen::Map<const VectorXd>(SM_DATA_D(J), SM_LDATA_D(J)).allFinite();
  });
}

int Cvode::pulls(double t, N_Vector y, double* pull, void* self) noexcept {
  Cvode& me = *static_cast<Cvode*>(self);
  return me.guarded([&] {
    me.ode_.pulls(t, NV_DATA_S(y), pull);
    return true;
  });
}

Status Cvode::restart(double t, const VectorXd& y, double t_stop) {
  if (y.size() != state_.size() || !(t_stop > t)) {
    detail::refuse("restart takes ", state_.size(), " states and t_stop > t, got ", y.size(),
                   " states, t = ", t, " s and t_stop = ", t_stop, " s");
  }
  status_ = Status::not_started;  // also if the tension function throws
  return status_ = begin(t, y, t_stop);
}

Status Cvode::begin(double t, const VectorXd& y, double t_stop) {
  time_ = t;
  stop_ = t_stop;
  state_ = y;
  const Status status = evaluate(time_, state_.data(), slope_);
  if (status != Status::ok) return status;
  if (pulls_.size() > 0) note_jump();
  reinitialise();
  return Status::ok;
}

/// Starts from state_, whose slope is slope_, and forgets what came before.
void Cvode::reinitialise() {
  void* const cvode = cvode_.get();
  const double h = first_step();
  stats_ = stats();  // CVodeReInit sets CVODE's counts to zero
  view(trial_) = state_;
  require(CVodeReInit(cvode, time_, trial_.get()), "CVodeReInit");
  require(CVodeSetInitStep(cvode, h), "CVodeSetInitStep");
  require(CVodeSetStopTime(cvode, stop_), "CVodeSetStopTime");
  at_event_ = false;
}

/// y' at (t, y), which the tension function gets to see only where the model holds.
Status Cvode::evaluate(double t, const double* y, VectorRef slope) {
  const Status status = ode_.check(y);
  if (status != Status::ok) return status;
  ++stats_.evaluations;
  ode_.derivative(t, y, slope.data());
  return slope.allFinite() ? Status::ok : Status::non_finite_state;
}

/// Root mean square in units of the tolerances at the present state.
double Cvode::norm(const VectorXd& v) const noexcept {
  double sum = 0.0;
  for (Index i = 0; i < v.size(); ++i) {
    const double scaled = v[i] / (options_.atol + options_.rtol * std::abs(state_[i]));
    sum += scaled * scaled;
  }
  return std::sqrt(sum / static_cast<double>(v.size()));
}

/// First step h, of order 1, with an error h^2 |y''|/2 of a quarter of the tolerance.
///
/// y'' is the difference of the slopes over a small Euler step h0 (after Hairer, Norsett, Wanner,
/// "Solving Ordinary Differential Equations I", section II.4), which also bounds h where y'' is
/// zero, as it is at rest. CVODE's own estimate would depend on the stop time.
double Cvode::first_step() {
  const double d0 = norm(state_), d1 = norm(slope_);
  const double wanted = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
  const double resolution =
      4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(time_), std::abs(stop_));
  const double h0 = std::min(std::max(wanted, resolution), stop_ - time_);
  moved_ = state_ + h0 * slope_;
  if (evaluate(time_ + h0, moved_.data(), slope_there_) != Status::ok) return h0;
  moved_ = (slope_there_ - slope_) / h0;
  const double h = std::min(std::sqrt(0.5 / norm(moved_)), 100.0 * h0);
  return std::max(h, resolution);
}

Status Cvode::step() {
  if (status_ != Status::ok) return status_;
  status_ = advance();
  if (exception_) {
    status_ = Status::interrupted;
    std::rethrow_exception(std::exchange(exception_, nullptr));
  }
  return status_;
}

Status Cvode::advance() {
  double t = time_;
  rhs_status_ = Status::ok;
  if (at_event_) {
    // Tensions bend there, so what the method remembers would mislead it.
    const Status status = evaluate(time_, state_.data(), slope_);
    if (status != Status::ok) return status;
    reinitialise();
  }
  const auto too_small = [this] {  // with the cause, where it is known
    return rhs_status_ == Status::ok ? Status::step_too_small : rhs_status_;
  };
  switch (CVode(cvode_.get(), stop_, trial_.get(), &t, CV_ONE_STEP)) {
    case CV_SUCCESS:
    case CV_TSTOP_RETURN:
      break;
    case CV_ROOT_RETURN:
      at_event_ = true;
      break;
    case CV_ERR_FAILURE:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
      return too_small();
    default:
      return Status::tolerance_not_met;
  }
  if (!(t > time_)) return too_small();
  const Status status = ode_.check(NV_DATA_S(trial_.get()));
  if (status != Status::ok) return status;
  state_ = view(trial_);
  time_ = t;
  ++stats_.steps;
  if (at_event_) note_slack();
  return Status::ok;
}

void Cvode::note_slack() {
  const auto& cables = ode_.length_driven();
  std::vector<int> found(cables.size());
  require(CVodeGetRootInfo(cvode_.get(), found.data()), "CVodeGetRootInfo");
  for (std::size_t i = 0; i < cables.size(); ++i) {
    if (found[i] == 0) continue;
    slack_events_.push_back({time_, cables[i], found[i] < 0});
    signs_[static_cast<Index>(i)] = found[i];
  }
}

/// Cables that turn slack or taut because their command jumps; a pull of zero has not turned yet.
void Cvode::note_jump() {
  const auto& cables = ode_.length_driven();
  ode_.pulls(time_, state_.data(), pulls_.data());
  for (std::size_t i = 0; i < cables.size(); ++i) {
    const double pull = pulls_[static_cast<Index>(i)];
    double& sign = signs_[static_cast<Index>(i)];
    if (pull * sign < 0.0) slack_events_.push_back({time_, cables[i], pull < 0.0});
    if (pull != 0.0) sign = pull > 0.0 ? 1.0 : -1.0;
  }
}

void Cvode::interpolate(double t, VectorXd& y) {
  if (t == time_) {
    y = state_;
  } else if (CVodeGetDky(cvode_.get(), t, 0, between_.get()) == CV_SUCCESS) {
    y = view(between_);
  } else {
    detail::refuse("interpolate takes a time within the last step, which ends at ", time_,
                   " s, got t = ", t, " s");
  }
}

Stats Cvode::stats() const noexcept {
  Stats all = stats_;
  long rejected = 0, newton_failures = 0;
  CVodeGetNumErrTestFails(cvode_.get(), &rejected);
  CVodeGetNumNonlinSolvConvFails(cvode_.get(), &newton_failures);
  all.rejected += rejected;
  all.newton_failures += newton_failures;
  return all;
}

}  // namespace

std::unique_ptr<Integrator> make_cvode_integrator(RobotOde& ode, Method method,
                                                  const Options& options) {
  if (method != Method::bdf && method != Method::adams) {
    return make_integrator(ode, method, options);
  }
  validate(options);
  return std::make_unique<Cvode>(ode, method, options);
}

}  // namespace cdcr
