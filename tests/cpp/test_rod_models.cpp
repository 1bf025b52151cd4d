// Robots of rods through Model: cables that wind, converge and rub, rest shapes, rigid links,
// places along a rod, derivatives, statics and runs.
#include <doctest/doctest.h>

#include "support/allocations.hpp"
#include "support/differences.hpp"
#include "support/residual.hpp"
#include "support/rod_robots.hpp"
#include "support/runs.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

// Derivatives by differences of eighth order: the step in each coordinate.
constexpr double step = 2e-3;
// What they leave: rounding of lengths over the step.
constexpr double by_differences = 4e-8;

VectorXd unit(const Model& model, Index i) {
  // Stretch is of another size than angles.
  const bool stretch = model.coordinate_names()[static_cast<std::size_t>(i)][0] == 'e';
  return (stretch ? 1e-2 : 1.0) * VectorXd::Unit(model.num_coordinates(), i);
}

VectorXd force_of(const Model& model, const VectorXd& q, const VectorXd& qd,
                  const VectorXd& command) {
  VectorXd force(model.num_coordinates());
  cable_force(model, q, qd, command, force);
  return force;
}

TEST_SUITE_BEGIN("rod_models");

TEST_CASE("coordinates of mixed robots have names in their order") {
  const Model model(rod_robot());
  CHECK(model.has_rods());
  CHECK_FALSE(model.has_constant_actuation());
  const std::vector<std::string> names = {"q1_x",   "q1_y",   "q2_x", "q2_y", "q2_x_1", "q2_y_1",
                                          "q2_x_2", "q2_y_2", "t2",   "t2_1", "e2"};
  CHECK(model.coordinate_names() == names);
  CHECK(model.first_coordinate(1) == 2);
}

TEST_CASE("the actuation matrix is the slope of the lengths, and pulls") {
  Random random;
  INFO(random);
  const Model model(rod_robot());
  const Index d = model.num_coordinates(), c = model.num_cables();
  for (int i = 0; i < 10; ++i) {
    const RodState s(model, 0.5, random);
    MatrixXd B(d, c);
    actuation_matrix(model, s.q, B);
    for (Index k = 0; k < d; ++k) {
      const VectorXd along = unit(model, k);
      const VectorXd slope = difference(
          [&](double h) {
            VectorXd lengths(c);
            cable_lengths(model, s.q + h * along, lengths);
            return lengths;
          },
          step);
      CHECK(residual(VectorXd(-B.transpose() * along), slope) <= by_differences);
    }
    CHECK(B.col(6).head(2).isZero(0.0));  // begins on the second section
    VectorXd tension(c);
    cable_tensions(model, s.q, s.qd, s.command, tension);
    CHECK(residual(force_of(model, s.q, s.qd, s.command), B * tension) <= tolerance::recursion);
  }
}

TEST_CASE("accelerations under everything undo inverse dynamics, and have these derivatives") {
  Random random;
  INFO(random);
  const Model model(rod_robot());
  const Index d = model.num_coordinates(), c = model.num_cables();
  Data data(model);
  for (int i = 0; i < 5; ++i) {
    const RodState s(model, 0.5, random);
    const Wrenches wrenches = {{1, 0.4, {0.1, -0.2, 0.3}, {0.01, 0.0, 0.02}, Wrench::Frame::local}};
    const auto motion = [&](const VectorXd& q, const VectorXd& qd, const VectorXd& command) {
      VectorXd qdd(d);
      forward_dynamics(model, data, q, qd, command, wrenches, qdd);
      return qdd;
    };
    const VectorXd qdd = motion(s.q, s.qd, s.command);
    VectorXd force(d), total(d);
    inverse_dynamics(model, data, s.q, s.qd, qdd, force);
    total_force(model, s.q, s.qd, s.command, wrenches, total);
    MatrixXd M(d, d), A(2 * d, 2 * d), B(2 * d, c);
    mass_matrix(model, data, s.q, M);
    CHECK(residual(force, total, (M.cwiseAbs() * qdd.cwiseAbs()).maxCoeff()) <= 1e-11);
    linearize(model, data, s.q, s.qd, s.command, wrenches, A, B);
    const double scale = A.bottomRows(d).cwiseAbs().maxCoeff();
    for (Index k = 0; k < d; ++k) {
      const VectorXd along = unit(model, k);
      const VectorXd on_q =
          difference([&](double h) { return motion(s.q + h * along, s.qd, s.command); }, step);
      CHECK(residual(VectorXd(A.bottomLeftCorner(d, d) * along), on_q, scale) <= 1e-8);
      const VectorXd on_qd =
          difference([&](double h) { return motion(s.q, s.qd + h * along, s.command); }, step);
      CHECK(residual(VectorXd(A.bottomRightCorner(d, d) * along), on_qd, scale) <= 1e-8);
    }
  }
}

TEST_CASE("a place on a rod moves with its Jacobian, and reaches the tip") {
  Random random;
  INFO(random);
  const Model model(rod_robot());
  const Index d = model.num_coordinates();
  const RodState s(model, 0.5, random);
  for (const double fraction : {0.0, 0.3, 0.77, 1.0}) {
    MatrixXd J(6, d);
    jacobian(model, s.q, 1, fraction, J);
    for (Index k = 0; k < d; ++k) {
      const VectorXd along = unit(model, k);
      const Vector3d v = difference(
          [&](double h) { return Vector3d(pose(model, s.q + h * along, 1, fraction).p); }, step);
      CHECK(residual(Vector3d(J.topRows(3) * along), v, 1.0) <= by_differences);
    }
  }
  CHECK(residual(pose(model, s.q, 1, 1.0 - 1e-12).p, tip(model, s.q).p) <= 1e-8);
}

TEST_CASE("friction of a rod of order 0 is that of the arc, and never gives work") {
  Random random;
  INFO(random);
  Robot arc = amouri2020();
  arc.sliding_speed = 1e-9;  // all slides
  arc.sections[0].cable_friction = 0.4;
  Robot rod = arc;
  rod.sections[0].nodes = 32;
  const Model arcs(arc), rods(rod);
  REQUIRE(rods.has_rods());
  for (int i = 0; i < 10; ++i) {
    const VectorXd q = random.vector(2, 2.0);
    const VectorXd qd = random.uniform(0.5, 2.0) * q;  // every hole slides alike
    const VectorXd command = VectorXd::LinSpaced(3, 1.0, 3.0);
    MatrixXd expected(2, 3), found(2, 3);
    tensions_along(arcs, q, qd, command, expected);
    tensions_along(rods, q, qd, command, found);
    CHECK(residual(found, expected) <= tolerance::recursion);
    CHECK(residual(friction_power(rods, q, qd, command), friction_power(arcs, q, qd, command)) <=
          1e-10);
  }
  Robot rubbing = rod_robot();
  for (Section& section : rubbing.sections) section.cable_friction = 0.3;
  const Model model(rubbing);
  for (int i = 0; i < 20; ++i) {
    const RodState s(model, 0.8, random);
    const double lost = friction_power(model, s.q, s.qd, s.command);
    VectorXd tension(model.num_cables());
    cable_tensions(model, s.q, s.qd, s.command, tension);
    MatrixXd B(model.num_coordinates(), model.num_cables());
    actuation_matrix(model, s.q, B);
    const double given = tension.dot(B.transpose() * s.qd);
    const double taken = force_of(model, s.q, s.qd, s.command).dot(s.qd);
    CHECK(residual(lost, given - taken, std::abs(given)) <= tolerance::recursion);
    CHECK(lost >= -1e-13 * std::abs(given));
  }
}

TEST_CASE("unloaded, a robot rests where its backbone is made to") {
  Robot robot = rod_robot();
  robot.gravity.setZero();
  robot.cables.pop_back();
  const Model model(robot);
  const Equilibrium rest = equilibrium(model, VectorXd::Zero(model.num_cables()));
  REQUIRE(rest.status == Status::ok);
  CHECK(residual(rest.q, model.rest(), 1.0) <= tolerance::rounding);
  CHECK(rest.stable);
  Data data(model);
  CHECK(std::abs(potential_energy(model, data, model.rest())) <= 1e-15);
  CHECK(model.rest()[2] == 0.3);
  CHECK(model.rest()[8] == 0.4);
}

TEST_CASE("statics of rods: what is out of balance, and how it changes") {
  Random random;
  INFO(random);
  const Model model(rod_robot());
  const Index d = model.num_coordinates();
  Data data(model);
  const RodState s(model, 0.2, random);
  const Equilibrium found = equilibrium(model, s.command);
  REQUIRE(found.status == Status::ok);
  const VectorXd still = VectorXd::Zero(d);
  const auto unbalanced = [&](const VectorXd& q) {
    VectorXd gradient(d);
    potential_gradient(model, data, q, gradient);
    return VectorXd(gradient - force_of(model, q, still, s.command));
  };
  MatrixXd K(d, d);
  static_stiffness(model, data, found.q, s.command, no_wrenches(), K);
  CHECK(largest(unbalanced(found.q)) <= 1e-12 * K.cwiseAbs().maxCoeff());
  for (Index k = 0; k < d; ++k) {
    const VectorXd along = unit(model, k);
    const VectorXd slope =
        difference([&](double h) { return unbalanced(found.q + h * along); }, 1e-4);
    CHECK(residual(VectorXd(K * along), slope, (K.cwiseAbs() * along).maxCoeff()) <= 3e-7);
  }
  const Modes shapes = modes(model, found.q, s.command);
  CHECK(shapes.squared_frequency[0] > 0.0);
}

TEST_CASE("rods that stretch come to rest in a few steps") {
  // Stretch is a million times stiffer than bending; steps of unscaled coordinates crawl.
  Robot robot;
  robot.gravity = {1.0, -2.0, -9.0};
  robot.payload = 0.01;
  Section rod = rod_section(2, 1, 1);
  rod.stretch_stiffness = 1e4;
  rod.length = 0.2;
  rod.cable_angles.clear();
  robot.sections = {rod, rod, rod};
  for (const double angle : {0.0, 2.0, 4.0}) {
    Cable cable;
    cable.radius = 0.02;
    cable.angle = angle;
    cable.end_section = 2;
    robot.cables.push_back(cable);
  }
  const Equilibrium found = equilibrium(Model(robot), Eigen::Vector3d(1.0, 2.0, 0.5));
  CHECK(found.status == Status::ok);
  CHECK(found.stable);
  CHECK(found.searches == 1);
  CHECK(found.iterations <= 40);
}

TEST_CASE("a rigid link is a payload") {
  Robot linked = amouri2020();
  linked.gravity = {1.0, 2.0, -9.0};
  Section link = rod_section(locked, locked, locked);
  link.length = 0.1;
  link.backbone_mass = 0.05;
  link.backbone_diameter = 0.02;
  link.num_disks = 0;
  link.disk_mass = 0.0;
  link.cable_angles.clear();
  linked.sections[0].nodes = 32;
  linked.sections.push_back(link);
  Robot loaded = amouri2020();
  loaded.gravity = linked.gravity;
  loaded.payload = link.backbone_mass;
  loaded.payload_position = {0.0, 0.0, 0.05};
  const double squared = 0.02 * 0.02 / 16.0 * link.backbone_mass;  // of a slice
  const double along = link.backbone_mass * 0.1 * 0.1 / 12.0;
  loaded.payload_inertia.diagonal() << squared + along, squared + along, 2.0 * squared;
  const Model one(linked), other(loaded);
  REQUIRE(one.num_coordinates() == 2);
  Data a(one), b(other);
  Random random;
  for (int i = 0; i < 10; ++i) {
    const VectorXd q = random.vector(2, 1.5), qd = random.vector(2, 5.0);
    const VectorXd tension = VectorXd::Ones(3);
    VectorXd found(2), expected(2);
    forward_dynamics(one, a, q, qd, tension, found);
    forward_dynamics(other, b, q, qd, tension, expected);
    CHECK(residual(found, expected) <= 1e-11);
  }
}

TEST_CASE("a run of a rod conserves energy") {
  Robot robot;
  robot.sections = {rod_section(2, 0, locked)};
  Section& section = robot.sections[0];
  section.damping = section.twist_damping = section.material_damping = 0.0;
  robot.gravity = {0.0, 0.0, -9.81};
  const Model model(robot);
  Random random;
  const VectorXd q = random.vector(7, 0.2), qd = random.vector(7, 0.5);
  const Trajectory run = simulate(model, q, qd, even_times(0.0, 10.0, 101), no_tension(model),
                                  Method::dopri5, tolerances(1e-11, 1e-13));
  REQUIRE(run.status == Status::ok);
  const VectorXd energies = total_energies(model, run);
  const Residual drift =
      residual(energies, VectorXd::Constant(101, energies[0]), energies.cwiseAbs().maxCoeff());
  MESSAGE("energy drift ", drift, ", steps ", run.stats.steps);
  CHECK(drift <= tolerance::conserved);
}

TEST_CASE("motion and derivatives of rods allocate nothing") {
  const Model model(rod_robot());
  const Index d = model.num_coordinates(), c = model.num_cables();
  Data data(model);
  Random random;
  const RodState s(model, 0.5, random);
  const Wrenches wrenches = {Wrench{}};
  VectorXd v(d);
  MatrixXd M(d, d), A(2 * d, 2 * d), B(2 * d, c), pull(d, c);
  CHECK(allocations_of([&] { forward_dynamics(model, data, s.q, s.qd, s.command, wrenches, v); }) ==
        0);
  CHECK(allocations_of([&] { inverse_dynamics(model, data, s.q, s.qd, s.qd, v); }) == 0);
  CHECK(allocations_of([&] { mass_matrix(model, data, s.q, M); }) == 0);
  CHECK(allocations_of([&] { potential_hessian(model, data, s.q, M); }) == 0);
  CHECK(allocations_of([&] { static_stiffness(model, data, s.q, s.command, wrenches, M); }) == 0);
  CHECK(allocations_of([&] { linearize(model, data, s.q, s.qd, s.command, wrenches, A, B); }) == 0);
  CHECK(allocations_of([&] { actuation_matrix(model, s.q, pull); }) == 0);
  MatrixXd on_q(d, d), on_qd(d, d), on_wrenches(d, 6);
  CHECK(allocations_of([&] {
          acceleration_derivatives(model, data, s.q, s.qd, s.command, wrenches, on_q, on_qd, pull,
                                   on_wrenches);
        }) == 0);
  Simulator simulator(model, 1e-4, 1);
  simulator.reset(s.q, VectorXd::Zero(d));
  CHECK(allocations_of([&] { static_cast<void>(simulator.step(s.command)); }) == 0);
  CHECK(simulator.step(s.command) == Status::ok);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
