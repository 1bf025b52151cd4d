#include "integration/collocation.hpp"

#include <Eigen/LU>
#include <cmath>

namespace cdcr::detail {
namespace {

/// P_s(x) - P_(s-1)(x) over x - 1 on [-1, 1], whose zeros are the nodes but the last.
double radau_polynomial(int s, double x) {
  double before = 1.0, value = x;
  for (int k = 2; k <= s; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return (value - before) / (x - 1.0);
}

double zero_between(int s, double low, double high) {
  const bool rising = radau_polynomial(s, low) < 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((radau_polynomial(s, middle) < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Collocation Collocation::radau(int stages) {
  Collocation method;
  method.nodes.resize(stages);
  constexpr int pieces = 400;
  Index found = 0;
  for (int k = 0; k + 1 < pieces; ++k) {
    const double low = -1.0 + 2.0 * k / pieces, high = -1.0 + 2.0 * (k + 1) / pieces;
    if ((radau_polynomial(stages, low) < 0.0) == (radau_polynomial(stages, high) < 0.0)) continue;
    method.nodes[found++] = 0.5 * (1.0 + zero_between(stages, low, high));
  }
  method.nodes[found] = 1.0;
  MatrixXd powers(stages, stages), once(stages, stages), twice(stages, stages);
  for (int i = 0; i < stages; ++i) {
    const double c = method.nodes[i];
    for (int k = 0; k < stages; ++k) {
      powers(i, k) = std::pow(c, k);
      once(i, k) = std::pow(c, k + 1) / (k + 1);
      twice(i, k) = std::pow(c, k + 2) / ((k + 1) * (k + 2));
    }
  }
  const Eigen::PartialPivLU<MatrixXd> factors(powers.transpose());
  method.once = factors.solve(once.transpose()).transpose();
  method.twice = factors.solve(twice.transpose()).transpose();
  method.error.resize(2, stages);
  const int fewer = stages - 1;
  for (int out = 0; out < 2; ++out) {
    MatrixXd some(fewer, fewer);
    for (int i = 0; i < fewer; ++i) some.col(i) = powers.row(i < out ? i : i + 1).head(fewer);
    const VectorXd weights = some.partialPivLu().solve(once.row(fewer).head(fewer).transpose());
    method.error.row(out) = method.once.row(fewer);
    for (int i = 0; i < fewer; ++i) method.error(out, i < out ? i : i + 1) -= weights[i];
  }
  return method;
}

}  // namespace cdcr::detail
