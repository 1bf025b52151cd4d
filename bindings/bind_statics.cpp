#include <pybind11/stl.h>

#include <limits>
#include <sstream>
#include <string>

#include "bind.hpp"
#include "cdcr/allocation.hpp"
#include "cdcr/statics.hpp"
#include "docs.hpp"
#include "pickling.hpp"
#include "states.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

AllocationMethod read_method(const std::string& name) {
  if (name == "automatic") return AllocationMethod::automatic;
  if (name == "sections") return AllocationMethod::sections;
  if (name == "search") return AllocationMethod::search;
  throw py::value_error("method must be one of ('automatic', 'sections', 'search'), got '" + name +
                        "'");
}

Allocation find_tension(const Model& self, const py::object& force, double min_tension,
                        double max_tension, const std::string& method, const py::object& q) {
  if (!(min_tension >= 0.0)) {
    std::ostringstream text;
    text << "min_tension must be >= 0 N (a cable cannot push), got " << min_tension;
    throw py::value_error(text.str());
  }
  const VectorXd wanted =
      *VectorArgument(force, "force", self.num_coordinates(), of_coordinates(self));
  const TensionLimits limits{min_tension, max_tension, {}, read_method(method)};
  if (q.is_none()) return allocate(self, wanted, limits);
  return allocate_at(self, *read_bending(self, q, "q"), wanted, limits);
}

void bind_equilibrium(py::module_& m) {
  py::class_<Equilibrium> bound(
      m, "Equilibrium",
      "Answer of `Model.find_equilibrium`: a point of rest, and whether the robot stays there.\n\n"
      "cpp/README.md eq. (18), cpp/several-sections.md eqs. (40) to (43).");
  bound
      .def_property_readonly(
          "q", [](const Equilibrium& self) { return to_array(self.q); },
          "Bending vectors (d,) [rad].")
      .def_property_readonly(
          "eigenvalues", [](const Equilibrium& self) { return to_array(self.eigenvalues); },
          "Eigenvalues of the stiffness at q, their real parts, increasing (d,) [N m/rad].")
      .def_property_readonly(
          "tension", [](const Equilibrium& self) { return to_array(self.tension); },
          "What the cables pull with there (num_cables,) [N].")
      .def_readonly("friction_left_out", &Equilibrium::friction_left_out,
                    "Whether the robot's cables rub: then it rests anywhere in a range of shapes,\n"
                    "and this is the one that it would rest at without friction.")
      .def_readonly("stable", &Equilibrium::stable,
                    "Whether all eigenvalues are positive; neutral counts as not stable.")
      .def_readonly("residual", &Equilibrium::residual,
                    "Largest component of the unbalanced generalised force [N m].")
      .def_readonly("iterations", &Equilibrium::iterations, "Newton steps, in all searches made.")
      .def_readonly("load_steps", &Equilibrium::load_steps,
                    "Steps of the load from nothing to all; 0 where found without.")
      .def_readonly("searches", &Equilibrium::searches, "Places started from.")
      .def_readonly("status", &Equilibrium::status, "``ok``, or why there is no answer.")
      .def("__repr__", [](const Equilibrium& self) {
        std::ostringstream text;
        text << "<Equilibrium at q = " << short_text(self.q) << (self.stable ? ", " : ", not ")
             << "stable, residual " << self.residual << " N m, status " << name(self.status)
             << (self.friction_left_out ? ", friction left out>" : ">");
        return text.str();
      });
  make_picklable(
      bound,
      [](const Equilibrium& e) {
        return py::make_tuple(to_array(e.q), to_array(e.tension), to_array(e.eigenvalues), e.stable,
                              e.friction_left_out, e.residual, e.iterations, e.load_steps,
                              e.searches, e.status);
      },
      [](const py::tuple& s) {
        return Equilibrium{to_vector(s[0]),    to_vector(s[1]),   to_vector(s[2]),
                           s[3].cast<bool>(),  s[4].cast<bool>(), s[5].cast<double>(),
                           s[6].cast<int>(),   s[7].cast<int>(),  s[8].cast<int>(),
                           s[9].cast<Status>()};
      });
}

void bind_allocation(py::module_& m) {
  py::class_<Allocation> bound(
      m, "Allocation",
      "Answer of `Model.find_tension`: tensions for a generalised force, or for\n"
      "the nearest, cpp/README.md eq. (20).");
  bound
      .def_property_readonly(
          "tension", [](const Allocation& self) { return to_array(self.tension); },
          "Tensions (num_cables,) [N].")
      .def_property_readonly(
          "force", [](const Allocation& self) { return to_array(self.force); },
          "The generalised force they give (d,) [N m].")
      .def_readonly("distance", &Allocation::distance,
                    "How far that is from the force asked for [N m].")
      .def_readonly("feasible", &Allocation::feasible, "Whether it is the force asked for.")
      .def_readonly("limiting", &Allocation::limiting,
                    "Indices of the cables whose limit is in the way.")
      .def_readonly("limits", &Allocation::limits, "These limits in words.")
      .def("__repr__", [](const Allocation& self) {
        std::ostringstream text;
        text << "<Allocation: tension " << short_text(self.tension) << " N, "
             << (self.feasible ? "feasible" : "not feasible") << ", distance " << self.distance
             << " N m>";
        return text.str();
      });
  make_picklable(
      bound,
      [](const Allocation& a) {
        return py::make_tuple(to_array(a.tension), to_array(a.force), a.distance, a.feasible,
                              a.limiting, a.limits);
      },
      [](const py::tuple& s) {
        return Allocation{to_vector(s[0]),
                          to_vector(s[1]),
                          s[2].cast<double>(),
                          s[3].cast<bool>(),
                          s[4].cast<std::vector<Index>>(),
                          s[5].cast<std::vector<std::string>>()};
      });
}

}  // namespace

void bind_statics(py::module_& m, PyModel& model) {
  bind_equilibrium(m);
  bind_allocation(m);
  model
      .def("find_tension", &find_tension, "force"_a, "min_tension"_a = 0.0,
           "max_tension"_a = std::numeric_limits<double>::infinity(), "method"_a = "automatic",
           "q"_a = py::none(),
           Doc("Least-norm cable tensions within limits for a generalised force, or for the\n"
               "nearest: cpp/README.md eq. (20), cpp/several-sections.md eq. (46).",
               {"force : (d,) array_like\n    Generalised force [N m].\n",
                "min_tension, max_tension : float, optional\n"
                "    Limits of every tension [N], 0 <= min_tension <= max_tension.\n",
                "method : {\"automatic\", \"sections\", \"search\"}, optional\n"
                "    As for `allocate`.\n",
                "q : (d,) array_like, optional\n"
                "    Where the robot is [rad]; to be given where its actuation matrix depends on\n"
                "    it.\n"},
               "Allocation\n    Tensions, the force they give and what limits them.",
               docs::bad_argument))
      .def(
          "find_equilibrium",
          [](const Model& self, const py::object& tension, const py::object& q0,
             const py::object& wrenches) {
            const VectorXd start =
                q0.is_none() ? VectorXd() : VectorXd(*read_bending(self, q0, "q0"));
            return equilibrium(self, *read_tension(self, tension), start,
                               read_wrenches(self, wrenches));
          },
          "tension"_a = py::none(), "q0"_a = py::none(), "wrenches"_a = py::tuple(),
          Doc("Point of rest under constant commands and wrenches, whether found or not, and\n"
              "whether stable: cpp/several-sections.md eqs. (40) to (43).",
              {docs::one_tension,
               "q0 : (d,) array_like, optional\n"
               "    Where to start [rad]; by default the answer without gravity.\n",
               docs::wrenches},
              "Equilibrium\n    The answer, or in `status` why there is none.", docs::bad_argument))
      .def(
          "static_stiffness",
          [](const Model& self, const py::object& q, const py::object& tension,
             const py::object& wrenches) {
            const Wrenches loads = read_wrenches(self, wrenches);
            const Index d = self.num_coordinates();
            return States{read_bendings(self, q), read_tensions(self, tension)}.matrices(
                d, d, [&](auto& x, auto& command, auto& K) {
                  static_stiffness(self, x, command, loads, K);
                });
          },
          "q"_a, "tension"_a = py::none(), "wrenches"_a = py::tuple(),
          Doc("Stiffness of the robot at rest, springs of cables and wrenches included:\n"
              "cpp/several-sections.md eq. (41).",
              {docs::q, docs::tension_or_rest, docs::wrenches},
              "(..., d, d) array\n    Stiffness K [N m/rad].", docs::bad_states))
      .def(
          "commands",
          [](const Model& self, const py::object& q, const py::object& tension) {
            return States{read_bendings(self, q), read_tensions(self, tension)}.vectors(
                self.num_cables(),
                [&](auto& x, auto& pull, auto& out) { cable_commands(self, x, pull, out); });
          },
          "q"_a, "tension"_a,
          Doc("Commands that make the cables pull with given tensions at rest: (36) of\n"
              "cpp/several-sections.md, solved for the length.",
              {docs::q, "tension : (..., num_cables) array_like\n    Tensions wanted [N].\n"},
              "(..., num_cables) array\n"
              "    Tensions [N]; lengths [m] of cables driven by length.",
              docs::bad_states));
}

}  // namespace cdcr::python
