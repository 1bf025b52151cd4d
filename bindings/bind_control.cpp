#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/pid.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_control(py::module_& m) {
  py::class_<Controller>(m, "Controller", "Turns the measured state into tensions, each period.")
      .def_property_readonly("period", &Controller::period)
      .def("reset", &Controller::reset);

  const PidOptions defaults;
  py::class_<Pid, Controller>(m, "Pid")
      .def(py::init([](const Model& model, double kp, double ki, double kd, double period,
                       bool feed_forward, bool anti_windup, double min_tension, double max_tension,
                       std::vector<Index> cables) {
             return Pid(model, {kp, ki, kd, period, feed_forward, anti_windup,
                                TensionLimits{min_tension, max_tension, std::move(cables)}});
           }),
           "model"_a, py::kw_only(), "kp"_a, "ki"_a = defaults.ki, "kd"_a = defaults.kd,
           "period"_a = defaults.period, "feed_forward"_a = defaults.feed_forward,
           "anti_windup"_a = defaults.anti_windup, "min_tension"_a = defaults.limits.min_tension,
           "max_tension"_a = defaults.limits.max_tension, "cables"_a = defaults.limits.cables)
      .def_property(
          "reference", [](const Pid& self) { return to_array(self.reference()); },
          [](Pid& self, const py::object& q) {
            self.set_reference(*VectorArgument(q, "reference", self.reference().size()));
          })
      .def_property_readonly("integral", [](const Pid& self) { return to_array(self.integral()); })
      .def(
          "update",
          [](Pid& self, double t, const py::object& q, const py::object& qd) {
            const Index n = self.reference().size();
            VectorXd tension(self.num_cables());
            const VectorArgument bending(q, "q", n), rate(qd, "qd", n);
            (void)self.update(t, *bending, *rate, tension);  // finite, so it cannot fail
            return to_array(tension);
          },
          "t"_a, "q"_a, "qd"_a);
}

}  // namespace cdcr::python
