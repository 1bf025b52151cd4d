#pragma once

#include <pybind11/pybind11.h>

#include "cdcr/allocation.hpp"
#include "cdcr/controller.hpp"
#include "cdcr/reference_path.hpp"
#include "cdcr/simulate.hpp"
#include "cdcr/statics.hpp"
#include "initialised.hpp"

namespace cdcr {
class ComputedTorque;
class Estimator;
class ExtendedKalman;
class KalmanFilter;
class MomentumObserver;
class ParameterSet;
class Pid;
class StateFeedback;
class TaskSpace;
class TrackingController;
class UnscentedKalman;
}  // namespace cdcr

namespace cdcr::python {
template <class Law>
class Estimating;
template <class Law>
class Tracking;
class PythonLoop;
class PythonSimulator;
}  // namespace cdcr::python

// Every class bound.
CDCR_BOUND_CLASS(cdcr::Allocation);
CDCR_BOUND_CLASS(cdcr::Cable);
CDCR_BOUND_CLASS(cdcr::CommandInput);
CDCR_BOUND_CLASS(cdcr::Controller);
CDCR_BOUND_CLASS(cdcr::Equilibrium);
CDCR_BOUND_CLASS(cdcr::Estimator);
CDCR_BOUND_CLASS(cdcr::KalmanFilter);
CDCR_BOUND_CLASS(cdcr::Model);
CDCR_BOUND_CLASS(cdcr::Options);
CDCR_BOUND_CLASS(cdcr::python::Estimating<cdcr::ExtendedKalman>);
CDCR_BOUND_CLASS(cdcr::python::Estimating<cdcr::MomentumObserver>);
CDCR_BOUND_CLASS(cdcr::python::Estimating<cdcr::UnscentedKalman>);
CDCR_BOUND_CLASS(cdcr::ParameterSet);
CDCR_BOUND_CLASS(cdcr::python::Tracking<cdcr::ComputedTorque>);
CDCR_BOUND_CLASS(cdcr::python::Tracking<cdcr::Pid>);
CDCR_BOUND_CLASS(cdcr::python::Tracking<cdcr::StateFeedback>);
CDCR_BOUND_CLASS(cdcr::python::Tracking<cdcr::TaskSpace>);
CDCR_BOUND_CLASS(cdcr::python::PythonLoop);
CDCR_BOUND_CLASS(cdcr::python::PythonSimulator);
CDCR_BOUND_CLASS(cdcr::ReferencePath);
CDCR_BOUND_CLASS(cdcr::Robot);
CDCR_BOUND_CLASS(cdcr::Section);
CDCR_BOUND_CLASS(cdcr::Stats);
CDCR_BOUND_CLASS(cdcr::Trajectory);
CDCR_BOUND_CLASS(cdcr::TrackingController);
CDCR_BOUND_CLASS(cdcr::Wrench);
CDCR_BOUND_CLASS(cdcr::WrenchInput);

// One function for each concept, called once by module.cpp.
namespace cdcr::python {

using PyModel = pybind11::class_<Model>;

void bind_arrays(pybind11::module_& m);
void bind_status(pybind11::module_& m);
void bind_robot(pybind11::module_& m);
void bind_coordinates(pybind11::module_& m);
void bind_wrench(pybind11::module_& m);
void bind_model(pybind11::module_& m);
void bind_cables(PyModel& model);                            ///< called by bind_model
void bind_kinematics(PyModel& model);                        ///< called by bind_model
void bind_dynamics(PyModel& model);                          ///< called by bind_model
void bind_energy(PyModel& model);                            ///< called by bind_model
void bind_tables(PyModel& model);                            ///< called by bind_model
void bind_statics(pybind11::module_& m, PyModel& model);     ///< called by bind_model
void bind_modes(PyModel& model);                             ///< called by bind_model
void bind_parameters(pybind11::module_& m, PyModel& model);  ///< called by bind_model
void bind_quasi_static(pybind11::module_& m);
void bind_control(pybind11::module_& m);
void bind_reference_path(pybind11::module_& m);  ///< called by bind_control
void bind_controllers(pybind11::module_& m);     ///< called by bind_control
void bind_estimators(pybind11::module_& m);
void bind_loop(pybind11::module_& m);
void bind_methods(pybind11::module_& m);
void bind_simulate(pybind11::module_& m);
void bind_simulator(pybind11::module_& m);
void bind_rollout(pybind11::module_& m);

}  // namespace cdcr::python
