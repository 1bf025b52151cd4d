// Many states and many motions at once: what each costs one processor, and what a rollout costs
// over a loop of runs.
#include <random>

#include "cdcr/batch.hpp"
#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

constexpr Index num_states = 4096;

RowMatrixXd random_rows(Index rows, Index columns, double size) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(-size, size);
  return RowMatrixXd::NullaryExpr(rows, columns, [&] { return unit(engine); });
}

std::string of(Index n) {
  return n == 1 ? "1 section" : std::to_string(n) + " sections";
}

/// A call is a state: as many calls as there are states are made by the first.
void measure_states(const Harness& harness, const Model& model) {
  const Index d = model.num_coordinates(), cables = model.num_cables();
  const RowMatrixXd q = random_rows(num_states, d, 0.7), qd = random_rows(num_states, d, 3.0);
  const VectorXd tension = VectorXd::Ones(cables);
  RowMatrixXd qdd(num_states, d);
  Data data(model);
  harness.run(
      {"forward_dynamics of many, " + of(model.num_sections()), "ns", num_states, 200}, [] {},
      [&](long i) {
        if (i != 0) return;
        forward_dynamics(model, data, num_states, {q.data(), d}, {qd.data(), d},
                         {tension.data(), 0}, qdd.data());
        keep(qdd);
      });
  harness.run(
      {"inverse_dynamics of many, " + of(model.num_sections()), "ns", num_states, 200}, [] {},
      [&](long i) {
        if (i != 0) return;
        inverse_dynamics(model, data, num_states, {q.data(), d}, {qd.data(), d}, {qd.data(), d},
                         qdd.data());
        keep(qdd);
      });
  RowMatrixXd J(num_states, 6 * d);
  harness.run(
      {"tip_jacobian of many, " + of(model.num_sections()), "ns", num_states, 200}, [] {},
      [&](long i) {
        if (i != 0) return;
        tip_jacobian(model, num_states, {q.data(), d}, J.data());
        keep(J);
      });
}

struct Batch {
  Batch(const Model& model, Index count, double step, long steps, Method method)
      : d(model.num_coordinates()),
        tension(VectorXd::Constant(model.num_cables(), 0.5)),
        q(static_cast<std::size_t>(2 * count * d)),
        qd(q.size()) {
    motions.models = {&model};
    motions.q0 = random_rows(count, d, 0.1);
    motions.qd0 = random_rows(count, d, 0.1);
    motions.commands.data = tension.data();
    options.step = step;
    options.steps = options.record_every = steps;
    options.method = method;
    options.threads = 1;
  }
  void run() {
    keep(rollout(motions, options, {q.data(), qd.data()}));
    keep(q);
  }

  Index d;
  VectorXd tension;
  std::vector<double> q, qd;
  Motions motions;
  RolloutOptions options;
};

/// A call is a step of a motion.
void measure_steps(const Harness& harness, const Model& model, double step) {
  constexpr Index count = 128;
  constexpr long steps = 512;
  Batch batch(model, count, step, steps, Method::rk4);
  harness.run(
      {"rollout by rk4, a step, " + of(model.num_sections()), "ns", count * steps, 20}, [] {},
      [&](long i) {
        if (i == 0) batch.run();
      });
}

/// A call is a motion of 1 s by dopri5, in a rollout and in a loop.
void measure_overhead(const Harness& harness, const Model& model) {
  constexpr Index count = 1000;
  Batch batch(model, count, 1.0, 1, Method::dopri5);
  const CommandInput input = CommandInput::constant(batch.tension);
  harness.run(
      {"rollout by dopri5, 1 s of 1 section", "us", count, 10}, [] {},
      [&](long i) {
        if (i == 0) batch.run();
      });
  harness.run(
      {"simulate by dopri5, 1 s of 1 section", "us", count, 10}, [] {},
      [&](long i) {
        keep(simulate(model, batch.motions.q0.row(i).transpose(),
                      batch.motions.qd0.row(i).transpose(), Eigen::Vector2d(0.0, 1.0), input,
                      Method::dopri5));
      });
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  using namespace cdcr;
  const bench::Harness harness(argc, argv);
  const Model one(bench::robot(false)), three(bench::arm(3)), ten(bench::arm(10));
  for (const Model* model : {&one, &three, &ten}) bench::measure_states(harness, *model);
  bench::measure_steps(harness, one, 1e-3);
  bench::measure_steps(harness, three, 1e-3);
  bench::measure_steps(harness, ten, 1e-5);
  bench::measure_overhead(harness, one);
}
