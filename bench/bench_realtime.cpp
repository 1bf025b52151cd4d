// A closed loop as a controller runs it: how long a step of plant and computed torque takes, paced
// by the clock at 1 kHz and as fast as it goes, and how often it would have been late.
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

#include "cdcr/cdcr.hpp"

namespace {

using Clock = std::chrono::steady_clock;

struct Plan {
  double seconds = 60.0;  // of the loop's time
  double period = 1e-3;   // [s]
};

cdcr::Model arms(int sections) {
  cdcr::Robot robot = cdcr::amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 0.01;
  robot.sections.resize(static_cast<std::size_t>(sections), robot.sections[0]);
  return cdcr::Model(robot);
}

/// A reference that moves all the time.
cdcr::ReferencePath swing(const cdcr::Model& model, double duration) {
  const cdcr::Index d = model.num_coordinates();
  cdcr::VectorXd x = cdcr::VectorXd::Zero(d), y = x;
  for (cdcr::Index i = 0; i < d; i += 2) x[i] = y[i + 1] = 0.3;
  const cdcr::VectorXd center = cdcr::VectorXd::Zero(d);
  return cdcr::ReferencePath::circle(center, x, y, duration, duration, false);
}

/// Runs the loop and prints one row. Returns whether all steps went well.
bool measure(int sections, const Plan& plan, bool paced) {
  const cdcr::Model model = arms(sections);
  cdcr::ComputedTorqueOptions options;
  options.period = plan.period;
  options.limits.tension.min_tension = 1.0;
  cdcr::ComputedTorque controller(model, options);
  controller.set_path(swing(model, plan.seconds));
  cdcr::LoopOptions how;
  how.step = plan.period;
  cdcr::Loop loop(model, controller, how);
  const cdcr::VectorXd zero = cdcr::VectorXd::Zero(model.num_coordinates());
  loop.reset(controller.setpoint().value, zero);

  const auto count = static_cast<std::size_t>(plan.seconds / plan.period);
  std::vector<double> took(count);
  long late = 0;
  const auto start = Clock::now();
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(plan.period));
  for (std::size_t k = 0; k < count; ++k) {
    const auto due = start + static_cast<long>(k) * period;
    if (paced) std::this_thread::sleep_until(due);
    const auto begin = Clock::now();
    if (loop.step() != cdcr::Status::ok) return false;
    const auto end = Clock::now();
    took[k] = 1e6 * std::chrono::duration<double>(end - begin).count();
    if (paced ? end > due + period : end - begin > period) ++late;
  }
  std::sort(took.begin(), took.end());
  const auto share = [&](double part) {
    return took[std::min(count - 1, static_cast<std::size_t>(part * static_cast<double>(count)))];
  };
  std::printf("%8d  %-6s  %8.2f  %8.2f  %8.2f  %8.2f  %6ld of %zu\n", sections,
              paced ? "paced" : "free", share(0.5), share(0.99), share(0.999), took.back(), late,
              count);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Plan plan;
  bool fifo = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--fifo") == 0) {
      fifo = true;
    } else if (std::strcmp(argv[i], "--seconds") == 0 && i + 1 < argc) {
      plan.seconds = std::atof(argv[++i]);
    } else {
      std::fprintf(stderr,
                   "usage: %s [--seconds S] [--fifo]\n"
                   "  --seconds S  of each row, 60 unless given\n"
                   "  --fifo       with SCHED_FIFO and locked memory, where that is permitted\n",
                   argv[0]);
      return std::strcmp(argv[i], "--help") == 0 ? 0 : 2;
    }
  }
  if (!(plan.seconds >= plan.period)) {
    std::fprintf(stderr, "--seconds must be %g or more\n", plan.period);
    return 2;
  }
  if (fifo) {
    sched_param priority{};
    priority.sched_priority = sched_get_priority_max(SCHED_FIFO) / 2;
    const bool given = sched_setscheduler(0, SCHED_FIFO, &priority) == 0 &&
                       mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
    std::printf("SCHED_FIFO and locked memory: %s\n", given ? "yes" : "not permitted");
  }
  std::printf("plant (RK4) and computed torque, period %g ms; durations of a step in us\n",
              1e3 * plan.period);
  std::printf("%8s  %-6s  %8s  %8s  %8s  %8s  %s\n", "sections", "", "p50", "p99", "p99.9", "max",
              "late");
  for (const int sections : {1, 3, 8}) {
    for (const bool paced : {false, true}) {
      if (!measure(sections, plan, paced)) {
        std::fprintf(stderr, "the loop of %d sections failed\n", sections);
        return 1;
      }
    }
  }
  return 0;
}
