#include "control/measurement.hpp"

#include <cmath>

#include "base/rotation.hpp"
#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"

namespace cdcr::detail {
namespace {

/// The bending there over the length, cpp/rods.md eq. (51).
double curvature(const Model& model, const Place& place, const ConstVectorRef& q,
                 Index axis) noexcept {
  const Section& section = model.robot().sections[static_cast<std::size_t>(place.section)];
  const Index first = model.first_coordinate(place.section) + axis;
  double sum = 0.0;
  legendre_at(place.fraction, section.bending_order,
              [&](int j, double legendre) { sum += legendre * q[first + Index{2} * j]; });
  return sum / section.length;
}

}  // namespace

Index measurement_size(const Model& model, const Sensor& sensor) {
  switch (sensor.kind) {
    case Sensor::Kind::lengths:
    case Sensor::Kind::tensions:
      return model.num_cables();
    case Sensor::Kind::tip:
    case Sensor::Kind::orientation:
    case Sensor::Kind::base_force:
    case Sensor::Kind::base_moment:
      return 3;
    case Sensor::Kind::curvature:
      return 2 * static_cast<Index>(sensor.places.size());
    default:
      return model.num_coordinates();
  }
}

void require_sensor(const Model& model, const Sensor& sensor, const std::string& name) {
  require_not_negative(("noise of " + name).c_str(), sensor.noise, "in the unit of its values");
  require(std::isfinite(sensor.bias), "bias of ", name, " must be finite, got ", sensor.bias);
  require(sensor.kind != Sensor::Kind::curvature || !sensor.places.empty(), name,
          ", of curvature, needs places");
  if (sensor.feels_base()) require_inertia(model);
  for (const Place& place : sensor.places) {
    require(is_section(model, place.section) && is_fraction(place.fraction), "places of ", name,
            " must be sections 0 to ", model.num_sections() - 1,
            " and fractions 0 to 1, got section ", place.section, " and fraction ", place.fraction);
  }
}

void measure(const Model& model, const Sensor& sensor, const ConstVectorRef& q,
             const ConstVectorRef& qd, const ConstVectorRef& command, const ConstVectorRef& on_base,
             VectorRef out) noexcept {
  switch (sensor.kind) {
    case Sensor::Kind::coordinates:
      out = q;
      return;
    case Sensor::Kind::rates:
      out = qd;
      return;
    case Sensor::Kind::lengths:
      cable_lengths(model, q, out);
      return;
    case Sensor::Kind::tensions:
      cable_tensions(model, q, qd, command, out);
      return;
    case Sensor::Kind::tip:
      out = tip(model, q).p;
      return;
    case Sensor::Kind::orientation:
      out = rotation_vector(tip(model, q).R);
      return;
    case Sensor::Kind::base_force:
      assert(has_size(on_base, 6, 1));
      out = on_base.head<3>();
      return;
    case Sensor::Kind::base_moment:
      assert(has_size(on_base, 6, 1));
      out = on_base.tail<3>();
      return;
    case Sensor::Kind::curvature:
      for (Index i = 0; i < out.size(); ++i) {
        out[i] = curvature(model, sensor.places[static_cast<std::size_t>(i / 2)], q, i % 2);
      }
      return;
  }
}

void add_error(Sensor::Kind kind, const ConstVectorRef& error, VectorRef value) noexcept {
  if (kind == Sensor::Kind::orientation) {
    const Matrix3d R = rotation_of(value), turn = rotation_of(error);
    value = rotation_vector(R * turn);
  } else {
    value += error;
  }
}

void find_error(Sensor::Kind kind, const ConstVectorRef& told, const ConstVectorRef& expected,
                VectorRef error) noexcept {
  if (kind == Sensor::Kind::orientation) {
    const Matrix3d R = rotation_of(expected), to = rotation_of(told);
    error = rotation_vector(R.transpose() * to);
  } else {
    error = told - expected;
  }
}

}  // namespace cdcr::detail
