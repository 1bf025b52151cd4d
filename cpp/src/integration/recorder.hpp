#pragma once

#include "cdcr/simulate.hpp"
#include "integration/run_sensitivities.hpp"

namespace cdcr::detail {

/// Fills the rows of a trajectory as a run passes their times, which count from its first.
class Recorder {
 public:
  /// `sensitivities` may be none.
  Recorder(RobotOde& ode, const VectorXd& times, RunSensitivities* sensitivities, Trajectory& out)
      : ode_(ode),
        sensitivities_(sensitivities),
        out_(out),
        times_(times.array() - times[0]),
        y_(ode.num_states()) {
    const Index m = ode.model().num_coordinates();
    out_.t = times;
    out_.q.resize(times.size(), m);
    out_.qd.resize(times.size(), m);
    out_.tension.resize(times.size(), ode.model().num_cables());
    out_.command.resize(times.size(), ode.model().num_cables());
    out_.deflection.resize(times.size(), ode.model().num_deflections());
    tension_.resize(ode.model().num_cables());
    command_.resize(ode.model().num_cables());
    if (sensitivities_ != nullptr) {
      out_.sensitivities.resize(times.size(), sensitivities_->here().size());
    }
  }

  [[nodiscard]] bool done() const { return next_ == times_.size(); }
  [[nodiscard]] double next_time() const { return times_[next_]; }

  /// Records the state at the next output time, which is the one that sensitivities have reached.
  void record(const VectorXd& y) {
    if (sensitivities_ != nullptr) record_sensitivities(sensitivities_->here());
    record_state(y);
  }

  /// Records all output times up to `until`, within the integrator's last step, but for `stop`: at
  /// a jump the tensions after it count, so that row waits for the next stretch to start.
  void record_step(Integrator& integrator, double until, double stop) {
    while (!done() && next_time() <= until && next_time() < stop) {
      if (sensitivities_ != nullptr)
        record_sensitivities(sensitivities_->at(integrator, next_time()));
      if (next_time() == integrator.time()) {
        record_state(integrator.state());
      } else {
        integrator.interpolate(next_time(), y_);
        record_state(y_);
      }
    }
  }

  /// Drops the rows that were not reached.
  void finish() {
    if (done()) return;
    if (sensitivities_ != nullptr) out_.sensitivities.conservativeResize(next_, Eigen::NoChange);
    out_.t.conservativeResize(next_);
    out_.q.conservativeResize(next_, Eigen::NoChange);
    out_.qd.conservativeResize(next_, Eigen::NoChange);
    out_.tension.conservativeResize(next_, Eigen::NoChange);
    out_.command.conservativeResize(next_, Eigen::NoChange);
    out_.deflection.conservativeResize(next_, Eigen::NoChange);
  }

 private:
  void record_state(const VectorXd& y) {
    const Index m = out_.q.cols();
    out_.q.row(next_) = y.head(m).transpose();
    out_.qd.row(next_) = y.segment(m, m).transpose();
    out_.deflection.row(next_) = y.tail(out_.deflection.cols()).transpose();
    ode_.cables(times_[next_], y, command_, tension_);
    out_.tension.row(next_) = tension_.transpose();
    out_.command.row(next_) = command_.transpose();
    ++next_;
  }
  void record_sensitivities(const MatrixXd& S) {
    Eigen::Map<RowMatrixXd>(out_.sensitivities.row(next_).data(), S.rows(), S.cols()) = S;
  }

  RobotOde& ode_;
  RunSensitivities* sensitivities_;
  Trajectory& out_;
  VectorXd times_, y_, tension_, command_;
  Index next_ = 0;
};

}  // namespace cdcr::detail
