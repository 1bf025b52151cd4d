#include <cmath>
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
      "<Trajectory: 2 samples, t = 0 to 1 s, 1 section, 3 cables, auto, status ok>");
  controller
      .def(py::init([](double period) { return new PythonController(period); }), "period"_a,
           Doc("Make a controller, of which a class derived from this one tells what it does.",
               {"period : float\n    Sampling period [s], > 0.\n"}, "", docs::bad_argument))
      .def_property_readonly("period", &Controller::period,
                             "Time between two updates [s], its period.")
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

}  // namespace

void bind_control(py::module_& m) {
  bind_controller(m);
  bind_reference_path(m);
  bind_controllers(m);
}

}  // namespace cdcr::python
