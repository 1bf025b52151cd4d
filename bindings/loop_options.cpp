#include "loop_options.hpp"

#include <pybind11/stl.h>

#include <map>
#include <string>
#include <utility>

namespace cdcr::python {
namespace {

template <class T>
T field(const py::dict& given, const char* name) {
  return given[name].cast<T>();
}

Actuator read_actuator(const py::dict& given) {
  Actuator actuator;
  actuator.resolution = field<double>(given, "resolution");
  actuator.dead_time = field<double>(given, "dead_time");
  actuator.time_constant = field<double>(given, "time_constant");
  actuator.max_rate = field<double>(given, "max_rate");
  actuator.min_command = field<double>(given, "min_command");
  actuator.max_command = field<double>(given, "max_command");
  if (given["winch"].is_none()) return actuator;
  const auto winch = given["winch"].cast<py::dict>();
  actuator.winch = Winch{field<double>(winch, "drum_radius"), field<double>(winch, "gear"),
                         field<double>(winch, "inertia"),     field<double>(winch, "bandwidth"),
                         field<double>(winch, "max_torque"),  field<double>(winch, "max_speed")};
  return actuator;
}

Sensor read_sensor(const py::dict& given) {
  using Kind = Sensor::Kind;
  static const std::map<std::string, Kind> kinds{{"coordinates", Kind::coordinates},
                                                 {"rates", Kind::rates},
                                                 {"lengths", Kind::lengths},
                                                 {"tensions", Kind::tensions},
                                                 {"tip", Kind::tip},
                                                 {"curvature", Kind::curvature},
                                                 {"orientation", Kind::orientation},
                                                 {"base_force", Kind::base_force},
                                                 {"base_moment", Kind::base_moment}};
  Sensor sensor;
  sensor.kind = kinds.at(field<std::string>(given, "kind"));
  sensor.period = field<double>(given, "period");
  sensor.delay = field<double>(given, "delay");
  sensor.noise = field<double>(given, "noise");
  sensor.bias = field<double>(given, "bias");
  sensor.seed = field<std::uint64_t>(given, "seed");
  for (const auto& [section, fraction] :
       given["places"].cast<std::vector<std::pair<Index, double>>>()) {
    sensor.places.push_back({section, fraction});
  }
  return sensor;
}

}  // namespace

std::vector<Actuator> read_actuators(const py::dict& options) {
  std::vector<Actuator> actuators;
  for (const auto& one : options["actuators"].cast<std::vector<py::dict>>()) {
    actuators.push_back(read_actuator(one));
  }
  return actuators;
}

std::vector<Sensor> read_sensors(const py::dict& options) {
  std::vector<Sensor> sensors;
  for (const auto& one : options["sensors"].cast<std::vector<py::dict>>()) {
    sensors.push_back(read_sensor(one));
  }
  return sensors;
}

}  // namespace cdcr::python
