// A program for this machine's processor alone, against a library for any: what one of them
// allocates the other resizes and frees, and both use all of Eigen.
#include <Eigen/Dense>
#include <cdcr/cdcr.hpp>
#include <cmath>
#include <cstdio>

namespace {

cdcr::Robot robot(int sections, int bending_order) {
  cdcr::Robot arm = cdcr::amouri2020();
  arm.gravity << 0.0, 0.0, -9.81;
  cdcr::Section section = arm.sections[0];
  section.length /= sections;
  section.bending_order = bending_order;
  arm.sections.assign(static_cast<std::size_t>(sections), section);
  return arm;
}

/// Largest residual of what the library promises, with matrices that go to and fro.
double residual(const cdcr::Model& model) {
  using cdcr::MatrixXd;
  using cdcr::VectorXd;
  const Eigen::Index d = model.num_coordinates(), c = model.num_cables();
  const VectorXd tension = VectorXd::LinSpaced(c, 0.0, 2.0), zero = VectorXd::Zero(d);
  cdcr::Data data(model);

  cdcr::Equilibrium rest = cdcr::equilibrium(model, tension);
  VectorXd qdd(d);
  cdcr::forward_dynamics(model, data, rest.q, zero, tension, qdd);
  double worst = rest.status == cdcr::Status::ok ? qdd.norm() : 1.0;

  MatrixXd M(d, d), A(2 * d, 2 * d), B(2 * d, c);
  cdcr::mass_matrix(model, data, rest.q, M);
  cdcr::linearize(model, data, rest.q, zero, tension, A, B);
  const MatrixXd by_tension = M.llt().solve(model.actuation_matrix());
  worst = std::fmax(worst, (B.bottomRows(d) - by_tension).norm() / by_tension.norm());

  cdcr::Trajectory run = cdcr::simulate(model, zero, zero, VectorXd::LinSpaced(20, 0.0, 0.05),
                                        cdcr::CommandInput::constant(tension));
  const Eigen::Index samples = run.q.rows();
  run.q.conservativeResize(samples + 100, Eigen::NoChange);
  run.q.bottomRows(100).setOnes();
  rest.q.conservativeResize(d + 7);
  const MatrixXd large = MatrixXd::Random(150, 150) + 150.0 * MatrixXd::Identity(150, 150);
  const MatrixXd inverse = large.partialPivLu().inverse();
  worst = std::fmax(worst, (large * inverse - MatrixXd::Identity(150, 150)).norm());
  return run.status == cdcr::Status::ok ? worst : 1.0;
}

}  // namespace

int main() {
  const double arcs = residual(cdcr::Model(robot(8, 0))), rods = residual(cdcr::Model(robot(2, 2)));
  std::printf("residuals: %.1e of arcs, %.1e of rods\n", arcs, rods);
  return arcs < 1e-5 && rods < 1e-5 ? 0 : 1;
}
