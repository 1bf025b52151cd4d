#include <pybind11/pybind11.h>

#include "bind.hpp"
#include "cdcr/version.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "Compiled core of cdcr. Use the package cdcr; names here may change.";
  m.attr("__version__") = cdcr::version;
  m.attr("max_bending") = cdcr::max_bending;
  m.attr("taylor_range") = cdcr::taylor_range;
  cdcr::python::bind_status(m);
  cdcr::python::bind_robot(m);
  cdcr::python::bind_coordinates(m);
  cdcr::python::bind_wrench(m);
  cdcr::python::bind_model(m);
  cdcr::python::bind_control(m);
  cdcr::python::bind_simulate(m);
  cdcr::python::bind_simulator(m);
}
