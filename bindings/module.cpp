#include <pybind11/pybind11.h>

#include "bind.hpp"
#include "cdcr/version.hpp"
#include "docs.hpp"
#include "pickling.hpp"
#include "plain_calls.hpp"

PYBIND11_MODULE(_core, m) {
  pybind11::options options;
  options.disable_function_signatures();  // cdcr::python::Doc writes them
  m.doc() = "Compiled core of cdcr. Use the package cdcr; names here may change.";
  m.attr("__version__") = cdcr::version;
  m.attr("max_bending") = cdcr::max_bending;
  m.attr("taylor_range") = cdcr::taylor_range;
  cdcr::python::bind_arrays(m);
  cdcr::python::bind_status(m);
  cdcr::python::bind_robot(m);
  cdcr::python::bind_coordinates(m);
  cdcr::python::bind_wrench(m);
  cdcr::python::bind_model(m);
  cdcr::python::bind_quasi_static(m);
  cdcr::python::bind_control(m);
  cdcr::python::bind_methods(m);
  cdcr::python::bind_simulate(m);
  cdcr::python::bind_simulator(m);
  cdcr::python::bind_rollout(m);
  cdcr::python::bind_estimators(m);
  cdcr::python::bind_loop(m);
  cdcr::python::show_constructors(m);
  cdcr::python::show_getters(m);
  cdcr::python::finish_pickling(m);
  cdcr::python::tell_calls_plainly(m);
}
