#include "chain/chain.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "base/eigenvalues.hpp"
#include "chain/functions.hpp"

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

SectionParameters arc_parameters(const Section& s, std::shared_ptr<const SectionTable> table) {
  double mass = s.backbone_mass;
  for (const Disk& disk : s.disks()) mass += disk.mass;
  const double stiffness = s.stiffness();
  return {std::move(table), &arc_table(),
          s.length,         mass,
          stiffness,        s.damping + s.material_damping * stiffness};
}

SectionParameters rod_parameters(const Section& s) {
  auto rod = std::make_shared<const RodParameters>(described(s));
  const double mass = rod->mass, stiffness = s.stiffness();
  return {nullptr, &arc_table(), s.length, mass, stiffness, s.damping, std::move(rod)};
}

}  // namespace

bool moves_alike(const Section& a, const Section& b) {
  return a.length == b.length && a.backbone_mass == b.backbone_mass &&
         a.backbone_diameter == b.backbone_diameter &&
         a.backbone_inner_diameter == b.backbone_inner_diameter && a.num_disks == b.num_disks &&
         a.disk_mass == b.disk_mass && a.disk_diameter == b.disk_diameter &&
         a.disk_positions == b.disk_positions && a.disk_masses == b.disk_masses &&
         a.disk_diameters == b.disk_diameters;
}

Chain::Chain(const Robot& robot, const KnownTables& known)
    : first{0}, payload(payload_of(robot)), root(robot.base_orientation), gravity(robot.gravity) {
  const bool rods = robot.has_rods();
  for (const Section& s : robot.sections) {
    if (rods) {
      sections.push_back(rod_parameters(s));
      first.push_back(first.back() + sections.back().rod->size());
      continue;
    }
    std::shared_ptr<const SectionTable> table;
    const auto look_in = [&](const std::vector<Section>& there, const Chain& chain) {
      const std::size_t count = std::min(there.size(), chain.sections.size());
      for (std::size_t i = 0; i < count && !table; ++i) {
        if (moves_alike(there[i], s)) table = chain.sections[i].table;
      }
    };
    look_in(robot.sections, *this);
    if (known.chain != nullptr) look_in(*known.sections, *known.chain);
    if (!table) table = std::make_shared<const SectionTable>(section_table(s));
    sections.push_back(arc_parameters(s, std::move(table)));
    first.push_back(first.back() + ConstantCurvature<double>::m);
  }
}

Index find_singular_section(const Chain& chain) {
  const Index n = chain.num_sections(), m = chain.num_coordinates();
  const VectorXd straight = VectorXd::Zero(m);
  MatrixXd M(m, m);
  if (chain.has_rods()) {
    RodMotionState state(chain);
    state.update_position(chain, straight.data());
    mass_matrix(chain, state, M);
  } else {
    const auto state = std::make_unique<MotionState>();
    state->update_position(chain, straight.data());
    mass_matrix(chain, *state, M);
  }
  const VectorXd size = M.diagonal().cwiseSqrt();
  for (Index i = n - 1; i >= 0; --i) {  // eliminates the sections from tip to base
    const Index at = chain.first[i], m_i = chain.first[i + 1] - at;
    if (m_i == 0) continue;
    const MatrixXd D = M.block(at, at, m_i, m_i);
    const auto scale = size.segment(at, m_i).cwiseInverse().asDiagonal();
    const MatrixXd relative = scale * D * scale;
    if (!relative.allFinite()) return i;
    if (!(symmetric_eigenvalues(relative)[0] > singular_share)) return i;
    const MatrixXd coupling = M.block(0, at, at, m_i);
    if (at > 0) M.topLeftCorner(at, at) -= coupling * D.llt().solve(coupling.transpose());
  }
  return -1;
}

}  // namespace cdcr::detail
