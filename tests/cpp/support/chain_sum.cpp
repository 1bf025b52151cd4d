#include "chain_sum.hpp"

#include <cmath>

namespace cdcr::test {
namespace {

constexpr Real pi = 3.141592653589793238462643383279502884L;

/// Turning rate in the base frame from the rate of a rotation and the rotation.
Real3 turning_rate(const Real33& rate, const Real33& R) {
  const Real33 w = rate * R.transpose();
  return 0.5L * Real3(w(2, 1) - w(1, 2), w(0, 2) - w(2, 0), w(1, 0) - w(0, 1));
}

/// Sum over the sections of |qd_i|: nothing turns faster.
Real speed_of(const RealVector& qd) {
  Real sum = 0.0L;
  for (Index i = 0; i < qd.size(); i += 2) sum += std::hypot(qd[i], qd[i + 1]);
  return sum;
}

/// Derivative of f along qd, in steps that turn the tip by 0.02 rad at most: wide enough that
/// differences of differences, which feel rounding twice, are as exact as single ones.
template <class Value, class Function>
Value along(const RealVector& q, const RealVector& qd, const Function& f) {
  const Real speed = speed_of(qd);
  const Real scale = speed > 0.0L ? speed : 1.0L;
  const RealVector direction = qd / scale;
  const Value slope =
      derivative<Value>([&](Real step) -> Value { return f(q + step * direction); }, 0.02L);
  return slope * scale;
}

}  // namespace

ChainSum::ChainSum(const Robot& robot)
    : gravity_(robot.gravity.cast<Real>()), base_(robot.base_orientation.cast<Real>()) {
  const auto n = static_cast<Index>(robot.sections.size());
  stiffness_.resize(2 * n);
  damping_.resize(2 * n);
  for (Index i = 0; i < n; ++i) {
    const Section& s = robot.sections[static_cast<std::size_t>(i)];
    length_.push_back(s.length);
    const Real d = s.backbone_diameter;
    const Real K = static_cast<Real>(s.youngs_modulus) * pi * d * d * d * d / 64.0L / s.length;
    stiffness_.segment(2 * i, 2).setConstant(K);
    damping_.segment(2 * i, 2).setConstant(s.damping);
    for (int k = 0; k < num_gauss; ++k) {
      add(i, gauss().node[k], gauss().weight[k] * s.backbone_mass, d);
    }
    for (const Disk& disk : s.disks()) add(i, disk.position, disk.mass, disk.diameter);
  }
  elements_.push_back({n - 1, 1.0L, robot.payload, robot.payload_position.cast<Real>(),
                       robot.payload_inertia.cast<Real>()});
}

void ChainSum::add(Index section, Real fraction, Real mass, Real diameter) {
  if (mass == 0.0L) return;
  const Real transverse = mass * diameter * diameter / 16.0L;
  const Real33 inertia = Real3(transverse, transverse, 2.0L * transverse).asDiagonal();
  elements_.push_back({section, fraction, mass, Real3::Zero(), inertia});
}

std::vector<Frame> ChainSum::section_bases(const RealVector& q) const {
  std::vector<Frame> bases = {{Real3::Zero(), base_}};
  for (std::size_t i = 0; i + 1 < length_.size(); ++i) {
    bases.push_back(frame_from(bases, q, static_cast<Index>(i), 1.0L));
  }
  return bases;
}

Frame ChainSum::frame_from(const std::vector<Frame>& bases, const RealVector& q, Index section,
                           Real fraction) const {
  const auto i = static_cast<std::size_t>(section);
  const Frame local = frame_at(length_[i], fraction, q.segment<2>(2 * section));
  return {bases[i].r + bases[i].R * local.r, bases[i].R * local.R};
}

Frame ChainSum::frame(const RealVector& q, Index section, Real fraction) const {
  return frame_from(section_bases(q), q, section, fraction);
}

ChainSum::Poses ChainSum::poses(const RealVector& q) const {
  const std::vector<Frame> bases = section_bases(q);
  Poses all(3, 4 * static_cast<Index>(elements_.size()));
  Index column = 0;
  for (const Element& e : elements_) {
    const Frame at = frame_from(bases, q, e.section, e.fraction);
    all.col(column) = at.r + at.R * e.offset;
    all.middleCols<3>(column + 1) = at.R;
    column += 4;
  }
  return all;
}

/// One column for each element: velocity of its centre of mass, turning rate in its own frame.
RealMatrix6 ChainSum::twists(const RealVector& q, const RealVector& qd) const {
  const Poses at = poses(q);
  const Poses rates = along<Poses>(q, qd, [&](const RealVector& moved) { return poses(moved); });
  RealMatrix6 all(6, static_cast<Index>(elements_.size()));
  for (Index e = 0; e < all.cols(); ++e) {
    const Real33 R = at.middleCols<3>(4 * e + 1);
    all.col(e).head<3>() = rates.col(4 * e);
    all.col(e).tail<3>() = R.transpose() * turning_rate(rates.middleCols<3>(4 * e + 1), R);
  }
  return all;
}

RealMatrix6 ChainSum::momenta(const RealMatrix6& twists) const {
  RealMatrix6 all(6, twists.cols());
  for (Index e = 0; e < all.cols(); ++e) {
    const Element& element = elements_[static_cast<std::size_t>(e)];
    all.col(e).head<3>() = element.mass * twists.col(e).head<3>();
    all.col(e).tail<3>() = element.inertia * twists.col(e).tail<3>();
  }
  return all;
}

RealMatrix ChainSum::mass_matrix(const RealVector& q) const {
  std::vector<RealMatrix6> units;
  for (Index k = 0; k < q.size(); ++k) units.push_back(twists(q, RealVector::Unit(q.size(), k)));
  RealMatrix M(q.size(), q.size());
  for (Index k = 0; k < q.size(); ++k) {
    const RealMatrix6 carried = momenta(units[static_cast<std::size_t>(k)]);
    for (Index j = 0; j < q.size(); ++j) {
      M(j, k) = units[static_cast<std::size_t>(j)].cwiseProduct(carried).sum();
    }
  }
  return M;
}

Real ChainSum::kinetic_energy(const RealVector& q, const RealVector& qd) const {
  const RealMatrix6 moving = twists(q, qd);
  return 0.5L * moving.cwiseProduct(momenta(moving)).sum();
}

/// dT/dqd.
RealVector ChainSum::momentum(const RealVector& q, const RealVector& qd) const {
  const RealMatrix6 carried = momenta(twists(q, qd));
  RealVector p(q.size());
  for (Index k = 0; k < q.size(); ++k) {
    p[k] = twists(q, RealVector::Unit(q.size(), k)).cwiseProduct(carried).sum();
  }
  return p;
}

Real ChainSum::potential_energy(const RealVector& q) const {
  Real U = 0.5L * q.dot(stiffness_.cwiseProduct(q));
  const Poses at = poses(q);
  Index column = 0;
  for (const Element& e : elements_) {
    U -= e.mass * gravity_.dot(at.col(column));
    column += 4;
  }
  return U;
}

/// Elastic forces less the work of gravity on each element.
RealVector ChainSum::potential_gradient(const RealVector& q) const {
  RealVector slopes = stiffness_.cwiseProduct(q);
  for (Index k = 0; k < q.size(); ++k) {
    const RealMatrix6 moving = twists(q, RealVector::Unit(q.size(), k));
    Index column = 0;
    for (const Element& e : elements_) {
      slopes[k] -= e.mass * gravity_.dot(moving.col(column++).head<3>());
    }
  }
  return slopes;
}

RealVector ChainSum::bias(const RealVector& q, const RealVector& qd) const {
  const RealVector momentum_rate = along<RealVector>(
      q, qd, [&](const RealVector& moved) -> RealVector { return momentum(moved, qd); });
  RealVector h = momentum_rate + potential_gradient(q) + damping_.cwiseProduct(qd);
  for (Index k = 0; k < q.size(); ++k) {
    h[k] -= along<Real>(q, RealVector::Unit(q.size(), k),
                        [&](const RealVector& moved) { return kinetic_energy(moved, qd); });
  }
  return h;
}

RealVector ChainSum::wrench_force(const RealVector& q, const Wrench& wrench) const {
  const Frame at = frame(q, wrench.section, wrench.fraction);
  const bool local = wrench.frame == Wrench::Frame::local;
  const Real33 turn = local ? at.R : Real33::Identity();
  const Real3 force = turn * wrench.force.cast<Real>(), moment = turn * wrench.moment.cast<Real>();
  RealVector work(q.size());
  for (Index k = 0; k < q.size(); ++k) {
    using Stacked = Eigen::Matrix<Real, 3, 4>;
    const auto stacked = [&](const RealVector& moved) {
      const Frame f = frame(moved, wrench.section, wrench.fraction);
      return (Stacked() << f.r, f.R).finished();
    };
    const Stacked rate = along<Stacked>(q, RealVector::Unit(q.size(), k), stacked);
    work[k] = force.dot(rate.col(0)) + moment.dot(turning_rate(rate.rightCols<3>(), at.R));
  }
  return work;
}

RealVector ChainSum::weight_scale() const {
  const auto n = static_cast<Index>(length_.size());
  RealVector scale = RealVector::Zero(2 * n);
  for (const Element& e : elements_) {
    Real arm = e.offset.norm();
    for (Index i = e.section; i >= 0; --i) {
      arm += length_[static_cast<std::size_t>(i)];
      scale.segment(2 * i, 2).array() += e.mass * gravity_.norm() * arm;
    }
  }
  return scale;
}

}  // namespace cdcr::test
