// What is paid once: a model with its polynomials, and a simulator around it.
#include "harness.hpp"
#include "scenario.hpp"

int main(int argc, char** argv) {
  using namespace cdcr;
  const bench::Harness harness(argc, argv);
  const Robot robot = bench::robot(true);
  const Model model(robot);
  harness.run(
      {"Model(robot)", "us", 1, 500}, [] {}, [&](long /*i*/) { bench::keep(Model(robot)); });
  harness.run(
      {"Simulator(model)", "us", 1, 500}, [] {},
      [&](long /*i*/) { bench::keep(Simulator(model)); });
}
