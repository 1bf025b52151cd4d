#pragma once

#include <pybind11/pybind11.h>

#include "cdcr/model.hpp"

// One function for each concept, called once by module.cpp.
namespace cdcr::python {

using PyModel = pybind11::class_<Model>;

void bind_arrays(pybind11::module_& m);
void bind_status(pybind11::module_& m);
void bind_robot(pybind11::module_& m);
void bind_coordinates(pybind11::module_& m);
void bind_wrench(pybind11::module_& m);
void bind_model(pybind11::module_& m);
void bind_cables(PyModel& model);                         ///< called by bind_model
void bind_kinematics(PyModel& model);                     ///< called by bind_model
void bind_dynamics(PyModel& model);                       ///< called by bind_model
void bind_energy(PyModel& model);                         ///< called by bind_model
void bind_statics(pybind11::module_& m, PyModel& model);  ///< called by bind_model
void bind_modes(PyModel& model);                          ///< called by bind_model
void bind_control(pybind11::module_& m);
void bind_simulate(pybind11::module_& m);
void bind_simulator(pybind11::module_& m);

}  // namespace cdcr::python
