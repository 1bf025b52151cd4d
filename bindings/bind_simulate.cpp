#include <pybind11/stl.h>

#include <memory>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/sensitivities.hpp"
#include "cdcr/simulate.hpp"
#include "controllers.hpp"
#include "docs.hpp"
#include "driving.hpp"
#include "gil.hpp"
#include "methods.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// A Python callable as tension function: the slow path, one call of Python for each evaluation.
CommandInput call_python(py::function function, Index num_cables,
                         std::vector<double> break_points) {
  // Shared, because copying a Python object would need the GIL wherever the input is copied.
  const auto shared = std::make_shared<py::function>(std::move(function));
  return CommandInput::function(
      [shared, num_cables](double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                           VectorRef tension) {
        const Locked locked;
        const VectorArgument value(call(*shared, py::make_tuple(t, to_array(q), to_array(qd))),
                                   "the value of the tension function", num_cables, of_cables);
        tension = *value;
      },
      num_cables, std::move(break_points));
}

/// Of each event its function, direction and terminal.
using WatchedFunctions = std::vector<std::tuple<py::function, int, int>>;

/// A Python function as event: called with t, q, qd, like one of tensions.
Event call_event(py::function function, int direction, int terminal) {
  const auto shared = std::make_shared<py::function>(std::move(function));
  return {[shared](double t, const ConstVectorRef& q, const ConstVectorRef& qd) {
            const Locked locked;
            const py::object value = call(*shared, py::make_tuple(t, to_array(q), to_array(qd)));
            return *read_array(value, "the value of an event", {}).data();
          },
          direction, terminal};
}

/// Whether q0, qd0, commands; parameters; start; times, values and whether connected of the slopes
/// of commands; or None.
Sensitivities read_sensitivities(const py::object& asked) {
  Sensitivities found;
  if (asked.is_none()) return found;
  const py::tuple given = asked;
  found.q0 = given[0].cast<bool>();
  found.qd0 = given[1].cast<bool>();
  found.command = given[2].cast<bool>();
  if (!given[3].is_none()) found.parameters = given[3].cast<const ParameterSet&>();
  if (!given[4].is_none()) {
    const Array start = read_array(given[4], "sensitivities at the start", {any_size, any_size});
    found.start = Eigen::Map<const RowMatrixXd>(start.data(), start.shape(0), start.shape(1));
  }
  if (!given[5].is_none()) {
    const py::tuple slopes = given[5];
    const VectorXd times = *VectorArgument(slopes[0], "times of slopes", -1);
    const Array rows = read_array(slopes[1], "slopes of commands", {times.size(), any_size});
    found.command_slopes = Signal::table(
        "slopes of commands", times,
        Eigen::Map<const RowMatrixXd>(rows.data(), rows.shape(0), rows.shape(1)),
        slopes[2].cast<bool>() ? Signal::Interpolation::linear : Signal::Interpolation::previous);
  }
  return found;
}

/// `sources` are a const CommandInput and Sensitivities, or a Controller.
template <class... Sources>
Trajectory run(const Model& model, const py::object& q0, const py::object& qd0, const py::object& t,
               Method method, const Options& options, const py::object& progress,
               const WrenchInput& loads, const WatchedFunctions& events, Sources&... sources) {
  Events watched;
  for (const auto& [function, direction, terminal] : events) {
    watched.push_back(call_event(function, direction, terminal));
  }
  const VectorXd q = *read_bending(model, q0, "q0");
  const VectorXd qd = *VectorArgument(qd0, "qd0", model.num_coordinates(), of_coordinates(model));
  const VectorXd times = *VectorArgument(t, "t", -1);
  Interruption interruption;
  const auto report = [&](double now) {
    if (!progress.is_none()) {
      const Locked locked;
      (void)call(progress, py::make_tuple(now));
    }
    return !interruption();
  };
  const auto unlocked_run = [&] {
    const Unlocked unlocked;
    return simulate(model, q, qd, times, sources..., method, options, make_any_integrator, report,
                    loads, watched);
  };
  Trajectory done = unlocked_run();
  interruption.raise();
  return done;
}

Trajectory run_commanded(const Model& model, const py::object& q0, const py::object& qd0,
                         const py::object& t, const CommandInput& input, Method method,
                         const Options& options, const py::object& progress,
                         const WrenchInput& loads, const WatchedFunctions& events,
                         const py::object& sensitivities) {
  const Sensitivities asked = read_sensitivities(sensitivities);
  return run(model, q0, qd0, t, method, options, progress, loads, events, input, asked);
}

Trajectory run_controlled(const Model& model, const py::object& q0, const py::object& qd0,
                          const py::object& t, Controller& controller, Method method,
                          const Options& options, const py::object& progress,
                          const WrenchInput& loads, const WatchedFunctions& events) {
  const Driving driving(controller);
  auto* const written_in_python = dynamic_cast<PythonController*>(&controller);
  try {
    Trajectory done = run(model, q0, qd0, t, method, options, progress, loads, events, controller);
    if (written_in_python != nullptr) written_in_python->rethrow();
    return done;
  } catch (...) {
    if (written_in_python != nullptr) written_in_python->rethrow();
    throw;
  }
}

py::list slack_events(const Trajectory& run) {
  py::list events;
  for (const SlackEvent& event : run.slack_events) {
    events.append(py::make_tuple(event.time, event.cable, event.slack));
  }
  return events;
}

py::list events_of(const Trajectory& run) {
  py::list events;
  for (const EventRecord& event : run.events) {
    events.append(py::make_tuple(event.time, event.event, to_array(event.q), to_array(event.qd)));
  }
  return events;
}

constexpr const char* an_input = "TensionInput\n    What a run takes.";

}  // namespace

void bind_simulate(py::module_& m) {
  py::class_<CommandInput>(m, "TensionInput", "Commands of the cables as a function of time.")
      .def_static(
          "constant",
          [](const Model& model, const py::object& tension, const std::string& name) {
            return CommandInput::constant(*read_tension(model, tension, name.c_str()));
          },
          "model"_a, "tension"_a, "name"_a = "tension",
          Doc("The same commands at all times.",
              {docs::model, docs::one_tension,
               "name : str, default \"tension\"\n    What messages call it.\n"},
              an_input, docs::bad_argument))
      .def_static(
          "table",
          [](const Model& model, const py::object& t, const py::object& tension, bool linear) {
            const VectorXd times = *VectorArgument(t, "the table's t", -1);
            const Array rows = read_array(tension, "the table's tension",
                                          {times.size(), model.num_cables()}, of_cables);
            const Eigen::Map<const RowMatrixXd> values(rows.data(), rows.shape(0), rows.shape(1));
            return CommandInput::table(times, values,
                                       linear ? CommandInput::Interpolation::linear
                                              : CommandInput::Interpolation::previous);
          },
          "model"_a, "t"_a, "tension"_a, "linear"_a,
          Doc("Commands at given times.",
              {docs::model, "t : (N,) array_like\n    Strictly increasing times [s].\n",
               "tension : (N, num_cables) array_like\n"
               "    Tensions [N]; lengths [m] for cables driven by length.\n",
               "linear : bool\n    Connect them, or hold each until the next time.\n"},
              an_input, docs::bad_argument))
      .def_static(
          "function",
          [](const Model& model, py::function function, std::vector<double> break_points) {
            return call_python(std::move(function), model.num_cables(), std::move(break_points));
          },
          "model"_a, "function"_a, "break_points"_a,
          Doc("A Python function, called once for each evaluation.",
              {docs::model,
               "function : callable\n"
               "    Called with t [s], q (d,) [rad], qd (d,) [rad/s]; returns the commands.\n",
               "break_points : sequence of float\n    Times at which it is not smooth [s].\n"},
              an_input, docs::bad_argument));

  py::class_<Trajectory>(m, "Trajectory", "A run as the core returns it; see cdcr.Trajectory.")
      .def_property_readonly(
          "t", [](const Trajectory& self) { return read_only(to_array(self.t)); },
          "Output times reached (N,) [s].")
      .def_property_readonly(
          "q", [](const Trajectory& self) { return read_only(to_rows(self.q)); },
          "Bending vectors (N, d) [rad].")
      .def_property_readonly(
          "qd", [](const Trajectory& self) { return read_only(to_rows(self.qd)); },
          "Their rates (N, d) [rad/s].")
      .def_property_readonly(
          "tension", [](const Trajectory& self) { return read_only(to_rows(self.tension)); },
          "Tensions at the base (N, num_cables) [N].")
      .def_property_readonly(
          "command", [](const Trajectory& self) { return read_only(to_rows(self.command)); },
          "What was asked of the cables (N, num_cables), [N] or [m].")
      .def_property_readonly(
          "deflection", [](const Trajectory& self) { return read_only(to_rows(self.deflection)); },
          "Of cables whose friction remembers (N, num_deflections) [m].")
      .def_property_readonly(
          "sensitivities",
          [](const Trajectory& self) { return read_only(to_rows(self.sensitivities)); },
          "Derivatives of q [rad] and qd [rad/s], in rows (N, 2 d k), over SI units.")
      .def_property_readonly("slack_events", &slack_events,
                             "Time [s], cable and whether slack, in the order of time.")
      .def_property_readonly(
          "events", &events_of,
          "Time [s], which event, q (d,) [rad] and qd (d,) [rad/s] there, in the "
          "order of time.")
      .def_readonly("status", &Trajectory::status, "How the run ended.")
      .def_readonly("message", &Trajectory::message, "Empty for ok; else when, why, what to try.")
      .def_readonly("stats", &Trajectory::stats, "What the run cost.");

  constexpr const char* start =
      "q0, qd0 : (d,) array_like\n    Bending vectors [rad] and rates [rad/s] at t[0].\n"
      "t : (N,) array_like\n    Output times, increasing [s].\n";
  constexpr const char* rest =
      "method : Method\n    How to integrate.\n"
      "options : Options\n    Tolerances, steps and limits.\n"
      "progress : callable or None\n    Told the time reached [s] now and then.\n"
      "loads : Loads\n    Wrenches over time.\n"
      "events : sequence\n    Of each its function f(t, q, qd), direction and terminal [1].\n";
  constexpr const char* a_run = "Trajectory\n    The samples up to the end, or to a failure.";
  m.def("simulate", &run_commanded, "model"_a, "q0"_a, "qd0"_a, "t"_a, "input"_a, "method"_a,
        "options"_a, "progress"_a, "loads"_a, "events"_a, "sensitivities"_a,
        Doc("A run under commands; see cdcr.simulate.",
            {docs::model, start, "input : TensionInput\n    Commands over time.\n", rest,
             "sensitivities : tuple or None\n    By what it is differentiated.\n"},
            a_run, docs::bad_argument));
  m.def("simulate_controlled", &run_controlled, "model"_a, "q0"_a, "qd0"_a, "t"_a, "controller"_a,
        "method"_a, "options"_a, "progress"_a, "loads"_a, "events"_a,
        Doc("A run under a controller; see cdcr.simulate.",
            {docs::model, start, "controller : Controller\n    Asked once each period.\n", rest},
            a_run, docs::bad_argument));
}

}  // namespace cdcr::python
