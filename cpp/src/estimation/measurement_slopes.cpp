#include "estimation/measurement_slopes.hpp"

#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"
#include "control/measurement.hpp"

namespace cdcr::detail {
namespace {

// Step of the difference of B along qd, as a motion of the fastest coordinate [rad].
constexpr double difference = 1e-5;

}  // namespace

MeasurementSlopes::MeasurementSlopes(const Model& model, const Sensor& sensor)
    : model_(model), sensor_(sensor) {
  require_sensor(model, sensor);
  const Index d = model.num_coordinates(), size = measurement_size(model, sensor);
  value_ = error_ = VectorXd::Zero(size);
  error_.setConstant(sensor.bias);
  near_ = VectorXd::Zero(d);
  slopes_ = MatrixXd::Zero(size, 2 * d);
  J_ = MatrixXd::Zero(6, d);
  B_ = change_ = model.actuation_matrix();
  if (sensor.kind == Sensor::Kind::coordinates) slopes_.leftCols(d).setIdentity();
  if (sensor.kind == Sensor::Kind::rates) slopes_.rightCols(d).setIdentity();
  if (sensor.kind == Sensor::Kind::curvature) set_curvature_slopes();
}

void MeasurementSlopes::set_curvature_slopes() noexcept {
  for (Index i = 0; i < slopes_.rows(); ++i) {
    const Place& place = sensor_.places[static_cast<std::size_t>(i / 2)];
    const Section& section = model_.robot().sections[static_cast<std::size_t>(place.section)];
    const Index first = model_.first_coordinate(place.section) + i % 2;
    legendre_at(place.fraction, section.bending_order, [&](int j, double legendre) {
      slopes_(i, first + Index{2} * j) = legendre / section.length;
    });
  }
}

/// Of lengths, and of tensions where these are pulls of springs, k (l - l_commanded) + d dl/dt.
void MeasurementSlopes::set_cable_slopes(const ConstVectorRef& q, const ConstVectorRef& qd,
                                         const ConstVectorRef& command) noexcept {
  const Index d = q.size();
  if (!model_.has_constant_actuation()) actuation_matrix(model_, q, B_);
  if (sensor_.kind == Sensor::Kind::lengths) {
    slopes_.leftCols(d) = -B_.transpose();  // dl/dq = -B^T, eq. (6)
    return;
  }
  // d(dl/dt)/dq = d^2l/dq^2 qd, the change of dl/dq along qd.
  const double fastest = qd.lpNorm<Eigen::Infinity>();
  change_.setZero();
  if (!model_.has_constant_actuation() && fastest > 0.0) {
    const double step = difference / fastest;
    for (const double side : {1.0, -1.0}) {
      near_ = q + side * step * qd;
      actuation_matrix(model_, near_, B_);
      change_ += (side / (2.0 * step)) * B_;
    }
    actuation_matrix(model_, q, B_);
  }
  slopes_.setZero();
  for (Index j = 0; j < slopes_.rows(); ++j) {
    const Cable& cable = model_.cables()[static_cast<std::size_t>(j)];
    if (!cable.length_driven() || cable_pull(model_, j, q, qd, command[j]) <= 0.0) continue;
    slopes_.row(j).head(d) =
        -cable.stiffness * B_.col(j).transpose() - cable.damping * change_.col(j).transpose();
    slopes_.row(j).tail(d) = -cable.damping * B_.col(j).transpose();
  }
}

void MeasurementSlopes::update_value(const ConstVectorRef& q, const ConstVectorRef& qd,
                                     const ConstVectorRef& command) noexcept {
  measure(model_, sensor_, q, qd, command, value_);
  add_error(sensor_.kind, error_, value_);
}

void MeasurementSlopes::update(const ConstVectorRef& q, const ConstVectorRef& qd,
                               const ConstVectorRef& command) noexcept {
  update_value(q, qd, command);
  switch (sensor_.kind) {
    case Sensor::Kind::lengths:
    case Sensor::Kind::tensions:
      return set_cable_slopes(q, qd, command);
    case Sensor::Kind::tip:
      tip_jacobian(model_, q, J_);
      slopes_.leftCols(q.size()) = J_.topRows<3>();
      return;
    case Sensor::Kind::orientation: {
      tip_jacobian(model_, q, J_);
      const Matrix3d R = tip(model_, q).R;
      slopes_.leftCols(q.size()).noalias() = R.transpose() * J_.bottomRows<3>();
      return;
    }
    default:
      return;  // constant
  }
}

}  // namespace cdcr::detail
