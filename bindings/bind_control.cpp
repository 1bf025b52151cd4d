#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <sstream>

#include "arrays.hpp"
#include "bind.hpp"
#include "controllers.hpp"
#include "docs.hpp"
#include "gil.hpp"
#include "pickling.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

PythonController::PythonController(double period) : period_(period) {
  if (period > 0.0 && std::isfinite(period)) return;
  std::ostringstream text;
  text << "period must be > 0 s and finite, got " << period;
  throw py::value_error(text.str());
}

void PythonController::reset() noexcept {
  guarded([this] {
    const py::function own = py::get_override(static_cast<const Controller*>(this), "reset");
    if (own) (void)call(own, py::tuple());
  });
}

Status PythonController::update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                                VectorRef command) noexcept {
  return guarded([&] {
    const py::function own = py::get_override(static_cast<const Controller*>(this), "update");
    if (!own) {
      PyErr_SetString(PyExc_NotImplementedError,
                      "a controller needs a method update(self, t, q, qd) that returns the "
                      "commands of the cables");
      throw py::error_already_set();
    }
    command = *read_command(call(own, py::make_tuple(t, to_array(q), to_array(qd))),
                            "the value of the controller's update", command.size());
  });
}

template <class Function>
Status PythonController::guarded(Function&& function) noexcept {
  if (exception_) return Status::interrupted;  // reset has thrown
  try {
    const Locked locked;
    function();
    return Status::ok;
  } catch (...) {
    exception_ = std::current_exception();
    return Status::interrupted;
  }
}

PythonPid::PythonPid(py::object of, PidOptions options)
    : Pid(read_model(of), std::move(options)), model(std::move(of)) {}

void PythonController::rethrow() {
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
}

namespace {

void bind_controller(py::module_& m) {
  py::class_<Controller, PythonController> controller(
      m, "Controller",
      "Turns the measured state into commands, once each period; they are held until the next.\n\n"
      "What ``cdcr.simulate`` takes as `controller`. ``cdcr.Pid`` is one; a class of your own\n"
      "derives from this one and has a method ``update(self, t, q, qd)``, which gets the time "
      "[s],\n"
      "bending vectors (d,) [rad] and their rates (d,) [rad/s] and returns the commands\n"
      "(num_cables,): tensions [N], lengths [m] of cables driven by length. Where it keeps a "
      "state\n"
      "it also has a method ``reset(self)``, called before each run.\n\n"
      "Parameters\n----------\n"
      "period : float\n    Sampling period [s], > 0.\n\n"
      "Raises\n------\n"
      "ValueError\n    For a period out of its range.\n\n"
      "Examples\n--------\n"
      ">>> import cdcr\n"
      ">>> class Spring(cdcr.Controller):\n"
      "...     def __init__(self, gain):\n"
      "...         super().__init__(period=0.01)\n"
      "...         self.gain = gain\n"
      "...\n"
      "...     def update(self, t, q, qd):\n"
      "...         return [max(0.0, -self.gain * q[0]), 0.0, 0.0]\n"
      ">>> model = cdcr.Model(cdcr.robots.amouri2020())\n"
      ">>> cdcr.simulate(model, [0.1, 0.0], [0.0, 0.0], t=[0.0, 1.0], controller=Spring(1.0))\n"
      "<Trajectory: 2 samples, t = 0 to 1 s, 1 section, 3 cables, bdf, status ok>");
  controller
      .def(py::init([](double period) { return new PythonController(period); }), "period"_a,
           Doc("Make a controller, of which a class derived from this one tells what it does.",
               {"period : float\n    Sampling period [s], > 0.\n"}, "", docs::bad_argument))
      .def_property_readonly("period", &Controller::period, "Sampling period [s].")
      .def(
          "reset",
          [](Controller& self) {
            if (dynamic_cast<PythonController*>(&self) == nullptr) self.reset();
          },
          Doc("Forget what has been accumulated, before a new run."));
  make_picklable(
      controller, [](const Controller& self) { return py::make_tuple(self.period()); },
      [](const py::tuple& state) { return new PythonController(state[0].cast<double>()); });
}

PythonPid* make_pid(const py::object& model, double kp, double ki, double kd, double period,
                    bool feed_forward, bool anti_windup, double min_tension, double max_tension,
                    std::vector<Index> cables) {
  TensionLimits limits;
  limits.min_tension = min_tension;
  limits.max_tension = max_tension;
  limits.cables = std::move(cables);
  return new PythonPid(model, {kp, ki, kd, period, feed_forward, anti_windup, std::move(limits)});
}

py::tuple take_apart(const PythonPid& pid) {
  const PidOptions& o = pid.options();
  return py::make_tuple(pid.model, o.kp, o.ki, o.kd, o.period, o.feed_forward, o.anti_windup,
                        o.limits.min_tension, o.limits.max_tension, o.limits.cables,
                        to_array(pid.reference()), to_array(pid.integral()));
}

PythonPid* put_together(const py::tuple& state) {
  auto pid = std::unique_ptr<PythonPid>(make_pid(
      state[0], state[1].cast<double>(), state[2].cast<double>(), state[3].cast<double>(),
      state[4].cast<double>(), state[5].cast<bool>(), state[6].cast<bool>(),
      state[7].cast<double>(), state[8].cast<double>(), state[9].cast<std::vector<Index>>()));
  pid->set_reference(to_vector(state[10]));
  pid->set_integral(to_vector(state[11]));
  return pid.release();
}

void bind_pid(py::module_& m) {
  const PidOptions defaults;
  py::class_<PythonPid, Controller> pid(m, "Pid", "PID loop on the bending vectors; see cdcr.Pid.");
  pid.def(py::init(&make_pid), "model"_a, py::kw_only(), "kp"_a, "ki"_a = defaults.ki,
          "kd"_a = defaults.kd, "period"_a = defaults.period,
          "feed_forward"_a = defaults.feed_forward, "anti_windup"_a = defaults.anti_windup,
          "min_tension"_a = defaults.limits.min_tension,
          "max_tension"_a = defaults.limits.max_tension, "cables"_a = defaults.limits.cables,
          Doc("Make a controller whose reference is the straight robot.",
              {"model, kp, ki, kd, period, feed_forward, anti_windup, min_tension, max_tension, "
               "cables\n    As in cdcr.Pid.\n"},
              "", docs::bad_argument))
      .def_readonly("model", &PythonPid::model, "The model whose forces it reckons with.")
      .def_property(
          "reference", [](const PythonPid& self) { return to_array(self.reference()); },
          [](PythonPid& self, const py::object& q) {
            self.set_reference(*VectorArgument(q, "reference", self.reference().size(),
                                               of_coordinates(self.model.cast<const Model&>())));
          },
          "Bending vectors to reach and hold (d,) [rad]; straight until set.")
      .def("__repr__",
           [](const PythonPid& self) {
             const PidOptions& options = self.options();
             std::ostringstream text;
             text << "<Pid: kp " << options.kp << ", ki " << options.ki << ", kd " << options.kd
                  << ", period " << options.period << " s>";
             return text.str();
           })
      .def_property_readonly(
          "integral", [](const PythonPid& self) { return to_array(self.integral()); },
          "Accumulated error (d,) [rad s].")
      .def(
          "update",
          [](PythonPid& self, double t, const py::object& q, const py::object& qd) {
            const Index n = self.reference().size();
            VectorXd tension(self.num_cables());
            const Entries entries = of_coordinates(self.model.cast<const Model&>());
            const VectorArgument bending(q, "q", n, entries), rate(qd, "qd", n, entries);
            (void)self.update(t, *bending, *rate, tension);  // finite, so it cannot fail
            return to_array(tension);
          },
          "t"_a, "q"_a, "qd"_a,
          Doc("Tensions for the state measured at one time.",
              {"t : float\n    Time of the measurement [s].\n", docs::one_q, docs::one_qd},
              "(num_cables,) array\n    Tensions [N].", docs::bad_argument));
  make_picklable(pid, &take_apart, &put_together);
}

}  // namespace

void bind_control(py::module_& m) {
  bind_controller(m);
  bind_pid(m);
}

}  // namespace cdcr::python
