#include "chain.hpp"

#include <Eigen/LU>
#include <cmath>

#include "chain_forward.hpp"
#include "chain_functions.hpp"
#include "chain_inverse.hpp"

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
    : payload(payload_of(robot)), root(robot.base_orientation), gravity(robot.gravity) {
  for (const Section& s : robot.sections) {
    double mass = s.backbone_mass;
    for (const Disk& disk : s.disks()) mass += disk.mass;
    std::shared_ptr<const BodyTable> table;
    for (std::size_t i = 0; i < bodies.size() && !table; ++i) {
      if (moves_alike(robot.sections[i], s)) table = bodies[i].table;
    }
    if (!table) table = std::make_shared<const BodyTable>(body_table(s));
    bodies.push_back({table, &arc_table(), s.length, mass, s.stiffness(), s.damping});
  }
}

void forward_motion(const Chain& chain, const double* q, const double* qd, const double* force,
                    double* qdd) noexcept {
  forward_dynamics(chain, q, qd, force, qdd);
}

void inverse_motion(const Chain& chain, const double* q, const double* qd, const double* qdd,
                    double* force) noexcept {
  inverse_dynamics(chain, q, qd, qdd, force);
}

void mass_matrix(const Chain& chain, const double* q, MatrixRef M) noexcept {
  const auto n = static_cast<Index>(chain.bodies.size());
  Link<double> links[max_sections];
  Mount<double> mount = root_of<double>(chain);
  for (Index i = 0; i < n; ++i) {
    links[i].place(chain.bodies[i], mount, q[2 * i], q[2 * i + 1]);
    mount = links[i].tip();
  }
  Articulated<double> beyond = articulated_payload(chain.payload, mount);
  for (Index i = n - 1; i >= 0; --i) {
    const Link<double>& link = links[i];
    // What moves beyond this tip as one piece, and what it takes to move it with q.
    Matrix32<double> F = beyond.G.transpose() * link.W + beyond.M * link.D;
    Matrix32<double> T = beyond.J * link.W + beyond.G * link.D;
    const Vector3d own = link.own_mass();
    const Eigen::Matrix2d tip = link.W.transpose() * T + link.D.transpose() * F;
    M(2 * i, 2 * i) = own[0] + tip(0, 0);
    M(2 * i, 2 * i + 1) = M(2 * i + 1, 2 * i) = own[1] + tip(0, 1);
    M(2 * i + 1, 2 * i + 1) = own[2] + tip(1, 1);
    for (int k = 0; k < 2; ++k) T.col(k) += link.r.cross(F.col(k));
    F += link.linear_coupling();
    T += link.angular_coupling();
    for (Index j = i - 1; j >= 0; --j) {
      const Link<double>& before = links[j];
      M.block<2, 2>(2 * j, 2 * i) = before.W.transpose() * T + before.D.transpose() * F;
      M.block<2, 2>(2 * i, 2 * j) = M.block<2, 2>(2 * j, 2 * i).transpose();
      for (int k = 0; k < 2; ++k) T.col(k) += before.r.cross(F.col(k));
    }
    shift(beyond, link.r);
    add_link(beyond, chain.bodies[i].mass, link);
  }
}

Index find_singular_section(const Chain& chain) {
  const auto n = static_cast<Index>(chain.bodies.size());
  const VectorXd straight = VectorXd::Zero(2 * n);
  MatrixXd M(2 * n, 2 * n);
  mass_matrix(chain, straight.data(), M);
  const VectorXd whole = M.diagonal();
  for (Index i = n - 1; i >= 0; --i) {  // eliminates the sections from tip to base
    const Eigen::Matrix2d D = M.block<2, 2>(2 * i, 2 * i);
    const double smallest = 0.5 * D.trace() - std::hypot(0.5 * (D(0, 0) - D(1, 1)), D(0, 1));
    if (!(smallest > singular_share * whole.segment<2>(2 * i).maxCoeff())) return i;
    const MatrixXd coupling = M.block(0, 2 * i, 2 * i, 2);
    M.topLeftCorner(2 * i, 2 * i) -= coupling * D.inverse() * coupling.transpose();
  }
  return -1;
}

double kinetic_energy(const Chain& chain, const double* q, const double* qd) noexcept {
  const auto n = static_cast<Index>(chain.bodies.size());
  Mount<double> mount = root_of<double>(chain);
  Vector3d v = Vector3d::Zero();
  double twice = 0.0;
  for (Index i = 0; i < n; ++i) {
    Link<double> link;
    link.place(chain.bodies[i], mount, q[2 * i], q[2 * i + 1]);
    link.qd_x = qd[2 * i];
    link.qd_y = qd[2 * i + 1];
    const Eigen::Vector2d rate(link.qd_x, link.qd_y);
    const Vector3d& omega = mount.omega;
    const Vector3d h_rate = omega.cross(link.first_moment()) + link.linear_coupling() * rate;
    const Vector3d own = link.own_mass();
    twice += chain.bodies[i].mass * v.squaredNorm() + 2.0 * v.dot(h_rate) +
             omega.dot(link.second_moment() * omega) +
             2.0 * omega.dot(link.angular_coupling() * rate) + own[0] * rate[0] * rate[0] +
             2.0 * own[1] * rate[0] * rate[1] + own[2] * rate[1] * rate[1];
    v += omega.cross(link.r) + link.D * rate;
    mount = link.tip();
  }
  const Articulated<double> payload = articulated_payload(chain.payload, mount);
  twice += v.dot(payload.M * v) + 2.0 * mount.omega.dot(payload.G * v) +
           mount.omega.dot(payload.J * mount.omega);
  return 0.5 * twice;
}

double potential_energy(const Chain& chain, const double* q) noexcept {
  Mount<double> mount = root_of<double>(chain);
  Vector3d p = Vector3d::Zero();
  double U = 0.0;
  for (std::size_t i = 0; i < chain.bodies.size(); ++i) {
    const Body& body = chain.bodies[i];
    Link<double> link;
    link.place(body, mount, q[2 * i], q[2 * i + 1]);
    U += 0.5 * body.stiffness * link.q.squaredNorm() -
         chain.gravity.dot(body.mass * p + link.first_moment());
    p += link.r;
    mount = link.tip();
  }
  Matrix3d R;
  R << mount.x, mount.y, mount.z;
  return U - chain.payload.mass * chain.gravity.dot(p + R * chain.payload.position);
}

}  // namespace cdcr::detail
