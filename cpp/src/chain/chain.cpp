#include "chain/chain.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "chain/energy.hpp"
#include "chain/forward.hpp"
#include "chain/functions.hpp"
#include "chain/gradient.hpp"
#include "chain/inverse.hpp"
#include "chain/mass_matrix.hpp"

namespace cdcr::detail {
namespace {

// A mass this small beside that of the robot beyond is zero but for rounding.
constexpr double singular_share = 1e-12;

Payload payload_of(const Robot& robot) {
  const Vector3d& c = robot.payload_position;
  const Matrix3d about_tip =
      robot.payload_inertia +
      robot.payload * (c.squaredNorm() * Matrix3d::Identity() - c * c.transpose());
  return {robot.payload, c, about_tip};
}

/// Whether two sections have the same inertia: then they share a table.
bool moves_alike(const Section& a, const Section& b) {
  return a.length == b.length && a.backbone_mass == b.backbone_mass &&
         a.backbone_diameter == b.backbone_diameter && a.num_disks == b.num_disks &&
         a.disk_mass == b.disk_mass && a.disk_diameter == b.disk_diameter &&
         a.disk_positions == b.disk_positions && a.disk_masses == b.disk_masses &&
         a.disk_diameters == b.disk_diameters;
}

}  // namespace

Chain::Chain(const Robot& robot)
    : first{0}, payload(payload_of(robot)), root(robot.base_orientation), gravity(robot.gravity) {
  for (const Section& s : robot.sections) {
    double mass = s.backbone_mass;
    for (const Disk& disk : s.disks()) mass += disk.mass;
    std::shared_ptr<const SectionTable> table;
    for (std::size_t i = 0; i < sections.size() && !table; ++i) {
      if (moves_alike(robot.sections[i], s)) table = sections[i].table;
    }
    if (!table) table = std::make_shared<const SectionTable>(section_table(s));
    sections.push_back({table, &arc_table(), s.length, mass, s.stiffness(), s.damping});
    first.push_back(first.back() + ConstantCurvature<double>::m);
  }
}

void forward_motion(const Chain& chain, const MotionState& state, const double* force,
                    double* qdd) noexcept {
  forward_dynamics(chain, state, force, qdd);
}

void inverse_motion(const Chain& chain, const MotionState& state, const double* qdd,
                    double* force) noexcept {
  inverse_dynamics(chain, state, qdd, force);
}

void mass_matrix(const Chain& chain, const MotionState& state, MatrixRef M) noexcept {
  composite_mass(chain, state, M);
}

Index find_singular_section(const Chain& chain) {
  const Index n = chain.num_sections(), m = chain.num_coordinates();
  const VectorXd straight = VectorXd::Zero(m);
  const auto state = std::make_unique<MotionState>();
  state->update_position(chain, straight.data());
  MatrixXd M(m, m);
  mass_matrix(chain, *state, M);
  const VectorXd whole = M.diagonal();
  for (Index i = n - 1; i >= 0; --i) {  // eliminates the sections from tip to base
    const Index at = chain.first[i], size = chain.first[i + 1] - at;
    const MatrixXd D = M.block(at, at, size, size);
    const double smallest =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(D, Eigen::EigenvaluesOnly).eigenvalues()[0];
    if (!(smallest > singular_share * whole.segment(at, size).maxCoeff())) return i;
    const MatrixXd coupling = M.block(0, at, at, size);
    M.topLeftCorner(at, at) -= coupling * D.inverse() * coupling.transpose();
  }
  return -1;
}

double kinetic_energy(const Chain& chain, const MotionState& state, const double* qd) noexcept {
  return kinetic_energy_of(chain, state, qd);
}

double potential_energy(const Chain& chain, const MotionState& state, const double* q) noexcept {
  return potential_energy_of(chain, state, q);
}

void potential_gradient(const Chain& chain, const MotionState& state, const double* q,
                        double* gradient) noexcept {
  potential_gradient<ConstantCurvature<double>>(chain, state, q, gradient);
}

}  // namespace cdcr::detail
