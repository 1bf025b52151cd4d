// From tip positions, and from tip poses, to bending vectors: random targets within reach.
#include <cmath>
#include <random>

#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

constexpr Index num_targets = 1024;

Model arm(Index num_sections) {
  Robot arm = robot(false);
  arm.sections.resize(static_cast<std::size_t>(num_sections), arm.sections[0]);
  return Model(arm);
}

/// Tips at random bending vectors, evenly spread over |q_i| <= 2.5 rad.
std::vector<Pose> random_tips(const Model& model) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Pose> tips;
  VectorXd q(model.num_coordinates());
  for (Index k = 0; k < num_targets; ++k) {
    for (Index i = 0; i < model.num_sections(); ++i) {
      const double theta = 2.5 * std::sqrt(unit(engine));
      q.segment<2>(2 * i) = bending(theta, 8.0 * quarter_pi * unit(engine));
    }
    tips.push_back(tip(model, q));
  }
  return tips;
}

/// Blocks of one call, so that a row's percentiles are those over the targets.
void measure(const Harness& harness, const std::string& name, Index num_sections, bool with_pose) {
  const Model model = arm(num_sections);
  const std::vector<Pose> tips = random_tips(model);
  InverseSolver solver(model);
  long reached = 0;
  for (const Pose& at : tips) {
    reached += solver.solve(at.p, with_pose ? std::optional(at.R) : std::nullopt).reachable ? 1 : 0;
  }
  long next = 0;
  harness.run(
      {name, "us", 1, 10 * num_targets}, [] {},
      [&](long /*i*/) {
        const Pose& at = tips[static_cast<std::size_t>(next++ % num_targets)];
        keep(solver.solve(at.p, with_pose ? std::optional(at.R) : std::nullopt));
      },
      ", \"reached\": " + std::to_string(reached) +
          ", \"targets\": " + std::to_string(num_targets));
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  const cdcr::bench::Harness harness(argc, argv);
  cdcr::bench::measure(harness, "inverse kinematics, 2 sections", 2, false);
  cdcr::bench::measure(harness, "inverse kinematics, 3 sections", 3, false);
  cdcr::bench::measure(harness, "inverse kinematics, 8 sections", 8, false);
  cdcr::bench::measure(harness, "inverse kinematics, 3 sections, pose", 3, true);
}
