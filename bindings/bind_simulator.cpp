#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/simulator.hpp"
#include "docs.hpp"
#include "gil.hpp"
#include "methods.hpp"
#include "pickling.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

/// A simulator that knows the model as Python has it.
class PythonSimulator final : public Simulator {
 public:
  PythonSimulator(py::object of, double step, int substeps, const std::string& name)
      : Simulator(read_model(of), step, substeps, read_fixed_step(py::str(name))),
        model(std::move(of)) {}

  py::object model;
};

namespace {

py::tuple take_apart(const PythonSimulator& s) {
  return py::make_tuple(s.model, s.period(), s.substeps(), s.started(), to_array(s.q()),
                        to_array(s.qd()), s.start(), s.periods(), fixed_step_name(s.method()),
                        to_array(s.deflection()), to_array(s.felt()));
}

PythonSimulator* put_together(const py::tuple& state) {
  auto simulator = std::make_unique<PythonSimulator>(
      state[0], state[1].cast<double>(), state[2].cast<int>(), state[8].cast<std::string>());
  if (state[3].cast<bool>()) {
    simulator->reset(to_vector(state[4]), to_vector(state[5]), state[6].cast<double>(),
                     state[7].cast<long long>());
    simulator->set_memory(to_vector(state[9]), to_vector(state[10]));
  }
  return simulator.release();
}

}  // namespace

void bind_simulator(py::module_& m) {
  py::class_<PythonSimulator> bound(
      m, "Simulator",
      "The robot inside a control loop: one period at a time, commands held over the period.\n\n"
      "Runge-Kutta 4 on the equations of motion, cpp/README.md eq. (16), or linearly implicit\n"
      "steps of second order. A failed step leaves the last good state in place.\n\n"
      "Parameters\n----------\n"
      "model : Model\n    The robot.\n"
      "step : float, default 1e-3\n    Control period [s], > 0.\n"
      "substeps : int, default 1\n    Equal steps of the method in each period, >= 1.\n"
      "method : {\"rk4\", \"rosenbrock\"}, default \"rk4\"\n"
      "    Explicit, or linearly implicit, which is stable whatever the step: for strong damping,\n"
      "    many parts and rods.\n\n"
      "Raises\n------\n"
      "ValueError\n    For a step or a number of substeps out of its range, another method, or a "
      "robot\n"
      "    without inertia.\n\n"
      "Examples\n--------\n"
      ">>> import cdcr\n"
      ">>> simulator = cdcr.Simulator(cdcr.Model(cdcr.robots.amouri2020()), step=1e-3)\n"
      ">>> simulator.reset([0.5, 0.0], [0.0, 0.0])\n"
      ">>> simulator.step([5.0, 0.0, 0.0])\n"
      "<Status.ok: 0>");
  bound
      .def(py::init<py::object, double, int, const std::string&>(), "model"_a, py::kw_only(),
           "step"_a = 1e-3, "substeps"_a = 1, "method"_a = "rk4",
           Doc("Make a simulator, which has no state until `reset`.",
               {docs::model, "step : float, default 1e-3\n    Control period [s], > 0.\n",
                "substeps : int, default 1\n    Steps of the method in each period, >= 1.\n",
                "method : {\"rk4\", \"rosenbrock\"}, default \"rk4\"\n"
                "    Explicit, or linearly implicit.\n"}))
      .def(
          "reset",
          [](PythonSimulator& self, const py::object& q, const py::object& qd, double time) {
            const Model& model = self.Simulator::model();
            self.reset(*read_bending(model, q, "q"),
                       *VectorArgument(qd, "qd", model.num_coordinates(), of_coordinates(model)),
                       time);
          },
          "q"_a, "qd"_a, "time"_a = 0.0,
          Doc("Set state and time.",
              {docs::one_q, docs::one_qd, "time : float, default 0\n    The time [s].\n"}, "",
              docs::bad_argument))
      .def(
          "step",
          [](PythonSimulator& self, const py::object& tension, const py::object& wrenches,
             const py::object& command) {
            if (tension.is_none() == command.is_none()) {
              throw py::value_error(
                  "give either tension or command, two names for one thing, not both or none");
            }
            const Model& model = self.Simulator::model();
            const bool by_tension = command.is_none();
            Interruption interruption;
            const Status status =
                self.step(*read_tension(model, by_tension ? tension : command,
                                        by_tension ? "tension" : "command"),
                          read_wrenches(model, wrenches), [&] { return interruption(); });
            interruption.raise();
            return status;
          },
          "tension"_a = py::none(), "wrenches"_a = py::tuple(), py::kw_only(),
          "command"_a = py::none(),
          Doc("Advance one period under constant commands and wrenches.",
              {docs::one_tension, docs::wrenches,
               "command : (num_cables,) array_like, optional\n    Another name for `tension`, [N] "
               "or [m].\n"},
              "Status\n    ``ok``, or why the state is still the one before.", docs::bad_argument))
      .def_property_readonly(
          "q", [](const PythonSimulator& self) { return to_array(self.q()); },
          "Coordinates (d,) at the time reached [rad].")
      .def_property_readonly(
          "qd", [](const PythonSimulator& self) { return to_array(self.qd()); },
          "Their rates (d,) at the time reached [rad/s].")
      .def_property_readonly(
          "deflection", [](const PythonSimulator& self) { return to_array(self.deflection()); },
          "Of cables whose friction remembers (num_deflections,) [m].")
      .def_readonly("model", &PythonSimulator::model, "The robot that is moved, a cdcr.Model.")
      .def_property_readonly("time", &PythonSimulator::time,
                             "Time reached [s], after whole periods.")
      .def_property_readonly("period", &PythonSimulator::period,
                             "Control period [s], over which commands hold.")
      .def("__repr__", [](const PythonSimulator& self) {
        std::ostringstream text;
        text << "<Simulator at t = " << self.time() << " s, period " << self.period()
             << " s, q = " << short_text(self.q()) << ">";
        return text.str();
      });
  make_picklable(bound, &take_apart, &put_together);
}

}  // namespace cdcr::python
