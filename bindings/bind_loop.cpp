#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/loop.hpp"
#include "cdcr/loop_log.hpp"
#include "controllers.hpp"
#include "docs.hpp"
#include "driving.hpp"
#include "gil.hpp"
#include "loop_options.hpp"
#include "methods.hpp"

namespace cdcr::python {

using namespace py::literals;

namespace {

LoopOptions read_loop(const py::dict& given) {
  LoopOptions options;
  options.step = given["step"].cast<double>();
  options.substeps = given["substeps"].cast<int>();
  options.method = read_fixed_step(given["method"]);
  options.actuators = read_actuators(given);
  options.sensors = read_sensors(given);
  return options;
}

}  // namespace

/// A loop that keeps model and controller as Python has them.
class PythonLoop final : public Loop {
 public:
  PythonLoop(py::object of, py::object by, const py::dict& options, py::object from)
      : Loop(read_model(of), by.cast<Controller&>(), read_loop(options),
             from.is_none() ? nullptr : from.cast<Estimator*>()),
        model(std::move(of)),
        controlled_by(std::move(by)),
        estimated_by(std::move(from)) {}
  PythonLoop(const PythonLoop&) = delete;
  PythonLoop& operator=(const PythonLoop&) = delete;
  ~PythonLoop() { Driving::forget(controller(), estimator(), this); }

  /// Goes on with the controller, as `asking` does.
  template <class Call>
  auto going_on(Call&& call) {
    if (status() != Status::not_started) Driving::require_last(controller(), estimator(), this);
    return asking(std::forward<Call>(call));
  }

  /// Calls what asks the controller, which may be one written in Python, whose exceptions it
  /// throws.
  template <class Call>
  auto asking(Call&& call) {
    const Driving driving(controller(), this, estimator());
    const auto unlocked = [&] {
      const Unlocked here;
      return call();
    };
    auto* const written_in_python = dynamic_cast<PythonController*>(&controller());
    auto answer = unlocked();
    if (written_in_python != nullptr) written_in_python->rethrow();
    return answer;
  }

  void open_log(const std::string& path, Index capacity) {
    if (writer_) throw std::invalid_argument("the loop writes a log already: close that first");
    log_ = std::make_unique<LoopLog>(*this, capacity);
    writer_ = std::make_unique<LogWriter>(*log_, path);
    set_log(log_.get());
  }
  /// Rows that found no room.
  [[nodiscard]] long dropped() const { return log_ ? log_->dropped() : 0; }
  void close_log() {
    set_log(nullptr);
    const std::unique_ptr<LogWriter> writer = std::move(writer_);
    const Unlocked here;
    if (writer) writer->close();
  }

  py::object model, controlled_by, estimated_by;

 private:
  std::unique_ptr<LoopLog> log_;
  std::unique_ptr<LogWriter> writer_;
};

namespace {

py::dict sampled(PythonLoop& self, double duration, Index record_every,
                 const py::object& wrenches) {
  const Wrenches loads = read_wrenches(self.plant().model(), wrenches);
  Interruption interruption;
  const LoopRun found = self.going_on(
      [&] { return run(self, duration, record_every, loads, [&] { return interruption(); }); });
  interruption.raise();
  py::list told;
  for (const RowMatrixXd& rows : found.told) told.append(to_rows(rows));
  return py::dict(
      "t"_a = to_array(found.t), "q"_a = to_rows(found.q), "qd"_a = to_rows(found.qd),
      "tension"_a = to_rows(found.tension), "command"_a = to_rows(found.command),
      "asked"_a = to_rows(found.asked), "reference"_a = to_rows(found.reference),
      "reference_names"_a = self.controller().reference_names(), "told_q"_a = to_rows(found.told_q),
      "told_qd"_a = to_rows(found.told_qd), "told"_a = told,
      "durations"_a = to_array(found.durations), "estimated"_a = to_rows(found.estimated),
      "deviations"_a = to_rows(found.deviations), "innovation"_a = to_array(found.innovation),
      "measured"_a = to_array(found.measured), "status"_a = found.status,
      "message"_a = found.message, "method"_a = fixed_step_name(self.options().method),
      "stats"_a = found.stats);
}

}  // namespace

void bind_loop(py::module_& m) {
  py::class_<PythonLoop>(m, "Loop", "A closed loop; see cdcr.Loop.")
      .def(py::init<py::object, py::object, py::dict, py::object>(), "model"_a, "controller"_a,
           "options"_a, "estimator"_a = py::none(),
           Doc("Make a loop, which has no state until `reset`.",
               {docs::model, "controller : Controller\n    Asked once each period.\n",
                "options : dict\n    What the class in Python takes by keyword, all of it.\n",
                "estimator : Estimator, optional\n    Makes a state of what sensors tell.\n"},
               "", docs::bad_argument))
      .def(
          "reset",
          [](PythonLoop& self, const py::object& q, const py::object& qd, double time,
             const py::object& command) {
            const Model& model = self.plant().model();
            const VectorXd q0 = *read_bending(model, q, "q");
            const VectorXd qd0 =
                *VectorArgument(qd, "qd", model.num_coordinates(), of_coordinates(model));
            const VectorXd first = *read_tension(model, command, "command");
            (void)self.asking([&] {
              self.reset(q0, qd0, time, first);
              return true;
            });
          },
          "q"_a, "qd"_a, "time"_a = 0.0, "command"_a = py::none(),
          Doc("Set state and time, put actuators and sensors at rest, reset the controller.",
              {docs::one_q, docs::one_qd, "time : float, default 0\n    The time [s].\n",
               "command : (num_cables,) array_like, optional\n    What actuators give there [N], "
               "[m]; by default what leaves the straight robot alone.\n"},
              "", docs::bad_argument))
      .def(
          "step",
          [](PythonLoop& self, const py::object& wrenches) {
            const Wrenches loads = read_wrenches(self.plant().model(), wrenches);
            Interruption interruption;
            const Status status =
                self.going_on([&] { return self.step(loads, [&] { return interruption(); }); });
            interruption.raise();
            return status;
          },
          "wrenches"_a = py::tuple(),
          Doc("Advance one step of the plant.", {docs::wrenches},
              "Status\n    ``ok``, or why the state is still the one before.", docs::bad_argument))
      .def("_sampled", &sampled, "duration"_a, "record_every"_a, "wrenches"_a,
           Doc("Steps over a duration; see cdcr.Loop.run.",
               {"duration : float\n    A whole number of steps [s].\n",
                "record_every : int\n    Steps between samples [1].\n", docs::wrenches},
               "dict\n    Arrays of samples by name.", docs::bad_argument))
      .def("_open_log", &PythonLoop::open_log, "path"_a, "capacity"_a,
           Doc("Begin a log of further steps; see cdcr.LoopLog.",
               {"path : str\n    Its file.\n", "capacity : int\n    Rows on their way [1].\n"}, "",
               docs::bad_argument))
      .def("_close_log", &PythonLoop::close_log, "End the log, if there is one.")
      .def("_dropped", &PythonLoop::dropped, "Rows that the last log had no room for [1].")
      .def_readonly("model", &PythonLoop::model, "The robot.")
      .def_readonly("controller", &PythonLoop::controlled_by, "What controls it.")
      .def_readonly("estimator", &PythonLoop::estimated_by, "What estimates its state, or None.")
      .def_property_readonly(
          "q", [](const PythonLoop& self) { return to_array(self.q()); },
          "Coordinates (d,) at the time reached [rad].")
      .def_property_readonly(
          "qd", [](const PythonLoop& self) { return to_array(self.qd()); },
          "Their rates (d,) at the time reached [rad/s].")
      .def_property_readonly(
          "asked", [](const PythonLoop& self) { return to_array(self.asked()); },
          "What the controller last asked for (num_cables,) [N], [m].")
      .def_property_readonly(
          "given", [](const PythonLoop& self) { return to_array(self.given()); },
          "What the cables got in the last step (num_cables,) [N], [m].")
      .def_property_readonly(
          "told_q", [](const PythonLoop& self) { return to_array(self.told_q()); },
          "Bending vectors that the controller is told (d,) [rad].")
      .def_property_readonly(
          "told_qd", [](const PythonLoop& self) { return to_array(self.told_qd()); },
          "Rates that the controller is told (d,) [rad/s].")
      .def_property_readonly(
          "measurements",
          [](const PythonLoop& self) {
            py::list found;
            for (const SensorChannel& one : self.sensors()) found.append(to_array(one.value()));
            return found;
          },
          "What each sensor tells, a list of arrays (m,) [of its kind].")
      .def_property_readonly(
          "time", [](const PythonLoop& self) { return self.time(); },
          "Time reached [s], after whole periods.")
      .def_property_readonly(
          "status", [](const PythonLoop& self) { return self.status(); },
          "How the last step ended.");
}

}  // namespace cdcr::python
