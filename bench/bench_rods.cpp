// Rods, sections whose bending, twist and stretch vary along them: forward dynamics of one state
// under the tensions of straight cables, three a section.
//
// The robot of Table 1, its base tilted by 30 degrees, with rods in place of its section.
#include <memory>
#include <random>

#include "chain/forward.hpp"
#include "harness.hpp"
#include "scenario.hpp"
#include "section/rod.hpp"
#include "section/rod_cable.hpp"

namespace cdcr::bench {
namespace {

constexpr double pi = 4.0 * quarter_pi;

/// A rod of these orders, -1 for none.
detail::RodDescription described(const Section& s, int bending, int twist, int stretch) {
  detail::RodDescription rod;
  rod.length = s.length;
  rod.mass = {s.backbone_mass, s.backbone_diameter, s.backbone_diameter, 0.0, s.disks()};
  rod.youngs_modulus = s.youngs_modulus;
  rod.shear_modulus = s.youngs_modulus / 2.6;
  rod.bending_order = bending;
  rod.twist_order = twist;
  rod.stretch_order = stretch;
  return rod;
}

void measure(const Harness& harness, const Plan& plan, int num_sections,
             const detail::RodDescription& described) {
  const Robot table_1 = robot(true);
  const auto rod = std::make_shared<const detail::RodParameters>(described);
  detail::Chain chain(table_1);
  chain.sections.resize(static_cast<std::size_t>(num_sections), chain.sections[0]);
  chain.first = {0};
  for (detail::SectionParameters& section : chain.sections) {
    section.rod = rod;
    chain.first.push_back(chain.first.back() + rod->size());
  }
  std::vector<detail::RodCable> cables;  // in one section
  const double radius = table_1.sections[0].cable_radius;
  for (const double angle : {0.0, 2.0 * pi / 3.0, 4.0 * pi / 3.0}) {
    cables.emplace_back(*rod, CableRoute{radius, radius, angle, angle});
  }

  constexpr int num_states = 64;
  const Index m = chain.num_coordinates();
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<State> states(num_states);
  for (State& state : states) {
    state.q = VectorXd::NullaryExpr(m, [&] { return unit(engine); });
    state.qd = VectorXd::NullaryExpr(m, [&] { return 3.0 * unit(engine); });
    for (int i = 0; i < num_sections; ++i) {  // stretch is in metres
      for (Index k = chain.first[i] + rod->first_stretch; k < chain.first[i + 1]; ++k) {
        state.q[k] *= 0.05 * rod->length;
        state.qd[k] *= 0.05 * rod->length;
      }
    }
  }
  const auto moving = std::make_unique<detail::ChainState<detail::Rod<double>>>();
  VectorXd force(m), qdd(m);
  harness.run(
      plan, [] {},
      [&](long i) {
        const State& state = states[static_cast<std::size_t>(i % num_states)];
        moving->update(chain, state.q.data(), state.qd.data());
        force.setZero();
        // Each section's own cables pass the sections before it too.
        for (int last = 0; last < num_sections; ++last) {
          for (const detail::RodCable& cable : cables) {
            for (int k = 0; k <= last; ++k) {
              cable.length(*rod, state.q.data() + chain.first[k], 1.0,
                           force.data() + chain.first[k]);
            }
          }
        }
        detail::forward_dynamics(chain, *moving, force.data(), qdd.data());
        keep(qdd);
      });
}

/// The derivatives of so many rods of order 2 with twist, under the cables of Table 1 on each.
void measure_derivatives(const Harness& harness, const Plan& plan, int num_sections) {
  Robot robot = bench::robot(true);
  Section& section = robot.sections[0];
  section.bending_order = 2;
  section.twist_order = 0;
  section.shear_modulus = section.youngs_modulus / 2.6;
  robot.sections.assign(static_cast<std::size_t>(num_sections), Section(section));
  const Model model(robot);
  Data data(model);
  const Index d = model.num_coordinates();
  const VectorXd q = VectorXd::Constant(d, 0.2), qd = VectorXd::Constant(d, 0.5),
                 tension = VectorXd::Ones(model.num_cables());
  MatrixXd A(2 * d, 2 * d), B(2 * d, model.num_cables());
  harness.run(
      plan, [] {},
      [&](long /*i*/) {
        linearize(model, data, q, qd, tension, A, B);
        keep(A);
      });
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  using namespace cdcr::bench;
  const Harness harness(argc, argv);
  const cdcr::Section section = robot(false).sections[0];
  const auto plan = [](const char* name) { return Plan{name, "us", 100, 1000}; };
  measure(harness, plan("forward_dynamics, rod of order 2 with twist"), 1,
          described(section, 2, 0, -1));
  measure(harness, plan("forward_dynamics, rod of order 3 with twist and stretch"), 1,
          described(section, 3, 0, 0));
  measure(harness, plan("forward_dynamics, 3 rods of order 2 with twist"), 3,
          described(section, 2, 0, -1));
  measure_derivatives(harness, {"linearize, rod of order 2 with twist", "us", 10, 1000}, 1);
  measure_derivatives(harness, {"linearize, 3 rods of order 2 with twist", "us", 10, 1000}, 3);
}
