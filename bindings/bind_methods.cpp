#include <pybind11/native_enum.h>
#include <pybind11/stl.h>

#include <optional>
#include <sstream>
#include <string>

#include "bind.hpp"
#include "docs.hpp"
#include "methods.hpp"
#include "pickling.hpp"

namespace cdcr::python {

using namespace py::literals;

namespace {

/// What `automatic` chose, by its name.
std::optional<std::string> chosen_method(const Stats& stats) {
  if (!stats.method) return std::nullopt;
  return *stats.method == Method::bdf ? "bdf" : "dop853";
}

Stats make_stats(long steps, long rejected, long evaluations, long jacobians, long newton_failures,
                 long switches, const std::optional<std::string>& method,
                 std::optional<double> stiff) {
  Stats stats{steps, rejected, evaluations, jacobians, newton_failures, switches, {}, stiff};
  if (method) stats.method = *method == "bdf" ? Method::bdf : Method::dop853;
  return stats;
}

}  // namespace

void bind_methods(py::module_& m) {
  m.attr("with_cvode") = with_cvode;
  py::native_enum<Method>(m, "Method", "enum.Enum", "How to integrate.")
      .value("rk4", Method::rk4)
      .value("dopri5", Method::dopri5)
      .value("bdf", Method::bdf)
      .value("adams", Method::adams)
      .value("dop853", Method::dop853)
      .value("auto", Method::automatic)
      .value("rosenbrock", Method::rosenbrock)
      .finalize();

  const Options defaults;
  py::class_<Options>(m, "Options", "Tolerances, steps and limits of a run.")
      .def(py::init([](std::optional<double> rtol, std::optional<double> atol, double step,
                       double max_step, std::optional<long> max_steps) {
             Options options;
             options.rtol = rtol;
             options.atol = atol;
             options.step = step;
             options.max_step = max_step;
             options.max_steps = max_steps;
             validate(options);
             return options;
           }),
           py::kw_only(), "rtol"_a = defaults.rtol, "atol"_a = defaults.atol,
           "step"_a = defaults.step, "max_step"_a = defaults.max_step,
           "max_steps"_a = defaults.max_steps,
           Doc("Take the options of ``cdcr.simulate``.",
               {"rtol, atol : float or None\n    Tolerances of one step [-], [rad] and [rad/s]; "
                "None: 1e-8, by\n"
                "    bdf 1e-9, and a hundredth of rtol.\n",
                "step, max_step : float\n    Step of rk4 and rosenbrock, largest step of the "
                "others [s].\n",
                "max_steps : int or None\n    Internal steps in one run; None: a million, and a\n"
                "    hundred more for each stretch between break points.\n"},
               "", docs::bad_argument))
      .def_readonly("rtol", &Options::rtol, "Relative tolerance of one step [-]; None: as said.")
      .def_readonly("atol", &Options::atol,
                    "Absolute tolerance of one step [rad], [rad/s]; None: as said.")
      .def_readonly("step", &Options::step, "Step of rk4 [s].")
      .def_readonly("max_step", &Options::max_step,
                    "Largest step of adaptive methods [s]; 0: no limit.")
      .def_readonly("max_steps", &Options::max_steps, "Internal steps in one run; None: as said.");

  py::class_<Stats> stats(m, "Stats", "What a run cost, counted by the integrator.");
  stats
      .def(py::init(&make_stats), "steps"_a = 0, "rejected"_a = 0, "evaluations"_a = 0,
           "jacobians"_a = 0, "newton_failures"_a = 0, "switches"_a = 0, "method"_a = py::none(),
           "stiff"_a = py::none(),
           Doc("Take the counts.",
               {"steps, rejected, evaluations, jacobians, newton_failures, switches : int, "
                "optional\n"
                "    See the attributes.\n",
                "method : {\"dop853\", \"bdf\"} or None, optional\n    See the attributes.\n",
                "stiff : float or None, optional\n    See the attributes [s].\n"}))
      .def_readonly("steps", &Stats::steps, "Internal steps accepted.")
      .def_readonly("rejected", &Stats::rejected, "Steps thrown away by the error test.")
      .def_readonly("evaluations", &Stats::evaluations, "Evaluations of the equations of motion.")
      .def_readonly("jacobians", &Stats::jacobians, "Evaluations of their Jacobian.")
      .def_readonly("newton_failures", &Stats::newton_failures,
                    "Newton iterations that did not converge.")
      .def_readonly("switches", &Stats::switches,
                    "Of method auto: changes between its explicit and its implicit method.")
      .def_property_readonly("method", &chosen_method, "Of method auto: what made the last steps.")
      .def_readonly("stiff", &Stats::stiff,
                    "Of method auto: since when stability alone held explicit steps back [s].")
      .def("__repr__", [](const Stats& s) {
        std::ostringstream of_auto;
        const auto method = chosen_method(s);
        if (method) of_auto << ", switches=" << s.switches << ", method=" << *method;
        if (s.stiff) of_auto << ", stiff=" << *s.stiff;
        return "Stats(steps=" + std::to_string(s.steps) +
               ", rejected=" + std::to_string(s.rejected) +
               ", evaluations=" + std::to_string(s.evaluations) +
               ", jacobians=" + std::to_string(s.jacobians) +
               ", newton_failures=" + std::to_string(s.newton_failures) + of_auto.str() + ")";
      });

  make_picklable(
      stats,
      [](const Stats& s) {
        return py::make_tuple(s.steps, s.rejected, s.evaluations, s.jacobians, s.newton_failures,
                              s.switches, chosen_method(s), s.stiff);
      },
      [](const py::tuple& s) {
        return make_stats(s[0].cast<long>(), s[1].cast<long>(), s[2].cast<long>(),
                          s[3].cast<long>(), s[4].cast<long>(), s[5].cast<long>(),
                          s[6].cast<std::optional<std::string>>(),
                          s[7].cast<std::optional<double>>());
      });
}

}  // namespace cdcr::python
