// States in lanes: each as it is by itself, to rounding, on any width and next to any other.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "batch/rk4_lanes.hpp"
#include "cdcr/batch.hpp"
#include "cdcr/simulate.hpp"
#include "support/cable_robots.hpp"
#include "support/cases.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/rod_robots.hpp"
#include "support/runs.hpp"

namespace cdcr::test {
namespace {

// Ten times the largest residual seen, relative to the largest of a vector.
constexpr double same_acceleration = 1e-12;
constexpr double same_motion = 1e-12;

std::vector<int> widths() {
  return detail::num_lanes == 2 ? std::vector<int>{2} : std::vector<int>{2, 4};
}

/// Accelerations of as many states as there are lanes.
template <int W, bool closed>
std::vector<VectorXd> accelerations(const Model& model, const std::vector<VectorXd>& states,
                                    const std::vector<VectorXd>& forces) {
  const Index d = model.num_coordinates();
  const auto size = static_cast<std::size_t>(d);
  using P = typename detail::MotionLanes<W, closed>::Scalar;
  std::vector<P> y(2 * size), force(size), qdd(size);
  for (int lane = 0; lane < P::size; ++lane) {
    for (Index i = 0; i < 2 * d; ++i) set_lane(y[i], lane, states[lane % states.size()][i]);
    for (Index i = 0; i < d; ++i) set_lane(force[i], lane, forces[lane % states.size()][i]);
  }
  detail::MotionLanes<W, closed> lanes(model);
  detail::in_lanes_of(std::integral_constant<int, W>(), [&](auto /*width*/) {
    lanes.accelerate(y.data(), y.data() + d, force.data(), qdd.data());
  });
  std::vector<VectorXd> result(P::size, VectorXd(d));
  for (int lane = 0; lane < P::size; ++lane) {
    for (Index i = 0; i < d; ++i) result[lane][i] = get_lane(qdd[i], lane);
  }
  return result;
}

VectorXd acceleration(const Model& model, const VectorXd& y, const VectorXd& force) {
  Data data(model);
  const Index d = model.num_coordinates();
  VectorXd qdd(d);
  forward_dynamics_force(model, data, y.head(d), y.tail(d), force, qdd);
  return qdd;
}

/// Answers of so many numbers each that many(out) gives of `count` states, beside one(i, out).
template <class Many, class One>
void check_rows(Index count, Index size, const Many& many, const One& one) {
  RowMatrixXd found(count, size);
  many(found.data());
  for (Index i = 0; i < count; ++i) {
    VectorXd expected(size);
    one(i, expected);
    CHECK(residual(found.row(i).transpose(), expected, expected.norm()) <= same_acceleration);
  }
}
/// The rows of a matrix one after another.
VectorXd in_rows(const RowMatrixXd& matrix) {
  return Eigen::Map<const VectorXd>(matrix.data(), matrix.size());
}

/// body(model) for one section in closed form and chains, with and without gravity.
template <class Body>
void for_each_model(Body&& body) {
  Random random;
  INFO(random);
  Robot weightless = amouri2020();
  body(Model(weightless), random);
  weightless.gravity = {1.0, -2.0, -9.0};
  body(Model(weightless), random);
  for (const int n : {1, 2, 5}) body(Model(random_chain(random, n)), random);
}

TEST_SUITE_BEGIN("lanes");

TEST_CASE("accelerations in lanes are those of single states") {
  for_each_model([](const Model& model, Random& random) {
    const auto n = static_cast<int>(model.num_sections());
    const Index d = model.num_coordinates();
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<VectorXd> states, forces;
      for (int lane = 0; lane < 8; ++lane) {
        // Straight, little bent, and in other pieces of the tables than its neighbours.
        const double most = trial == 0 ? 0.0 : trial < 10 ? 0.5 : 3.0 * pi;
        VectorXd y(2 * d);
        y << random_bending(n, random.uniform(0.0, most), random), random.vector(d, 2.0);
        states.push_back(y);
        forces.push_back(random.vector(d, 0.1));
      }
      detail::with_motion_lanes(model, [&](auto width, auto closed) {
        const auto found = accelerations<width.value, closed.value>(model, states, forces);
        for (std::size_t lane = 0; lane < found.size(); ++lane) {
          const VectorXd expected = acceleration(model, states[lane], forces[lane]);
          CHECK(residual(found[lane], expected, expected.norm()) <= same_acceleration);
        }
      });
    }
  });
}

TEST_CASE("a state that is none, or bent too far, leaves those beside it alone") {
  for_each_model([](const Model& model, Random& random) {
    const Index d = model.num_coordinates();
    std::vector<VectorXd> states(8, VectorXd::Zero(2 * d)), forces(8, VectorXd::Zero(d));
    for (VectorXd& y : states) y = random.vector(2 * d, 0.3);
    const std::vector<VectorXd> sound = states;
    states[0][0] = 10.0;
    states[1][d] = std::numeric_limits<double>::quiet_NaN();
    detail::with_motion_lanes(model, [&](auto width, auto closed) {
      const auto found = accelerations<width.value, closed.value>(model, states, forces);
      const auto beside = accelerations<width.value, closed.value>(model, sound, forces);
      CHECK_FALSE(found[0].allFinite());
      CHECK_FALSE(found[1].allFinite());
      for (std::size_t lane = 2; lane < found.size(); ++lane) CHECK(found[lane] == beside[lane]);
    });
  });
}

TEST_CASE("many states at once are those of single states, of any robot and number") {
  Random random;
  std::vector<Model> models;
  for_each_model([&](const Model& model, Random&) { models.push_back(model); });
  models.emplace_back(rubbing_chain(random, 2));
  models.emplace_back(rod_robot());
  for (const Model& model : models) {
    const Index d = model.num_coordinates(), cables = model.num_cables();
    Data data(model);
    for (const Index count : {0, 1, 7}) {
      RowMatrixXd q(count, d), qd(count, d), qdd(count, d);
      for (Index i = 0; i < count; ++i) {
        q.row(i) = model.rest() + random.vector(d, 1e-2);
        qd.row(i) = random.vector(d, 1.0);
      }
      const VectorXd tension = rest_command_of(model);
      forward_dynamics(model, data, count, {q.data(), d}, {qd.data(), d}, {tension.data(), 0},
                       qdd.data());
      for (Index i = 0; i < count; ++i) {
        VectorXd expected(d);
        forward_dynamics(model, data, q.row(i).transpose(), qd.row(i).transpose(), tension,
                         expected);
        CHECK(residual(qdd.row(i).transpose(), expected, expected.norm()) <= same_acceleration);
      }
      RowMatrixXd pulls = RowMatrixXd::Random(count, cables).cwiseAbs();
      forward_dynamics(model, data, count, {q.data(), 0}, {qd.data(), 0}, {pulls.data(), cables},
                       qdd.data());
      for (Index i = 0; i < count; ++i) {
        VectorXd expected(d);
        forward_dynamics(model, data, q.row(0).transpose(), qd.row(0).transpose(),
                         pulls.row(i).transpose(), expected);
        CHECK(residual(qdd.row(i).transpose(), expected, expected.norm()) <= same_acceleration);
      }
    }
  }
}

/// Of `count` states q, qd with accelerations qdd.
void check_dynamics(const Model& model, const RowMatrixXd& q, const RowMatrixXd& qd,
                    const RowMatrixXd& qdd) {
  const Index d = model.num_coordinates(), count = q.rows();
  Data data(model);
  const StateRows x{q.data(), d}, xd{qd.data(), d}, xdd{qdd.data(), d};
  const auto at = [](const RowMatrixXd& rows, Index i) { return VectorXd(rows.row(i)); };
  check_rows(
      count, d, [&](double* out) { inverse_dynamics(model, data, count, x, xd, xdd, out); },
      [&](Index i, VectorXd& out) {
        inverse_dynamics(model, data, at(q, i), at(qd, i), at(qdd, i), out);
      });
  check_rows(
      count, d, [&](double* out) { bias(model, data, count, x, xd, out); },
      [&](Index i, VectorXd& out) { bias(model, data, at(q, i), at(qd, i), out); });
  check_rows(
      count, d * d, [&](double* out) { mass_matrix(model, data, count, x, out); },
      [&](Index i, VectorXd& out) {
        MatrixXd M(d, d);
        mass_matrix(model, data, at(q, i), M);
        out = in_rows(M);
      });
  check_rows(
      count, 1, [&](double* out) { kinetic_energy(model, data, count, x, xd, out); },
      [&](Index i, VectorXd& out) { out[0] = kinetic_energy(model, data, at(q, i), at(qd, i)); });
  check_rows(
      count, 1, [&](double* out) { potential_energy(model, data, count, x, out); },
      [&](Index i, VectorXd& out) { out[0] = potential_energy(model, data, at(q, i)); });
  check_rows(
      count, d, [&](double* out) { potential_gradient(model, data, count, x, out); },
      [&](Index i, VectorXd& out) { potential_gradient(model, data, at(q, i), out); });
}

void check_places(const Model& model, const RowMatrixXd& q) {
  const Index d = model.num_coordinates(), count = q.rows(), half = model.num_sections() / 2;
  const StateRows x{q.data(), d};
  const auto at = [&q](Index i) { return VectorXd(q.row(i)); };
  check_rows(
      count, 9, [&](double* R) { pose(model, count, x, half, 0.3, R, nullptr); },
      [&](Index i, VectorXd& out) { out = in_rows(pose(model, at(i), half, 0.3).R); });
  check_rows(
      count, 3, [&](double* p) { tip(model, count, x, nullptr, p); },
      [&](Index i, VectorXd& out) { out = tip(model, at(i)).p; });
  check_rows(
      count, 6 * d, [&](double* J) { jacobian(model, count, x, half, 0.3, J); },
      [&](Index i, VectorXd& out) {
        MatrixXd J(6, d);
        jacobian(model, at(i), half, 0.3, J);
        out = in_rows(J);
      });
  check_rows(
      count, 6 * d, [&](double* J) { tip_jacobian(model, count, x, J); },
      [&](Index i, VectorXd& out) {
        MatrixXd J(6, d);
        tip_jacobian(model, at(i), J);
        out = in_rows(J);
      });
  check_rows(
      count, model.num_cables(), [&](double* l) { cable_lengths(model, count, x, l); },
      [&](Index i, VectorXd& out) { cable_lengths(model, at(i), out); });
}

TEST_CASE("other functions of many states are those of single states, of any robot and number") {
  Random random;
  std::vector<Model> models;
  for_each_model([&](const Model& model, Random&) { models.push_back(model); });
  models.emplace_back(rubbing_chain(random, 2));
  models.emplace_back(rod_robot());
  Robot with_tool = random_chain(random, 3);
  with_tool.tool.topRightCorner<3, 1>() = Vector3d(0.01, 0.02, 0.03);
  with_tool.base_position = {0.1, 0.2, 0.3};
  models.emplace_back(with_tool);
  for (const Model& model : models) {
    const Index d = model.num_coordinates();
    for (const Index count : {0, 1, 7}) {
      RowMatrixXd q(count, d), qd(count, d), qdd(count, d);
      for (Index i = 0; i < count; ++i) {
        q.row(i) = model.rest() + random.vector(d, model.has_rods() || i % 3 == 0 ? 1e-2 : 0.5);
        qd.row(i) = random.vector(d, 1.0);
        qdd.row(i) = random.vector(d, 5.0);
      }
      check_dynamics(model, q, qd, qdd);
      check_places(model, q);
    }
  }
}

TEST_CASE("motions in lanes are those of rk4, of any width") {
  for_each_model([](const Model& model, Random& random) {
    const Index d = model.num_coordinates();
    const int steps = 200;
    const double h = 1.0 / 4096.0;  // a sum of which is exact
    for (const int width : widths()) {
      const auto lanes = detail::make_rk4_lanes(model, 3 * width - 1, width);
      REQUIRE(lanes->size() == (model.has_closed_form() ? 4 * width : width));
      std::vector<Trajectory> runs;
      for (Index i = 0; i < lanes->size(); ++i) {
        VectorXd y(2 * d), force(d);
        y << random.vector(d, 0.3), random.vector(d, 1.0);
        const VectorXd tension = random.vector(model.num_cables(), 1.0).cwiseAbs();
        force.noalias() = model.actuation_matrix() * tension;
        lanes->set_state(i, y);
        lanes->set_force(i, force);
        runs.push_back(simulate(model, y.head(d), y.tail(d), Eigen::Vector2d(0.0, steps * h),
                                CommandInput::constant(tension), Method::rk4, fixed_step(h)));
      }
      for (int k = 0; k < steps; ++k) lanes->step(h);
      for (Index i = 0; i < lanes->size(); ++i) {
        const Trajectory& run = runs[static_cast<std::size_t>(i)];
        if (run.status != Status::ok) continue;
        VectorXd y(2 * d), expected(2 * d);
        lanes->get_state(i, y);
        expected << run.q.row(1).transpose(), run.qd.row(1).transpose();
        CHECK(residual(y, expected, expected.norm()) <= same_motion);
      }
    }
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
