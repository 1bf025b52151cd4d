// cdcr_soak SECONDS: runs of a thousand periods, equilibria, inverse kinematics and allocations of
// random robots for so long, each against a residual that shares nothing with what is tested: the
// plain list of rigid elements in extended precision (tests/cpp/support/chain_sum.hpp), and the
// conditions of an optimum. Prints counts and the worst residuals over their tolerances; exit code
// 1 where one is exceeded. Ten million periods take some 25 minutes.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "cdcr/allocation.hpp"
#include "cdcr/inverse_kinematics.hpp"
#include "cdcr/simulator.hpp"
#include "cdcr/statics.hpp"
#include "support/chain_cases.hpp"

namespace cdcr::test {
namespace {

/// What one kind of computation was asked, and the worst of its answers.
struct Tally {
  const char* what;
  double tolerance;
  long asked = 0, answered = 0, exceeded = 0;
  double worst = 0.0;  // residual

  void answer(Real residual) {
    ++answered;
    const auto value = static_cast<double>(residual);
    if (!(value <= tolerance)) ++exceeded;
    if (!(value <= worst)) worst = value;
  }
  void print() const {
    std::printf("%-20s %9ld asked %9ld answered   worst %9.2e = %.3f of %g   %ld exceeded\n", what,
                asked, answered, worst, worst / tolerance, tolerance, exceeded);
  }
};

/// A robot and its twin in extended precision.
struct Subject {
  explicit Subject(const Robot& robot) : model(robot), sum(robot) {}

  Model model;
  ChainSum sum;
};

Subject random_subject(Random& random) {
  return Subject(random_chain(random, random.integer(1, 3)));
}

/// Accelerations by Lagrange's equations.
RealVector acceleration(const Subject& s, const RealVector& force, const RealVector& q,
                        const RealVector& qd) {
  return s.sum.mass_matrix(q).llt().solve(force - s.sum.bias(q, qd));
}

/// A period far below what turns or swings fastest [s].
double short_period(const Subject& s, const ChainState& state) {
  const Index d = s.model.num_coordinates();
  const MatrixXd M = s.sum.mass_matrix(state.q.cast<Real>()).cast<double>();
  VectorXd damping(d);
  for (Index i = 0; i < d; ++i) damping[i] = s.model.damping()[i / 2];
  const auto fastest = [&](const VectorXd& resistance) {
    const MatrixXd R = resistance.asDiagonal();
    return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(R, M, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
  };
  return 0.03 / (std::sqrt(fastest(s.model.elastic_stiffness().diagonal())) + fastest(damping) +
                 state.qd.norm());
}

/// Momentum after a period of the simulator from a state against that of Runge-Kutta 4 on the twin,
/// over what all terms of the equations of motion change it by.
Real step_residual(const Subject& s, const ChainState& state, const Simulator& simulator) {
  const RealVector q = state.q.cast<Real>(), v = state.qd.cast<Real>();
  const RealVector force = (s.model.actuation_matrix() * state.tension).cast<Real>();
  const Real h = simulator.period();
  const RealVector a1 = acceleration(s, force, q, v);
  const RealVector v2 = v + h / 2 * a1;
  const RealVector a2 = acceleration(s, force, q + h / 2 * v, v2);
  const RealVector v3 = v + h / 2 * a2;
  const RealVector a3 = acceleration(s, force, q + h / 2 * v2, v3);
  const RealVector v4 = v + h * a3;
  const RealVector a4 = acceleration(s, force, q + h * v3, v4);
  const RealVector q_end = q + h / 6 * (v + 2 * v2 + 2 * v3 + v4);
  const RealVector v_end = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);

  const RealMatrix M = s.sum.mass_matrix(q);
  const RealVector scale = h * (bias_scale(s.model, s.sum, M, state) + force.cwiseAbs());
  const RealVector off = M * (simulator.qd().cast<Real>() - v_end);
  const Real angle = (simulator.q().cast<Real>() - q_end).cwiseAbs().maxCoeff();
  return std::max(off.cwiseAbs().maxCoeff() / scale.maxCoeff(),
                  angle / (1 + q.cwiseAbs().maxCoeff()));
}

/// A run of a thousand periods, the first and the last of them compared with the twin. It may end
/// before, at the bending limit.
void soak_step(Random& random, Tally& tally, long& periods) {
  const Subject s = random_subject(random);
  for (ChainState state : chain_states(s.model, random)) {
    Simulator simulator(s.model, short_period(s, state));
    simulator.reset(state.q, state.qd);
    Status status = Status::ok;
    for (int k = 1; k <= 1000 && status == Status::ok; ++k) {
      state.q = simulator.q();
      state.qd = simulator.qd();
      status = simulator.step(state.tension);
      ++periods;
      if (k != 1 && k != 1000) continue;
      ++tally.asked;
      if (status == Status::ok) tally.answer(step_residual(s, state, simulator));
    }
  }
}

/// Unbalanced moment of the twin over the moments in balance.
void soak_equilibrium(Random& random, Tally& tally) {
  const Subject s = random_subject(random);
  for (const ChainState& state : chain_states(s.model, random)) {
    const Wrenches wrenches = random_wrenches(s.model, random.integer(0, 2), random);
    ++tally.asked;
    const Equilibrium found = equilibrium(s.model, state.tension, state.q, wrenches);
    if (found.status != Status::ok) continue;
    const RealVector q = found.q.cast<Real>();
    const RealVector pull = (s.model.actuation_matrix() * state.tension).cast<Real>();
    const RealVector gradient = s.sum.potential_gradient(q);
    RealVector off = gradient - pull;
    RealVector scale = s.sum.weight_scale() + gradient.cwiseAbs() + pull.cwiseAbs() +
                       s.model.elastic_stiffness().diagonal().cast<Real>();
    for (const Wrench& wrench : wrenches) {
      const RealVector part = s.sum.wrench_force(q, wrench);
      off -= part;
      scale += part.cwiseAbs();
    }
    tally.answer(off.cwiseAbs().maxCoeff() / scale.maxCoeff());
  }
}

/// Distance of the twin's tip from a point that the robot reaches, over its tolerance.
void soak_inverse(Random& random, Tally& tally) {
  const Subject s = random_subject(random);
  InverseSolver solver(s.model);
  Real length = 0;
  for (const Section& section : s.model.robot().sections) length += section.length;
  for (int k = 0; k < 5; ++k) {
    const VectorXd q = random_bending(s.model.num_sections(), 3.0, random);
    const Vector3d p = tip(s.model, q).p;
    ++tally.asked;
    const InverseKinematics& found = solver.solve(p);
    if (!found.reachable) continue;
    const Frame end = s.sum.frame(found.q.cast<Real>(), s.model.num_sections() - 1, 1);
    tally.answer((end.r - p.cast<Real>()).norm() / length);
  }
}

/// How far tensions are from the optimum's conditions: nearest to the force, and there least norm.
void soak_allocation(Random& random, Tally& tally) {
  const Model model(random_chain(random, random.integer(1, 3)));
  const MatrixXd& B = model.actuation_matrix();
  for (const ChainState& state : chain_states(model, random)) {
    if (B.cols() == 0) return;
    const VectorXd force = B * state.tension;  // which can be met
    ++tally.asked;
    const Allocation found = allocate(model, force);
    const double size = B.cwiseAbs().maxCoeff() * (1e-300 + state.tension.norm());
    const bool pushes = (found.tension.array() < 0.0).any();
    if (!found.feasible || pushes) {
      tally.answer(std::numeric_limits<Real>::infinity());
      continue;
    }
    const double longer = found.tension.norm() / (1e-300 + state.tension.norm()) - 1.0;
    tally.answer(std::max({(B * found.tension - force).norm() / size, longer, 0.0}));
  }
}

int soak(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  Random random;
  // Lagrange's equations by differences; then as in support/tolerances.hpp, with a margin; the
  // solver's own tolerance; distance and norm of an active set.
  Tally steps{"steps", 1e-11}, rests{"equilibria", 1e-12}, inverses{"inverse kinematics", 1.01e-6},
      allocations{"allocations", 1e-9};
  long periods = 0;
  do {
    soak_step(random, steps, periods);
    soak_equilibrium(random, rests);
    for (int k = 0; k < 10; ++k) soak_inverse(random, inverses);
    for (int k = 0; k < 10; ++k) soak_allocation(random, allocations);
  } while (Clock::now() < end);

  std::printf("seed %llu (CDCR_TEST_SEED)\n", static_cast<unsigned long long>(test_seed()));
  std::printf("%ld periods\n", periods);
  bool sound = true;
  for (const Tally& tally : {steps, rests, inverses, allocations}) {
    tally.print();
    sound = sound && tally.exceeded == 0 && 2 * tally.answered >= tally.asked;
  }
  if (!sound) std::puts("soak: a residual above its tolerance, or too few answers");
  return sound ? 0 : 1;
}

}  // namespace
}  // namespace cdcr::test

int main(int argc, char** argv) {
  char* rest = nullptr;
  const double seconds = argc == 2 ? std::strtod(argv[1], &rest) : -1.0;
  if (rest == nullptr || *rest != '\0' || !(seconds >= 0.0)) {
    std::fprintf(stderr, "usage: %s SECONDS\n", argv[0]);
    return 2;
  }
  return cdcr::test::soak(seconds);
}
