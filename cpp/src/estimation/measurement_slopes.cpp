#include "estimation/measurement_slopes.hpp"

#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"
#include "control/measurement.hpp"

namespace cdcr::detail {
namespace {

// Step of the difference of B along qd, as a motion of the fastest coordinate [rad].
constexpr double difference = 1e-5;

}  // namespace

MeasurementSlopes::MeasurementSlopes(AugmentedMotion& motion, const Sensor& sensor)
    : motion_(&motion), sensor_(sensor) {
  const Index d = model().num_coordinates(), size = measurement_size(model(), sensor);
  value_ = error_ = VectorXd::Zero(size);
  error_.setConstant(sensor.bias);
  near_ = VectorXd::Zero(d);
  point_ = VectorXd::Zero(motion.size());
  on_base_ = VectorXd::Zero(6);
  slopes_ = MatrixXd::Zero(size, motion.size());
  J_ = MatrixXd::Zero(6, d);
  B_ = change_ = model().actuation_matrix();
  if (sensor.kind == Sensor::Kind::coordinates) slopes_.leftCols(d).setIdentity();
  if (sensor.kind == Sensor::Kind::rates) slopes_.middleCols(d, d).setIdentity();
  if (sensor.kind == Sensor::Kind::curvature) set_curvature_slopes();
  if (sensor.feels_base()) motion.make_room_for_base_wrench();
}

void MeasurementSlopes::set_curvature_slopes() noexcept {
  for (Index i = 0; i < slopes_.rows(); ++i) {
    const Place& place = sensor_.places[static_cast<std::size_t>(i / 2)];
    const Section& section = model().robot().sections[static_cast<std::size_t>(place.section)];
    const Index first = model().first_coordinate(place.section) + i % 2;
    legendre_at(place.fraction, section.bending_order, [&](int j, double legendre) {
      slopes_(i, first + Index{2} * j) = legendre / section.length;
    });
  }
}

/// Of lengths, and of tensions where these are pulls of springs, k (l - l_commanded) + d dl/dt.
void MeasurementSlopes::set_cable_slopes(const ConstVectorRef& q, const ConstVectorRef& qd,
                                         const ConstVectorRef& command) noexcept {
  const Index d = q.size();
  if (!model().has_constant_actuation()) actuation_matrix(model(), q, B_);
  if (sensor_.kind == Sensor::Kind::lengths) {
    slopes_.leftCols(d) = -B_.transpose();  // dl/dq = -B^T, eq. (6)
    return;
  }
  // d(dl/dt)/dq = d^2l/dq^2 qd, the change of dl/dq along qd.
  const double fastest = qd.lpNorm<Eigen::Infinity>();
  change_.setZero();
  if (!model().has_constant_actuation() && fastest > 0.0) {
    const double step = difference / fastest;
    for (const double side : {1.0, -1.0}) {
      near_ = q + side * step * qd;
      actuation_matrix(model(), near_, B_);
      change_ += (side / (2.0 * step)) * B_;
    }
    actuation_matrix(model(), q, B_);
  }
  slopes_.setZero();
  for (Index j = 0; j < slopes_.rows(); ++j) {
    const Cable& cable = model().cables()[static_cast<std::size_t>(j)];
    if (!cable.length_driven() || cable_pull(model(), j, q, qd, command[j]) <= 0.0) continue;
    slopes_.row(j).head(d) =
        -cable.stiffness * B_.col(j).transpose() - cable.damping * change_.col(j).transpose();
    slopes_.row(j).segment(d, d) = -cable.damping * B_.col(j).transpose();
  }
}

/// With on_base_ as it is.
void MeasurementSlopes::set_value(const VectorXd& x, const VectorXd& command) noexcept {
  const Index d = model().num_coordinates();
  measure(model(), sensor_, x.head(d), x.segment(d, d), command, on_base_, value_);
  add_error(sensor_.kind, error_, value_);
}

void MeasurementSlopes::update_value(const VectorXd& x, const VectorXd& command) noexcept {
  if (sensor_.feels_base()) motion_->base_wrench(x, command, on_base_);
  set_value(x, command);
}

void MeasurementSlopes::update(const VectorXd& x, const VectorXd& command) noexcept {
  point_ = x;
  if (sensor_.feels_base()) {
    const FeltBase& felt = motion_->felt_base(x, command);
    point_ = felt.x;
    on_base_ = felt.wrench;
    slopes_ = felt.slopes.middleRows<3>(sensor_.kind == Sensor::Kind::base_force ? 0 : 3);
  }
  set_value(point_, command);
  const Index d = model().num_coordinates();
  const auto q = x.head(d);
  switch (sensor_.kind) {
    case Sensor::Kind::lengths:
    case Sensor::Kind::tensions:
      return set_cable_slopes(q, x.segment(d, d), command);
    case Sensor::Kind::tip:
      tip_jacobian(model(), q, J_);
      slopes_.leftCols(d) = J_.topRows<3>();
      return;
    case Sensor::Kind::orientation: {
      tip_jacobian(model(), q, J_);
      const Matrix3d R = tip(model(), q).R;
      slopes_.leftCols(d).noalias() = R.transpose() * J_.bottomRows<3>();
      return;
    }
    default:
      return;  // constant, or of the base
  }
}

}  // namespace cdcr::detail
