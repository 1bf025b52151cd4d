// What the largest robot needs of a thread's stack: cpp/README.md states it. A larger need ends the
// program, so there is nothing to compare.
#include <doctest/doctest.h>
#include <pthread.h>

#include "cdcr/cdcr.hpp"
#include "support/cable_robots.hpp"
#include "support/sanitizers.hpp"

namespace cdcr::test {
namespace {

#if defined(__OPTIMIZE__) && !CDCR_ADDRESS_SANITIZER && !CDCR_THREAD_SANITIZER
constexpr std::size_t larger = 1;
#else
constexpr std::size_t larger = 8;  // frames without optimisation, or with guards around variables
#endif

struct Largest {
  Model model{parts_with_cables(max_sections, 0.0, 0.0)};
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
void run_with_stack(std::size_t bytes, Body body) {
  struct Task {
    Largest largest;
    Body body;
  } task{{}, body};
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

TEST_CASE("motion of 32 sections runs in 128 kB") {
  run_with_stack(128 << 10, [](Largest& r) {
    forward_dynamics(r.model, r.data, r.q, r.qd, r.tension, r.wrenches, r.out);
    inverse_dynamics(r.model, r.data, r.q, r.qd, VectorXd(r.out), r.out);
    potential_gradient(r.model, r.data, r.q, r.out);
    VectorXd on_base(6);
    base_wrench(r.model, r.q, r.qd, r.out, r.wrenches, on_base);
    Simulator simulator(r.model);
    simulator.reset(r.q, r.qd);
    static_cast<void>(simulator.step(r.tension));
  });
}

TEST_CASE("derivatives of 32 sections, and what solves with them, run in 512 kB") {
  run_with_stack(512 << 10, [](Largest& r) {
    const Index m = r.model.num_coordinates();
    MatrixXd A(2 * m, 2 * m), B(2 * m, r.model.num_cables()), H(m, m);
    linearize(r.model, r.data, r.q, r.qd, r.tension, r.wrenches, A, B);
    potential_hessian(r.model, r.data, r.q, H);
    r.out = equilibrium(r.model, 0.01 * r.tension).q;
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
