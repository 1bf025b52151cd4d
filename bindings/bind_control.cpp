#include <pybind11/stl.h>

#include <sstream>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/pid.hpp"
#include "docs.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_control(py::module_& m) {
  py::class_<Controller>(m, "Controller",
                         "Turns the measured state into tensions, once each period; they are held "
                         "until the next.\n\n"
                         "What ``cdcr.simulate`` takes as `controller`; ``cdcr.Pid`` "
                         "is one.")
      .def_property_readonly("period", &Controller::period, "Sampling period [s].")
      .def("reset", &Controller::reset, Doc("Forget what has been accumulated, before a new run."));

  const PidOptions defaults;
  py::class_<Pid, Controller>(m, "Pid", "PID loop on the bending vectors; see cdcr.Pid.")
      .def(py::init([](const Model& model, double kp, double ki, double kd, double period,
                       bool feed_forward, bool anti_windup, double min_tension, double max_tension,
                       std::vector<Index> cables) {
             return Pid(model, {kp, ki, kd, period, feed_forward, anti_windup,
                                TensionLimits{min_tension, max_tension, std::move(cables)}});
           }),
           "model"_a, py::kw_only(), "kp"_a, "ki"_a = defaults.ki, "kd"_a = defaults.kd,
           "period"_a = defaults.period, "feed_forward"_a = defaults.feed_forward,
           "anti_windup"_a = defaults.anti_windup, "min_tension"_a = defaults.limits.min_tension,
           "max_tension"_a = defaults.limits.max_tension, "cables"_a = defaults.limits.cables,
           Doc("Make a controller whose reference is the straight robot.",
               {"model, kp, ki, kd, period, feed_forward, anti_windup, min_tension, max_tension, "
                "cables\n    As in cdcr.Pid.\n"},
               "", docs::bad_argument))
      .def_property(
          "reference", [](const Pid& self) { return to_array(self.reference()); },
          [](Pid& self, const py::object& q) {
            self.set_reference(*VectorArgument(q, "reference", self.reference().size()));
          },
          "Bending vectors to reach and hold (d,) [rad]; straight until set.")
      .def("__repr__",
           [](const Pid& self) {
             const PidOptions& options = self.options();
             std::ostringstream text;
             text << "<Pid: kp " << options.kp << ", ki " << options.ki << ", kd " << options.kd
                  << ", period " << options.period << " s>";
             return text.str();
           })
      .def_property_readonly(
          "integral", [](const Pid& self) { return to_array(self.integral()); },
          "Accumulated error (d,) [rad s].")
      .def(
          "update",
          [](Pid& self, double t, const py::object& q, const py::object& qd) {
            const Index n = self.reference().size();
            VectorXd tension(self.num_cables());
            const VectorArgument bending(q, "q", n), rate(qd, "qd", n);
            (void)self.update(t, *bending, *rate, tension);  // finite, so it cannot fail
            return to_array(tension);
          },
          "t"_a, "q"_a, "qd"_a,
          Doc("Tensions for the state measured at one time.",
              {"t : float\n    Time of the measurement [s].\n", docs::one_q, docs::one_qd},
              "(num_cables,) array\n    Tensions [N].", docs::bad_argument));
}

}  // namespace cdcr::python
