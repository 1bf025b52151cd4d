#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "cdcr/actuator.hpp"
#include "cdcr/sensor.hpp"

// Options as Python's classes give them: dicts with all their keys.

namespace cdcr::python {

namespace py = pybind11;

[[nodiscard]] std::vector<Actuator> read_actuators(const py::dict& options);
[[nodiscard]] std::vector<Sensor> read_sensors(const py::dict& options);

}  // namespace cdcr::python
