#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/wrench_input.hpp"
#include "docs.hpp"
#include "gil.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

std::vector<double> to_list(const VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

/// A robot, too, can be taken to the core.
bool is_wrench(const py::handle& object) {
  return py::hasattr(object, "_to_core") && py::hasattr(object, "profile");
}

}  // namespace

Wrenches read_wrenches(const Model& model, const py::object& object) {
  Wrenches wrenches;
  if (py::isinstance<py::tuple>(object) && py::len(object) == 0) return wrenches;  // the default
  const auto add = [&wrenches](const py::handle& item) {
    const std::string name = "wrenches[" + std::to_string(wrenches.size()) + "]";
    if (!is_wrench(item)) {
      throw py::value_error(name + " must be a cdcr.Wrench, got " +
                            std::string(py::str(py::type::of(item).attr("__name__"))));
    }
    if (!item.attr("profile").is_none()) {
      throw py::value_error(name +
                            " has a profile, which a run follows; here give a constant wrench, "
                            "such as wrench.at(t)");
    }
    wrenches.push_back(item.attr("_to_core")().cast<Wrench>());
  };
  if (is_wrench(object)) {
    add(object);
  } else if (!py::isinstance<py::iterable>(object)) {
    throw py::value_error("wrenches must be a sequence of cdcr.Wrench, got " +
                          std::string(py::str(py::type::of(object).attr("__name__"))));
  } else {
    for (const py::handle item : object) add(item);
  }
  validate(model, wrenches);
  return wrenches;
}

void bind_wrench(py::module_& m) {
  py::class_<Wrench>(m, "CoreWrench", "A wrench as the core takes it, unchecked; see cdcr.Wrench.")
      .def(py::init([](Index section, double fraction, const Vector3d& force,
                       const Vector3d& moment, bool local) {
             return Wrench{section, fraction, force, moment,
                           local ? Wrench::Frame::local : Wrench::Frame::base};
           }),
           "section"_a, "fraction"_a, "force"_a, "moment"_a, "local"_a,
           Doc("Take the fields.",
               {docs::section, docs::fraction,
                "force, moment : (3,) array_like\n    Force [N] and moment [N m].\n",
                "local : bool\n    Whether they turn with the backbone.\n"}))
      .def_property_readonly(
          "force", [](const Wrench& self) { return to_array(self.force); }, "Force (3,) [N].")
      .def_property_readonly(
          "moment", [](const Wrench& self) { return to_array(self.moment); },
          "Moment (3,) about the point where the force acts [N m].");

  constexpr const char* base = "wrench : CoreWrench\n    The wrench where the factor is 1.\n";
  py::class_<WrenchInput>(m, "Loads", "Wrenches over time, as a run takes them; see cdcr.Wrench.")
      .def(py::init<>(), Doc("Make loads without a wrench."))
      .def(
          "add", [](WrenchInput& self, const Wrench& wrench) { self.add(wrench); }, "wrench"_a,
          Doc("Add a constant wrench.", {base}))
      .def(
          "add_table",
          [](WrenchInput& self, const Wrench& wrench, const py::object& times,
             const py::object& factors, bool linear) {
            const VectorArgument t(times, "the times of a wrench's profile", -1);
            const VectorArgument f(factors, "the factors of a wrench's profile", (*t).size());
            self.add(wrench, {to_list(*t), to_list(*f), linear, {}});
          },
          "wrench"_a, "times"_a, "factors"_a, "linear"_a,
          Doc("Add a wrench whose size a table gives.",
              {base, "times : (N,) array_like\n    Strictly increasing times [s].\n",
               "factors : (N,) array_like\n    The factor at each [-].\n",
               "linear : bool\n    Connect them, or hold each until the next time.\n"},
              "", docs::bad_argument))
      .def(
          "add_function",
          [](WrenchInput& self, const Wrench& wrench, py::function function,
             std::vector<double> break_points) {
            const auto shared = std::make_shared<py::function>(std::move(function));
            const auto factor = [shared](double t) {
              const Locked locked;
              const VectorArgument value(py::make_tuple(call(*shared, py::make_tuple(t))),
                                         "the value of a wrench's profile", 1);
              return (*value)[0];
            };
            self.add(wrench, {std::move(break_points), {}, false, factor});
          },
          "wrench"_a, "function"_a, "break_points"_a,
          Doc("Add a wrench whose size a function of time gives.",
              {base, "function : callable\n    Called with t [s], returns the factor.\n",
               "break_points : sequence of float\n    Times at which it is not smooth [s].\n"}))
      .def(
          "at",
          [](const WrenchInput& self, double t) {
            Wrenches now = self.wrenches();
            self.evaluate(t, t, now);
            return now;
          },
          "t"_a,
          Doc("The wrenches at one time.", {"t : float\n    The time [s].\n"},
              "list of CoreWrench\n    One for each added."));
}

}  // namespace cdcr::python
