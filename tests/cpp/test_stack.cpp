// What the largest robot needs of a thread's stack: cpp/README.md states it. A larger need ends the
// program, so there is nothing to compare.
#include <doctest/doctest.h>
#include <pthread.h>

#include "cdcr/cdcr.hpp"
#include "support/cable_robots.hpp"
#include "support/cases.hpp"
#include "support/sanitizers.hpp"

namespace cdcr::test {
namespace {

#if defined(__OPTIMIZE__) && !CDCR_ADDRESS_SANITIZER && !CDCR_THREAD_SANITIZER
constexpr std::size_t larger = 1;
#else
constexpr std::size_t larger = 8;  // frames without optimisation, or with guards around variables
#endif

/// The most that a rod can have, twice.
Robot two_rods() {
  Robot robot = amouri2020();
  Section& rod = robot.sections[0];
  rod.bending_order = 4;
  rod.twist_order = rod.stretch_order = 4;
  rod.cable_friction = 0.1;
  rod.shear_modulus = 0.4 * rod.youngs_modulus;
  rod.nodes = 32;
  robot.sections.push_back(rod);
  robot.presliding_stiffness = 1e4;
  return robot;
}

struct Largest {
  explicit Largest(const Robot& robot) : model(robot) {}

  Model model;
  Data data{model};
  VectorXd q = VectorXd::Constant(model.num_coordinates(), 0.02);
  VectorXd qd = VectorXd::Constant(model.num_coordinates(), 0.1);
  VectorXd tension = VectorXd::Ones(model.num_cables());
  VectorXd out = VectorXd::Zero(model.num_coordinates());
  Wrenches wrenches = {Wrench{}};
  bool done = false;
};

/// body(largest) on a thread of its own with so many bytes of stack.
template <class Body>
void run_with_stack(const Robot& robot, std::size_t bytes, Body body) {
  struct Task {
    Largest largest;
    Body body;
  } task{Largest(robot), body};
  pthread_attr_t attributes;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstacksize(&attributes, larger * bytes) == 0);
  const auto start = [](void* given) -> void* {
    auto* own = static_cast<Task*>(given);
    own->body(own->largest);
    own->largest.done = true;
    return nullptr;
  };
  pthread_t thread{};
  REQUIRE(pthread_create(&thread, &attributes, start, &task) == 0);
  REQUIRE(pthread_join(thread, nullptr) == 0);
  CHECK(pthread_attr_destroy(&attributes) == 0);
  CHECK(task.largest.done);
  CHECK(task.largest.out.allFinite());
}

TEST_SUITE_BEGIN("stack");

void move(Largest& r) {
  forward_dynamics(r.model, r.data, r.q, r.qd, r.tension, r.wrenches, r.out);
  inverse_dynamics(r.model, r.data, r.q, r.qd, VectorXd(r.out), r.out);
  potential_gradient(r.model, r.data, r.q, r.out);
  VectorXd on_base(6);
  base_wrench(r.model, r.q, r.qd, r.out, r.wrenches, on_base);
  Simulator simulator(r.model);
  simulator.reset(r.q, r.qd);
  static_cast<void>(simulator.step(r.tension));
}

void differentiate(Largest& r) {
  const Index m = r.model.num_coordinates();
  MatrixXd A(2 * m, 2 * m), B(2 * m, r.model.num_cables()), H(m, m);
  linearize(r.model, r.data, r.q, r.qd, r.tension, r.wrenches, A, B);
  potential_hessian(r.model, r.data, r.q, H);
  static_cast<void>(modes(r.model, r.q, 0.01 * r.tension));
  r.out = equilibrium(r.model, 0.01 * r.tension).q;
}

TEST_CASE("motion of 32 sections runs in 128 kB, what differentiates it in 512 kB") {
  const Robot arcs = parts_with_cables(max_sections, 0.0, 0.0);
  run_with_stack(arcs, 128 << 10, move);
  run_with_stack(arcs, 512 << 10, differentiate);
}

TEST_CASE("motion of rods runs in 512 kB, what differentiates it in 2 MB") {
  run_with_stack(two_rods(), 512 << 10, move);
  run_with_stack(two_rods(), 2 << 20, differentiate);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
