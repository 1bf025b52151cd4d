// Methods bdf and adams where memory runs out: at each allocation of a run in turn.
#include <doctest/doctest.h>

#include <new>

#include "integration/sundials_handles.hpp"
#include "support/allocations.hpp"
#include "support/child.hpp"
#include "support/cvode_runs.hpp"

namespace cdcr::test {
namespace {

/// A short run; under tension, or with cables driven by length, whose slack is looked for.
Trajectory short_run(const Model& model, Method method) {
  VectorXd command(model.num_cables());
  rest_command(model, command);
  return simulate(model, Eigen::Vector2d(0.1, 0.0), VectorXd::Zero(2), Eigen::Vector2d(0.0, 0.01),
                  CommandInput::constant(command), method, Options(), make_cvode_integrator);
}

// Built without its error checks, SUNDIALS 7 writes to what it got from malloc without a look at
// it.
#if SUNDIALS_VERSION_MAJOR >= 7 && !defined(SUNDIALS_ENABLE_ERROR_CHECKS)
constexpr bool sundials_checks = false;
#else
constexpr bool sundials_checks = true;
#endif

/// What SUNDIALS allocates for a context, where no version of it is safe.
long allocations_of_context() {
  return allocations_of([] {
    SUNContext context = nullptr;
    detail::create(&context);
    const detail::Owner<SUNContext> owner(context);
  });
}

TEST_SUITE_BEGIN("cvode_memory");

TEST_CASE("an allocation that fails is an exception, not a crash" *
          doctest::skip(!allocations_counted || !sundials_checks)) {
  const long crashes_of_sundials = allocations_of_context();
  REQUIRE(crashes_of_sundials < 10);
  for (const double stiffness : {0.0, 1e3}) {
    Robot robot = amouri2020();
    robot.sections[0].cable_stiffness = stiffness;
    const Model model(robot);
    for (const Method method : {Method::bdf, Method::adams}) {
      const long all = allocations_of([&] { short_run(model, method); });
      REQUIRE(all > 50);
      int crashes = 0;
      for (long n = 0; n < all; ++n) {
        const int signal = signal_of([&] {
          fail_allocation(n);
          try {
            short_run(model, method);
          } catch (const std::bad_alloc&) {
          } catch (const std::runtime_error&) {  // a code of SUNDIALS that does not say why
          }
        });
        if (signal != 0) ++crashes;
      }
      CHECK(crashes <= crashes_of_sundials);
    }
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
