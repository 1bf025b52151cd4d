// Functions of one state, each called at the 64 states of a spatial swing in turn.
//
// Calls do not wait for one another unless the row says "chained": there each call's state depends
// on the answer of the one before, as it does inside an integrator.
#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

void measure(const Harness& harness, const std::string& suffix, bool gravity) {
  const Model model(robot(gravity));
  const std::vector<State> states = swing(model);
  const auto state = [&states](long i) -> const State& { return states[i % 64]; };
  const VectorXd tension = Eigen::Vector3d(5.0, 1.0, 0.0);
  Data data(model);
  VectorXd out(2), q(2), qdd(2);
  MatrixXd J(6, 2), A(4, 4), B(4, 3);
  const auto nothing = [] {};

  harness.run({"forward_dynamics" + suffix}, nothing, [&](long i) {
    forward_dynamics(model, data, state(i).q, state(i).qd, tension, out);
    keep(out);
  });
  harness.run(
      {"forward_dynamics, chained" + suffix}, [&] { out.setZero(); },
      [&](long i) {
        q[0] = state(i).q[0] + 1e-300 * out[0];  // changes no digit, but has to wait for out
        q[1] = state(i).q[1] + 1e-300 * out[1];
        forward_dynamics(model, data, q, state(i).qd, tension, out);
        keep(out);
      });
  harness.run(
      {"inverse_dynamics" + suffix}, [&] { qdd << 3.0, -2.0; },
      [&](long i) {
        inverse_dynamics(model, data, state(i).q, state(i).qd, qdd, out);
        keep(out);
      });
  harness.run({"linearize" + suffix}, nothing, [&](long i) {
    linearize(model, data, state(i).q, state(i).qd, tension, A, B);
    keep(A);
    keep(B);
  });
  if (gravity) return;  // neither kinematics nor the paper knows gravity
  const Model cut(robot(false), Formulation::taylor);
  harness.run({"forward_dynamics, taylor"}, nothing, [&](long i) {
    forward_dynamics(cut, data, state(i).q, state(i).qd, tension, out);
    keep(out);
  });
  harness.run({"tip and jacobian"}, nothing, [&](long i) {
    const Pose end = tip(model, state(i).q);
    jacobian(model, state(i).q, 0, 1.0, J);
    keep(end);
    keep(J);
  });
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  const cdcr::bench::Harness harness(argc, argv);
  cdcr::bench::measure(harness, "", false);
  cdcr::bench::measure(harness, ", gravity", true);
}
