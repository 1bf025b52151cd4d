#include <cmath>
#include <memory>
#include <sstream>
#include <string>

#include "cdcr/computed_torque.hpp"
#include "cdcr/pid.hpp"
#include "cdcr/state_feedback.hpp"
#include "cdcr/task_space.hpp"
#include "docs.hpp"
#include "driving.hpp"
#include "pickling.hpp"
#include "tracking.hpp"

namespace cdcr::python {

using namespace py::literals;

Gain read_gain(const py::dict& options, const char* name) {
  const py::object given = options[name];
  const auto dimensions = py::array::ensure(given).ndim();
  if (dimensions == 0) return given.cast<double>();
  if (dimensions == 1) return *VectorArgument(given, name, any_size);
  const Array rows = read_array(given, name, {any_size, any_size});
  return Eigen::Map<const RowMatrixXd>(rows.data(), rows.shape(0), rows.shape(1));
}

VectorXd read_vector(const py::dict& options, const char* name, Index size, Entries entries) {
  const py::object given = options[name];
  return given.is_none() ? VectorXd() : VectorXd(*VectorArgument(given, name, size, entries));
}

CommandLimits read_limits(const Model& model, const py::dict& options) {
  CommandLimits limits;
  limits.tension.min_tension = read_option<double>(options, "min_tension");
  limits.tension.max_tension = read_option<double>(options, "max_tension");
  limits.tension.cables = read_option<std::vector<Index>>(options, "cables");
  limits.tension.pretension = read_vector(options, "pretension", model.num_cables(), of_cables);
  limits.max_rate = read_option<double>(options, "max_rate");
  return limits;
}

namespace {

PidOptions read_pid(const Model& model, const py::dict& given) {
  PidOptions options;
  options.kp = read_gain(given, "kp");
  options.ki = read_gain(given, "ki");
  options.kd = read_gain(given, "kd");
  options.period = read_option<double>(given, "period");
  options.feed_forward = read_option<bool>(given, "feed_forward");
  options.anti_windup = read_option<bool>(given, "anti_windup");
  options.filter = read_option<double>(given, "filter");
  const CommandLimits limits = read_limits(model, given);
  options.limits = limits.tension;
  options.max_rate = limits.max_rate;
  return options;
}

ComputedTorqueOptions read_torque(const Model& model, const py::dict& given) {
  ComputedTorqueOptions options;
  options.kp = read_gain(given, "kp");
  options.kd = read_gain(given, "kd");
  options.period = read_option<double>(given, "period");
  if (!given["lead"].is_none()) options.lead = read_option<double>(given, "lead");
  options.delay = read_option<double>(given, "delay");
  options.limits = read_limits(model, given);
  return options;
}

StateFeedbackOptions read_feedback(const Model& model, const py::dict& given) {
  StateFeedbackOptions options;
  const Array gain =
      read_array(given["gain"], "gain", {model.num_cables(), 2 * model.num_coordinates()});
  options.gain = Eigen::Map<const RowMatrixXd>(gain.data(), gain.shape(0), gain.shape(1));
  options.command = read_vector(given, "command", model.num_cables(), of_cables);
  options.period = read_option<double>(given, "period");
  options.limits = read_limits(model, given);
  return options;
}

TaskSpaceOptions read_task(const Model& model, const py::dict& given) {
  TaskSpaceOptions options;
  options.kp = read_gain(given, "kp");
  options.kd = read_gain(given, "kd");
  options.posture_kp = read_option<double>(given, "posture_kp");
  options.posture_kd = read_option<double>(given, "posture_kd");
  options.posture = read_vector(given, "posture", model.num_coordinates(), of_coordinates(model));
  options.damping = read_option<double>(given, "damping");
  options.orientation_weight = read_vector(given, "orientation_weight", any_size, {});
  options.period = read_option<double>(given, "period");
  if (!given["lead"].is_none()) options.lead = read_option<double>(given, "lead");
  options.delay = read_option<double>(given, "delay");
  options.limits = read_limits(model, given);
  return options;
}

template <class Law, class Read>
py::class_<Tracking<Law>, TrackingController> bind_law(py::module_& m, const char* name,
                                                       const char* about, Read read) {
  py::class_<Tracking<Law>, TrackingController> law(m, name, about);
  const auto make = [read](const py::object& model, const py::dict& options) {
    return new Tracking<Law>(model, options, read(read_model(model), options));
  };
  law.def(py::init(make), "model"_a, "options"_a,
          Doc("Make a controller whose reference is the shape at rest.",
              {"model : Model\n    The robot that it reckons with.\n",
               "options : dict\n    What the class in Python takes by keyword, all of it.\n"},
              "", docs::bad_argument))
      .def_readonly("model", &Tracking<Law>::model, "The robot that it reckons with.")
      .def_readonly("options", &Tracking<Law>::options, "What it was made of, by name, in a dict.");
  make_picklable(
      law,
      [](const Tracking<Law>& self) {
        return py::make_tuple(self.model, self.options, take_path(self.path()),
                              to_array(self.memory()));
      },
      [make](const py::tuple& state) {
        std::unique_ptr<Tracking<Law>> made(make(state[0], state[1].cast<py::dict>()));
        made->set_path(put_path(state[2].cast<py::tuple>()));
        made->set_memory(to_vector(state[3]));
        return made.release();
      });
  return law;
}

py::dict diagnostics(const TrackingController& self) {
  const ControlDiagnostics found = self.diagnostics();
  return py::dict("updates"_a = found.updates, "duration"_a = found.duration,
                  "error"_a = found.error, "missing"_a = found.missing,
                  "limited"_a = found.limited);
}

void bind_tracking_controller(py::module_& m) {
  py::class_<TrackingController, Controller>(
      m, "TrackingController", "A controller with a model that follows a reference within limits.")
      .def_property(
          "reference",
          [](const TrackingController& self) { return to_array(self.setpoint().value); },
          [](TrackingController& self, const py::object& value) {
            Driving::refuse_during_run(self);
            const Index size = self.path().size();
            const bool of_tip = self.follows() != TrackingController::Follows::coordinates;
            self.set_reference(
                *VectorArgument(value, "reference", size,
                                of_tip ? Entries{} : of_coordinates(*self.reckons_with())));
          },
          "What to reach and hold: coordinates (d,) [rad], the position of the tip (3,) [m], or "
          "its "
          "pose\n(6,) [m], [rad]; at rest until set.")
      .def_property(
          "path", [](const TrackingController& self) { return self.path(); },
          [](TrackingController& self, const py::object& path) {
            if (!py::isinstance<ReferencePath>(path)) {
              throw py::type_error("path must be a cdcr.ReferencePath, got " +
                                   py::type::of(path).attr("__name__").cast<std::string>());
            }
            Driving::refuse_during_run(self);
            self.set_path(path.cast<const ReferencePath&>());
          },
          "The motion to follow, a ReferencePath; `reference` is where it is now.")
      .def_property_readonly(
          "diagnostics", &diagnostics,
          "Numbers about the last update, a dict: `updates` since the reset, the `duration` of "
          "the\n"
          "last [s], the norm of its `error` [rad], [m], that of the force `missing` for the "
          "limits'\nsake [N m], and how many cables are `limited`.")
      .def(
          "update",
          [](TrackingController& self, double t, const py::object& q, const py::object& qd) {
            Driving::refuse_during_run(self);
            if (!std::isfinite(t))
              throw py::value_error("t must be finite, got " + std::to_string(t));
            const Index d = self.num_coordinates();
            VectorXd command(self.num_cables());
            const Entries entries = of_coordinates(*self.reckons_with());
            const Status status = self.update(t, *VectorArgument(q, "q", d, entries),
                                              *VectorArgument(qd, "qd", d, entries), command);
            if (status != Status::ok) throw py::value_error(message(status));
            return to_array(command);
          },
          "t"_a, "q"_a, "qd"_a,
          Doc("Commands for the state measured at one time.",
              {"t : float\n    Time of the measurement [s].\n", docs::one_q, docs::one_qd},
              "(num_cables,) array\n    Tensions [N]; lengths [m] of cables driven by length.",
              docs::bad_argument));
}

}  // namespace

void bind_controllers(py::module_& m) {
  bind_tracking_controller(m);
  bind_law<Pid>(m, "Pid", "PID loop on the coordinates; see cdcr.Pid.", &read_pid)
      .def_property_readonly(
          "integral", [](const Tracking<Pid>& self) { return to_array(self.integral()); },
          "Accumulated error (d,) [rad s].");
  bind_law<ComputedTorque>(m, "ComputedTorque", "Inverse dynamics and PD; see cdcr.ComputedTorque.",
                           &read_torque);
  bind_law<StateFeedback>(m, "StateFeedback", "A linear law; see cdcr.StateFeedback.",
                          &read_feedback);
  bind_law<TaskSpace>(m, "TaskSpace", "Moves the tip; see cdcr.TaskSpace.", &read_task);
}

}  // namespace cdcr::python
