#include "cdcr/cvode.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/arguments.hpp"
#include "dynamics/bending.hpp"
#include "integration/half_newton.hpp"
#include "integration/small_vector.hpp"
#include "integration/step_size.hpp"
#include "integration/streak.hpp"
#include "integration/sundials_handles.hpp"
#include "integration/sundials_spare.hpp"

namespace cdcr {
namespace {

using detail::Owner;
using detail::Streak;

/// For calls that fail only when this file is wrong or memory has run out.
void require(int flag, const char* call) {
  if (flag == CV_SUCCESS) return;
  if (flag == CV_MEM_FAIL) throw std::bad_alloc();
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

Owner<SUNMatrix> make_matrix(Index size, SUNContext context) {
  const auto n = static_cast<sunindextype>(size);
  return own(SUNDenseMatrix(n, n, context));
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

 private:
  // What CVODE calls: 0 means done, 1 try a smaller step, -1 give up.
  static int derivative(double t, N_Vector y, N_Vector dydt, void* self) noexcept;
  static int jacobian(double t, N_Vector y, N_Vector dydt, SUNMatrix J, void* self, N_Vector,
                      N_Vector, N_Vector) noexcept;
  static int weights(N_Vector y, N_Vector weight, void* self) noexcept;
  template <typename Function>
  int guarded(Function function) noexcept;

  Status begin(double t, const VectorXd& y, double t_stop);
  void reinitialise(double share = 1.0);
  Status evaluate(double t, const double* y, VectorRef slope);
  double first_step();
  Status advance();
  Status attempt();

  RobotOde& ode_;
  Tolerances tolerances_;
  Owner<SUNContext> context_;
  Owner<N_Vector> trial_, between_;  // the end of a step, a point within it
  Owner<SUNMatrix> matrix_;
  detail::Spare spare_;
  detail::HalfNewton newton_;
  Owner<SUNLinearSolver> linear_solver_;
  Owner<void*> cvode_;

  double time_ = 0.0, stop_ = 0.0;
  VectorXd state_, slope_, moved_, slope_there_;
  Status status_ = Status::not_started;
  Streak limit_hits_, restarts_;    // steps that the bending limit blocked; new starts
  Status rhs_status_ = Status::ok;  // why a derivative wanted for the step at hand does not exist
  std::exception_ptr exception_;    // thrown during a call of CVODE
  Stats stats_;  // without the failures that CVODE has counted since the last restart
};

// Newton's method serves adams too. Against fixed-point iteration it takes a fifth more time on
// the undamped robot at rtol 1e-8 and as much at 1e-11; but at a damping of 0.1 N m s/rad
// fixed-point iteration needs three times as many steps, and at 10 sixty times as many.
Cvode::Cvode(RobotOde& ode, Method method, const Options& options)
    : ode_(ode),
      tolerances_(options, method),
      context_(make_context()),
      trial_(make_vector(ode.num_states(), context_.get())),
      between_(make_vector(ode.num_states(), context_.get())),
      matrix_(make_matrix(ode.num_states(), context_.get())),
      spare_(make_vector(ode.num_states(), context_.get()),
             make_matrix(ode.num_states(), context_.get())),
      newton_(ode.num_states(), ode.model().num_coordinates()),
      linear_solver_(own(newton_.make(context_.get()))),
      cvode_(own(CVodeCreate(method == Method::bdf ? CV_BDF : CV_ADAMS, context_.get()))),
      state_(VectorXd::Zero(ode.num_states())),
      slope_(state_),
      moved_(state_),
      slope_there_(state_) {
  void* const cvode = cvode_.get();
  const detail::Spare::Use spare(spare_);
  detail::Spare::serve(trial_.get(), matrix_.get());
  require(detail::silence(context_.get(), cvode), "silence");
  require(CVodeSetUserData(cvode, this), "CVodeSetUserData");
  if (CVodeInit(cvode, derivative, time_, trial_.get()) != CV_SUCCESS) {
    // It has freed its vectors, and would free them again.
    [[maybe_unused]] void* const left = cvode_.release();
    throw std::bad_alloc();
  }
  require(CVodeWFtolerances(cvode, weights), "CVodeWFtolerances");
  require(CVodeSetLinearSolver(cvode, linear_solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
  require(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
  require(CVodeSetMaxStep(cvode, options.max_step), "CVodeSetMaxStep");
  require(CVodeSetMaxHnilWarns(cvode, -1), "CVodeSetMaxHnilWarns");
  if (spare_.used()) throw std::bad_alloc();
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

int Cvode::weights(N_Vector y, N_Vector weight, void* self) noexcept {
  const Tolerances& of = static_cast<Cvode*>(self)->tolerances_;
  for (sunindextype i = 0; i < NV_LENGTH_S(y); ++i) {
    NV_Ith_S(weight, i) = 1.0 / (of.atol + of.rtol * std::abs(NV_Ith_S(y, i)));
  }
  return 0;
}

Status Cvode::restart(double t, const VectorXd& y, double t_stop) {
  ode_.require_stretch(t, y, t_stop);
  status_ = Status::not_started;  // also if the tension function throws
  if (limit_hits_.too_long()) limit_hits_ = {};
  if (restarts_.too_long()) restarts_ = {};
  return status_ = begin(t, y, t_stop);
}

Status Cvode::begin(double t, const VectorXd& y, double t_stop) {
  time_ = t;
  stop_ = t_stop;
  state_ = y;
  const Status status = evaluate(time_, state_.data(), slope_);
  if (status != Status::ok) return status;
  reinitialise();
  return Status::ok;
}

/// Starts from state_, whose slope is slope_, and forgets what came before; with a share of the
/// first step that would be right if all were smooth.
void Cvode::reinitialise(double share) {
  void* const cvode = cvode_.get();
  const double h = std::max(share * first_step(), detail::time_resolution(time_, stop_));
  stats_ = stats();  // CVodeReInit sets CVODE's counts to zero
  view(trial_) = state_;
  require(CVodeReInit(cvode, time_, trial_.get()), "CVodeReInit");
  require(CVodeSetInitStep(cvode, h), "CVodeSetInitStep");
  require(CVodeSetStopTime(cvode, stop_), "CVodeSetStopTime");
}

/// y' at (t, y), which the tension function gets to see only where the model holds.
Status Cvode::evaluate(double t, const double* y, VectorRef slope) {
  const Status status = ode_.check(y);
  if (status != Status::ok) return status;
  ++stats_.evaluations;
  ode_.derivative(t, y, slope.data());
  return slope.allFinite() ? Status::ok : Status::non_finite_state;
}

/// First step h, of order 1, with an error h^2 |y''|/2 of a quarter of the tolerance.
///
/// y'' is the difference of the slopes over a small Euler step h0 (after Hairer, Norsett, Wanner,
/// "Solving Ordinary Differential Equations I", section II.4), which also bounds h where y'' is
/// zero, as it is at rest. CVODE's own estimate would depend on the stop time.
double Cvode::first_step() {
  const auto norm = [this](const VectorXd& v) {
    return detail::weighted_norm(v, state_, tolerances_.rtol, tolerances_.atol);
  };
  const double d0 = norm(state_), d1 = norm(slope_);
  const double wanted = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
  const double h0 =
      std::min(std::max(wanted, detail::time_resolution(time_, stop_)), stop_ - time_);
  moved_ = state_ + h0 * slope_;
  if (evaluate(time_ + h0, moved_.data(), slope_there_) != Status::ok) return h0;
  moved_ = (slope_there_ - slope_) / h0;
  const double h = std::min(std::sqrt(0.5 / norm(moved_)), 100.0 * h0);
  return std::max(h, detail::time_resolution(time_, stop_));
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

/// Where CVODE gives a step up, a new start with small steps of order 1 passes most of what no
/// step of the method passes: a jump of the commands, a kink of friction. Each that comes no
/// further is followed by a tenth of its step.
Status Cvode::advance() {
  for (double share = 1.0;; share *= 0.1) {
    const Status status = attempt();
    const bool may_pass = status == Status::step_too_small || status == Status::tolerance_not_met;
    if (!may_pass || exception_) return status;
    if (restarts_.too_long()) return detail::is_shape_limit(rhs_status_) ? rhs_status_ : status;
    restarts_.happens();
    const Status at_start = evaluate(time_, state_.data(), slope_);
    if (at_start != Status::ok) return at_start;
    reinitialise(share);
  }
}

Status Cvode::attempt() {
  double t = time_;
  rhs_status_ = Status::ok;
  const auto too_small = [this] {  // with the cause, where it is known
    return rhs_status_ == Status::ok ? Status::step_too_small : rhs_status_;
  };
  const detail::Spare::Use spare(spare_);
  const int flag = CVode(cvode_.get(), stop_, trial_.get(), &t, CV_ONE_STEP);
  if (spare_.used()) throw std::bad_alloc();  // in the first step
  switch (flag) {
    case CV_SUCCESS:
    case CV_TSTOP_RETURN:
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
  restarts_.step();
  // Against the bending limit CVODE cuts its step, grows it and cuts it again, ever nearer to the
  // limit and never there.
  if (detail::is_shape_limit(rhs_status_)) limit_hits_.happens();
  limit_hits_.step();
  return limit_hits_.too_long() ? rhs_status_ : Status::ok;
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
  validate(options);
  if (method == Method::automatic) {
    return make_automatic_integrator(ode, options, make_cvode_integrator);
  }
  if (method != Method::bdf && method != Method::adams) {
    return make_integrator(ode, method, options);
  }
  return std::make_unique<Cvode>(ode, method, options);
}

}  // namespace cdcr
