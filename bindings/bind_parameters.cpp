#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "bind.hpp"
#include "cdcr/parameters.hpp"
#include "cdcr/statics.hpp"
#include "docs.hpp"
#include "gil.hpp"
#include "states.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// Of each parameter its name, value, scale and the function that makes a robot.
using Described = std::vector<std::tuple<std::string, double, double, py::function>>;

ParameterSet make_set(const Model& model, const Described& described) {
  std::vector<Parameter> parameters;
  for (const auto& [name, value, scale, function] : described) {
    const auto robot_at = [function = function](double at) {
      try {
        return call(function, py::make_tuple(at)).cast<Robot>();
      } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError)) throw;
        throw std::invalid_argument(py::str(error.value()));
      }
    };
    parameters.push_back({name, value, robot_at, scale});
  }
  return {model, parameters};
}

py::array_t<double> differentiate_motion(const Model& self, const py::object& q,
                                         const py::object& qd, const py::object& tension,
                                         const py::object& wrenches,
                                         const ParameterSet& parameters) {
  require_inertia(self);
  const Wrenches loads = read_wrenches(self, wrenches);
  ParameterData room(self);
  return States{read_bendings(self, q), read_rates(self, qd, "qd"), read_tensions(self, tension)}
      .matrices(self.num_coordinates(), parameters.size(),
                [&](auto& x, auto& xd, auto& command, auto& out) {
                  parameter_derivatives(self, scratch(self), parameters, room, x, xd, command,
                                        loads, out);
                });
}

py::array_t<double> differentiate_equilibrium(const Model& self, const py::object& q,
                                              const py::object& tension, const py::object& wrenches,
                                              const ParameterSet& parameters) {
  const Wrenches loads = read_wrenches(self, wrenches);
  return States{read_bendings(self, q), read_tensions(self, tension)}.matrices(
      self.num_coordinates(), parameters.size(), [&](auto& x, auto& command, auto& out) {
        out = equilibrium_derivatives(self, parameters, x, command, loads);
      });
}

}  // namespace

void bind_parameters(py::module_& m, PyModel& model) {
  py::class_<ParameterSet>(m, "ParameterSet",
                           "Parameters of a model, ready for derivatives: cpp/sensitivities.md "
                           "eqs. (116) to (118).")
      .def(py::init(&make_set), "model"_a, "parameters"_a,
           Doc("Make the models beside it.",
               {docs::model,
                "parameters : sequence of tuple\n"
                "    Of each its name, value, scale and the function from value to robot.\n"},
               "", docs::bad_argument))
      .def_static(
          "of_sides",
          [](const Model& own,
             const std::vector<std::tuple<std::string, py::object, py::object, double>>& given) {
            std::vector<ParameterSides> sides;
            for (const auto& [name, above, below, width] : given) {
              sides.push_back({name, read_model(above), read_model(below), width});
            }
            return ParameterSet(own, sides);
          },
          "model"_a, "parameters"_a,
          Doc("Make it of two models beside the one for each.",
              {docs::model,
               "parameters : sequence of tuple\n"
               "    Of each its name, the models above and below and how far apart they are.\n"},
              "ParameterSet", docs::bad_argument))
      .def("__len__", &ParameterSet::size)
      .def_property_readonly("names", &ParameterSet::names, "What messages call them.")
      .def("is_exact", &ParameterSet::is_exact, "parameter"_a,
           Doc("Tell whether the derivative with respect to one is exact to rounding.",
               {"parameter : int\n    Which, from 0.\n"}, "bool"));
  model
      .def("_parameter_derivatives", &differentiate_motion, "q"_a, "qd"_a, "tension"_a,
           "wrenches"_a, "parameters"_a, Doc("See cdcr.Model.parameter_derivatives."))
      .def("_equilibrium_derivatives", &differentiate_equilibrium, "q"_a, "tension"_a, "wrenches"_a,
           "parameters"_a, Doc("See cdcr.Model.equilibrium_derivatives."));
}

}  // namespace cdcr::python
