// Rollouts: each motion is that of `simulate`, whatever becomes of the others.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "cdcr/pid.hpp"
#include "cdcr/rollout.hpp"
#include "support/cable_robots.hpp"
#include "support/rod_robots.hpp"
#include "support/runs.hpp"
#include "support/split.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr Index count = 7;
constexpr long steps = 20, every = 5;

/// Motions of a robot near rest, whose commands change with each step, and room for their rows.
struct Batch {
  explicit Batch(const Model& robot, Index size = count)
      : model(robot), table(size * steps, robot.num_cables()) {
    Random random;
    const Index d = model.num_coordinates();
    motions.models = {&model};
    motions.q0.resize(size, d);
    motions.qd0.resize(size, d);
    const VectorXd rest = rest_command_of(model);
    for (Index i = 0; i < size; ++i) {
      motions.q0.row(i) = model.rest() + random.vector(d, 1e-2);
      motions.qd0.row(i) = random.vector(d, 1e-2);
      for (Index k = 0; k < steps; ++k) {
        for (Index j = 0; j < model.num_cables(); ++j) {
          const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
          table(i * steps + k, j) =
              by_length ? rest[j] - random.uniform(0.0, 1e-4) : random.uniform(0.0, 1.0);
        }
      }
    }
    motions.commands = {table.data(), steps * model.num_cables(), model.num_cables()};
    options.steps = steps;
    options.record_every = every;
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  RolloutOutcome run(const RolloutProgress& progress = {}) {
    const auto rows = static_cast<std::size_t>(motions.size() * options.rows());
    const auto d = static_cast<std::size_t>(model.num_coordinates());
    q.assign(rows * d, 0.0);
    qd.assign(rows * d, 0.0);
    command.assign(rows * static_cast<std::size_t>(model.num_cables()), 0.0);
    return rollout(motions, options, {q.data(), qd.data(), command.data()}, progress);
  }
  [[nodiscard]] Eigen::Map<const RowMatrixXd> q_of(Index i) const { return of(q, i); }
  [[nodiscard]] Eigen::Map<const RowMatrixXd> qd_of(Index i) const { return of(qd, i); }
  [[nodiscard]] Eigen::Map<const RowMatrixXd> of(const std::vector<double>& all, Index i) const {
    const Index columns = static_cast<Index>(all.size()) / motions.size() / options.rows();
    return {all.data() + i * options.rows() * columns, options.rows(), columns};
  }

  /// The same motion by `simulate`.
  [[nodiscard]] Trajectory alone(Index i) const {
    const double step = options.step;
    VectorXd times(options.rows()), breaks(steps);
    for (Index r = 0; r < times.size(); ++r) times[r] = static_cast<double>(r * every) * step;
    for (Index k = 0; k < steps; ++k) breaks[k] = static_cast<double>(k) * step;
    const CommandInput input = CommandInput::table(breaks, table.middleRows(i * steps, steps),
                                                   CommandInput::Interpolation::previous);
    return simulate(model, motions.q0.row(i).transpose(), motions.qd0.row(i).transpose(), times,
                    input, options.method, fixed_step(step));
  }

  const Model model;
  RowMatrixXd table;
  Motions motions;
  RolloutOptions options;
  std::vector<double> q, qd, command;
};

Robot rubbing(int n) {
  Random random;
  return rubbing_chain(random, n);
}

TEST_SUITE_BEGIN("rollout");

TEST_CASE("every motion is that of simulate, of any kind of robot, by any method") {
  for (const Robot& robot : {rubbing(2), rod_robot()}) {
    Batch batch{Model(robot)};
    batch.options.step = 1e-5;
    for (const Method method : {Method::rk4, Method::dopri5, Method::dop853}) {
      batch.options.method = method;
      const RolloutOutcome outcome = batch.run();
      CHECK(outcome.failures.empty());
      CHECK(outcome.stats.steps >= count * steps);
      for (Index i = 0; i < count; ++i) {
        const Trajectory run = batch.alone(i);
        REQUIRE(run.status == Status::ok);
        CHECK(batch.q_of(i) == run.q);
        CHECK(batch.qd_of(i) == run.qd);
        CHECK(batch.of(batch.command, i) == run.command);
      }
    }
  }
}

TEST_CASE("the bits do not depend on the number of threads") {
  for (const Robot& robot : {rubbing(2), amouri2020()}) {
    Batch one{Model(robot), 40}, many{Model(robot), 40};
    one.options.step = many.options.step = 1e-5;
    one.options.threads = 1;
    many.options.threads = 5;
    CHECK(one.run().failures.empty());
    CHECK(many.run().failures.empty());
    CHECK(one.q == many.q);
    CHECK(one.qd == many.qd);
  }
}

TEST_CASE("a motion that fails leaves the others alone") {
  Batch batch{Model(amouri2020())}, sound{Model(amouri2020())};
  batch.motions.qd0.row(3) *= 1e6;
  CHECK(sound.run().failures.empty());
  const RolloutOutcome outcome = batch.run();
  REQUIRE(outcome.failures.size() == 1);
  const RolloutFailure& failure = outcome.failures[0];
  const Trajectory alone = batch.alone(3);
  CHECK(failure.motion == 3);
  CHECK(failure.status == Status::bending_limit);
  CHECK(failure.message == alone.message);
  for (Index i = 0; i < count; ++i) {
    if (i != 3) CHECK(batch.q_of(i) == sound.q_of(i));
  }
  const Index reached = alone.t.size();
  CHECK(reached < batch.options.rows());
  CHECK(batch.q_of(3).topRows(reached) == alone.q);
  CHECK(batch.q_of(3).bottomRows(batch.options.rows() - reached).array().isNaN().all());
}

TEST_CASE("each motion may have a model and a controller of its own") {
  Batch batch{Model(amouri2020())};
  std::vector<Model> models;
  std::vector<Pid> loops;
  for (Index i = 0; i < count; ++i) {
    Robot robot = amouri2020();
    robot.sections[0].damping = 1e-3 * static_cast<double>(i);
    models.emplace_back(robot);
    PidOptions gains;
    gains.kp = static_cast<double>(1 + i);
    loops.emplace_back(models.back(), gains);
    loops.back().set_reference(Eigen::Vector2d(0.3, -0.1));
  }
  batch.motions.models.clear();
  for (const Model& model : models) batch.motions.models.push_back(&model);
  for (Pid& loop : loops) batch.motions.controllers.push_back(&loop);
  batch.options.start = 5.0;
  CHECK(batch.run().failures.empty());
  VectorXd times(batch.options.rows());
  for (Index r = 0; r < times.size(); ++r) {
    times[r] = batch.options.start + static_cast<double>(r * every) * batch.options.step;
  }
  for (Index i = 0; i < count; ++i) {
    Pid loop = loops[static_cast<std::size_t>(i)];
    const Trajectory run =
        simulate(models[static_cast<std::size_t>(i)], batch.motions.q0.row(i).transpose(),
                 batch.motions.qd0.row(i).transpose(), times, loop, Method::rk4,
                 fixed_step(batch.options.step));
    CHECK(batch.q_of(i) == run.q);
    CHECK(batch.of(batch.command, i) == run.command);
  }
}

TEST_CASE("constant commands, one for all or one for each") {
  Batch batch{Model(amouri2020())};
  const RowMatrixXd pulls = RowMatrixXd::Random(count, 3).cwiseAbs();
  batch.motions.commands = {pulls.data(), 3, 0};
  CHECK(batch.run().failures.empty());
  for (Index i = 0; i < count; ++i) {
    batch.table.middleRows(i * steps, steps).rowwise() = pulls.row(i);
    CHECK((batch.q_of(i) - batch.alone(i).q).norm() <= 1e-12);
  }
  batch.motions.commands.between_motions = 0;
  CHECK(batch.run().failures.empty());
  batch.table.rowwise() = pulls.row(0);
  CHECK((batch.q_of(5) - batch.alone(5).q).norm() <= 1e-12);
}

TEST_CASE("no motions and no steps are a rollout") {
  Batch none{Model(amouri2020()), 0};
  CHECK(none.run().failures.empty());
  Batch still{Model(amouri2020())};
  still.options.steps = 0;
  CHECK(still.run().failures.empty());
  CHECK(still.q_of(2) == still.motions.q0.row(2));
}

TEST_CASE("progress ends a rollout; what is done stays") {
  for (const Method method : {Method::rk4, Method::dopri5}) {
    Batch batch{Model(amouri2020()), 500}, whole{Model(amouri2020()), 500};
    batch.options.threads = 2;
    batch.options.method = whole.options.method = method;
    batch.options.tolerances = whole.options.tolerances = tightest();  // so that it takes a while
    CHECK(whole.run().failures.empty());
    const RolloutOutcome outcome = batch.run([](Index ended) { return ended < 100; });
    REQUIRE_FALSE(outcome.failures.empty());
    std::vector<bool> failed(500, false);
    for (const RolloutFailure& failure : outcome.failures) {
      CHECK(failure.status == Status::interrupted);
      failed[static_cast<std::size_t>(failure.motion)] = true;
    }
    for (Index i = 0; i < 500; ++i) {
      if (failed[static_cast<std::size_t>(i)]) {
        CHECK(batch.q_of(i).bottomRows(1).array().isNaN().all());
      } else {
        CHECK(batch.q_of(i) == whole.q_of(i));
      }
    }
    CHECK_THROWS_AS(static_cast<void>(batch.run([](Index) -> bool { throw std::bad_alloc(); })),
                    std::bad_alloc);
  }
}

TEST_CASE("bad arguments are refused in a sentence that names the motion") {
  Batch batch{Model(amouri2020())};
  const auto refused = [&](auto&& change, const char* sentence) {
    const Motions motions = batch.motions;
    const RolloutOptions options = batch.options;
    change();
    CHECK_THROWS_SENTENCE(batch.run(), sentence);
    batch.motions = motions;
    batch.options = options;
  };
  refused([&] { batch.options.record_every = 3; },
          "record_every must be a divisor of the 20 steps, got 3");
  refused([&] { batch.options.step = 0.0; }, "step must be > 0 s and finite, got 0");
  refused([&] { batch.options.threads = -1; },
          "threads must be >= 0 (0: one for each processor), got -1");
  refused([&] { batch.options.steps = -1; }, "steps must be >= 0, got -1");
  refused([&] { batch.options.start = HUGE_VAL; }, "start must be finite, got inf");
  refused([&] { batch.motions.q0(2, 0) = std::nan(""); }, "q0[2] (motion 3) must be finite");
  refused([&] { batch.motions.qd0(0, 1) = HUGE_VAL; }, "qd0[0] (motion 1) must be finite");
  refused([&] { batch.motions.q0(1, 0) = 10.0; },
          "q0[1] (motion 2) must bend each section by at most 3 pi rad, got 10 rad in section 1");
  refused([&] { batch.motions.models.resize(2, &batch.model); },
          "models must be one, or one for each of the 7 motions, got 2");
  refused([&] { batch.motions.qd0.resize(6, 2); },
          "q0 and qd0 must have 2 columns and as many rows, got 7 x 2 and 6 x 2");
  Pid loop(batch.model, {});
  refused([&] { batch.motions.controllers = {&loop}; },
          "controllers must be one for each of the 7 motions, got 1");
  refused([&] { batch.motions.commands = {}; },
          "motions need commands or controllers, got neither");
  const Model other(split(amouri2020(), 2));
  refused([&] { batch.motions.models = {6, &batch.model}, batch.motions.models.push_back(&other); },
          "model 7 must have 2 coordinates and 3 cables as the first, got 4 and 3");
  batch.table(2 * steps + 4, 1) = -1.0;
  CHECK_THROWS_SENTENCE(batch.run(),
                        "tension of motion 3, step 5, cable 2 must be finite and >= 0 N (a cable "
                        "cannot push), got -1");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
