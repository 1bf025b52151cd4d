#pragma once

#include <cmath>
#include <vector>

#include "cdcr/dynamics.hpp"
#include "cdcr/simulate.hpp"

// Small helpers of the tests that run a robot through time.

namespace cdcr::test {

inline VectorXd even_times(double start, double end, Index count) {
  return VectorXd::LinSpaced(count, start, end);
}

inline CommandInput no_tension(const Model& model) {
  return CommandInput::constant(VectorXd::Zero(model.num_cables()));
}

inline Options tolerances(double rtol, double atol) {
  Options options;
  options.rtol = rtol;
  options.atol = atol;
  options.max_steps = 100000000;
  return options;
}

/// As exact as Dormand-Prince gets in double precision.
inline Options tightest() {
  return tolerances(1e-13, 1e-15);
}

inline Options fixed_step(double step) {
  Options options;
  options.step = step;
  options.max_steps = 100000000;
  return options;
}

inline double total_energy(const Model& model, const VectorXd& q, const VectorXd& qd) {
  Data data(model);
  return kinetic_energy(model, data, q, qd) + potential_energy(model, data, q);
}

/// Total energy at each sample.
inline VectorXd total_energies(const Model& model, const Trajectory& run) {
  VectorXd energies(run.t.size());
  for (Index i = 0; i < run.t.size(); ++i) {
    energies[i] = total_energy(model, run.q.row(i).transpose(), run.qd.row(i).transpose());
  }
  return energies;
}

/// Slope of the least-squares line through (log x, log y): the order of y = C x^order.
inline double fitted_order(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace cdcr::test
