#include "section/rod_rule.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/constants.hpp"

namespace cdcr::detail {
namespace {

using Real = long double;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// A backbone this light beside the whole is none: its rule would be that of the disks alone.
constexpr Real least_backbone_share = 1e-6L;

// Of steps from frame to frame, times the number of nodes.
constexpr Real longest_step = 1.25L;

// From this many nodes on the frames are those of an even rule: that of the disks' inertia crowds
// them around the disks, where integrals between them lose digits, and is no longer needed.
constexpr int first_even = 24;

/// Points x with weights: a discrete measure on [0, 1].
using Points = std::vector<GaussPoint>;

/// Recursion coefficients of the polynomials orthogonal with respect to a measure, by Stieltjes'
/// procedure, made into the Jacobi matrix of its Gauss or Gauss-Radau rule (Golub, Welsch).
class JacobiMatrix {
 public:
  JacobiMatrix(const Points& measure, int size)
      : diagonal_(RealVector::Zero(size)), next_(RealVector::Zero(size)) {
    std::vector<Real> before(measure.size(), 0.0L), p(measure.size(), 1.0L);
    Real norm_before = 1.0L, squared = 0.0L;  // squared: the next diagonal's, over that before
    for (int k = 0; k < size; ++k) {
      Real norm = 0.0L, first = 0.0L;
      for (std::size_t i = 0; i < measure.size(); ++i) {
        const Real w = measure[i].weight * p[i] * p[i];
        norm += w;
        first += w * measure[i].x;
      }
      if (k == 0) total_ = norm;
      squared = k == 0 ? 0.0L : norm / norm_before;
      diagonal_[k] = first / norm;
      next_[k] = std::sqrt(squared);
      norm_before = norm;
      // The polynomial at x = 1 goes along, for the rule that has a node there.
      const Real end = (1.0L - diagonal_[k]) * end_ - squared * end_before_;
      if (k + 1 == size) break;
      end_before_ = end_;
      end_ = end;
      for (std::size_t i = 0; i < measure.size(); ++i) {
        const Real q = (measure[i].x - diagonal_[k]) * p[i] - squared * before[i];
        before[i] = p[i];
        p[i] = q;
      }
    }
    last_squared_ = squared;
  }

  /// Makes x = 1 the last node.
  void fix_end() { diagonal_[diagonal_.size() - 1] = 1.0L - last_squared_ * end_before_ / end_; }

  [[nodiscard]] Points rule() const {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>> solver;
    solver.computeFromTridiagonal(diagonal_, next_.tail(next_.size() - 1));
    Points points;
    for (Index k = 0; k < diagonal_.size(); ++k) {
      const Real v = solver.eigenvectors()(0, k);
      points.push_back({solver.eigenvalues()[k], total_ * v * v});
    }
    return points;
  }

 private:
  RealVector diagonal_, next_;
  Real total_ = 0.0L, end_before_ = 0.0L, end_ = 1.0L, last_squared_ = 0.0L;
};

/// Cardinal function: 1 at node j, 0 at the others.
Real cardinal(const std::vector<Real>& nodes, std::size_t j, Real x) {
  Real value = 1.0L;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (k != j) value *= (x - nodes[k]) / (nodes[j] - nodes[k]);
  }
  return value;
}

/// Points whose weights are masses [kg], and the same of moments of inertia I_t [kg m^2].
struct Measures {
  Points mass, inertia;
};

Measures measures_of(const RodMass& rod) {
  const Real inner = static_cast<Real>(rod.inner_diameter) * rod.inner_diameter;
  const auto squared_diameter = [&](Real x) {
    const Real d =
        rod.base_diameter + x * (static_cast<Real>(rod.tip_diameter) - rod.base_diameter);
    return d * d;
  };
  Real volume = 0.0L;
  for (const auto& [x, weight] : gauss_legendre()) volume += weight * (squared_diameter(x) - inner);
  Measures measures;
  for (const auto& [x, weight] : gauss_legendre()) {
    const Real d2 = squared_diameter(x);
    const Real m = rod.backbone_mass * weight * (d2 - inner) / volume;
    measures.mass.push_back({x, m});
    measures.inertia.push_back({x, m * (d2 + inner) / 16.0L});
  }
  for (const Disk& disk : rod.disks) {
    const Real d = disk.diameter;
    measures.mass.push_back({disk.position, disk.mass});
    measures.inertia.push_back({disk.position, disk.mass * d * d / 16.0L});
  }
  return measures;
}

/// Weights at the nodes that sum up polynomials as the measure does, as far as these are enough.
std::vector<Real> interpolated(const Points& measure, const std::vector<Real>& nodes) {
  std::vector<Real> weights(nodes.size(), 0.0L);
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    for (const auto& [x, weight] : measure) weights[j] += weight * cardinal(nodes, j, x);
  }
  return weights;
}

/// Weights of the integral from one place to another, by the polynomial that has f and df/dx at
/// these nodes (Hermite).
std::array<RodNode::Weight, num_neighbours> hermite_integral(const std::vector<Real>& nodes,
                                                             Real from, Real to) {
  std::array<RodNode::Weight, num_neighbours> weights{};
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    Real steepness = 0.0L;  // of the cardinal function at its node
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (k != j) steepness += 1.0L / (nodes[j] - nodes[k]);
    }
    Real value = 0.0L, slope = 0.0L;
    for (const auto& [fraction, weight] : gauss_legendre()) {
      const Real x = from + fraction * (to - from), beside = x - nodes[j];
      const Real l = cardinal(nodes, j, x), share = (to - from) * weight * l * l;
      value += share * (1.0L - 2.0L * steepness * beside);
      slope += share * beside;
    }
    weights[j] = {static_cast<double>(value), static_cast<double>(slope)};
  }
  return weights;
}

/// Nodes and weights of the Gauss-Lobatto rule of a measure: the base and this many more, the last
/// of them the tip. With the base known, the others are the Gauss-Radau rule of x times the
/// measure.
Points lobatto_rule(Points measure, int num_nodes) {
  Real total = 0.0L;
  for (GaussPoint& point : measure) {
    total += point.weight;
    point.weight *= point.x;
  }
  JacobiMatrix jacobi(measure, num_nodes);
  jacobi.fix_end();
  Points rule{{0.0L, total}};
  for (const GaussPoint& point : jacobi.rule()) {
    const Real weight = point.weight / point.x;
    rule.push_back({point.x, weight});
    rule.front().weight -= weight;
  }
  rule.back().x = 1.0L;
  return rule;
}

/// The rule of an even measure, with weights of interpolation for this one.
Points even_rule(const Points& measure, int num_nodes) {
  Points rule = lobatto_rule(gauss_legendre(), num_nodes);
  std::vector<Real> nodes;
  for (const GaussPoint& point : rule) nodes.push_back(point.x);
  const std::vector<Real> weights = interpolated(measure, nodes);
  for (std::size_t k = 0; k < rule.size(); ++k) rule[k].weight = weights[k];
  return rule;
}

/// The rule of a rod's mass; the even one where the backbone has next to none, since it would be
/// that of the disks alone.
Points rule_of(const Points& measure, int num_nodes) {
  Real total = 0.0L, disks = 0.0L;
  for (std::size_t i = 0; i < measure.size(); ++i) {
    total += measure[i].weight;
    if (i >= gauss_legendre().size()) disks += measure[i].weight;
  }
  if (total - disks > least_backbone_share * total) return lobatto_rule(measure, num_nodes);
  return even_rule(measure, num_nodes);
}

/// Appends a step.
void add_step(RodSteps& steps, Real from, Real to) {
  const auto alpha = step_of(from, to);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= max_legendre_order; ++j) {
      steps.weights[i][j][steps.count] = alpha[i][j];
    }
  }
  ++steps.count;
}

}  // namespace

std::vector<GaussPoint> gauss_legendre(int count) {
  std::vector<GaussPoint> all;
  for (int k = 1; k <= count; ++k) {  // Newton's method, which rounds less than eigenvalues
    Real s = -std::cos(pi * (k - 0.25L) / (count + 0.5L)), slope = 1.0L;
    for (int iteration = 0; iteration < 20; ++iteration) {
      Real before = 1.0L, p = s;
      for (int j = 1; j < count; ++j) {
        const Real next = ((2 * j + 1) * s * p - j * before) / (j + 1);
        before = p;
        p = next;
      }
      slope = count * (before - s * p) / (1.0L - s * s);
      s -= p / slope;
    }
    all.push_back({(1.0L + s) / 2.0L, 1.0L / ((1.0L - s * s) * slope * slope)});
  }
  return all;
}

const std::vector<GaussPoint>& gauss_legendre() {
  static const std::vector<GaussPoint> points = gauss_legendre(40);
  return points;
}

RodRule::RodRule(const RodMass& rod, int num_nodes) {
  const Measures measures = measures_of(rod);
  const Points by_mass = rule_of(measures.mass, num_nodes);
  const int num_frames = std::max(num_nodes - 2, num_neighbours - 1);
  const Points by_inertia = num_nodes < first_even ? rule_of(measures.inertia, num_frames)
                                                   : even_rule(measures.inertia, num_frames);

  std::vector<Real> at;
  for (const auto& [x, weight] : by_inertia) {
    const std::size_t k = at.size();
    const auto P = detail::legendre(x), slope = detail::legendre_slope(x);
    for (std::size_t j = 0; j < P.size(); ++j) {
      legendre[j][k] = static_cast<double>(P[j]);
      legendre_slope[j][k] = static_cast<double>(slope[j]);
    }
    this->inertia[k] = static_cast<double>(weight);
    if (!at.empty()) {
      const Real gap = x - at.back();
      const int parts = static_cast<int>(std::ceil(gap * num_nodes / longest_step));
      for (int i = 0; i < parts; ++i) {
        add_step(steps, at.back() + gap * i / parts, at.back() + gap * (i + 1) / parts);
      }
    }
    at.push_back(x);
    frames.push_back({static_cast<double>(x), steps.count});
  }
  steps.count += steps.count % 2;

  for (std::size_t k = 1; k < by_mass.size(); ++k) {
    const Real from = by_mass[k - 1].x, to = by_mass[k].x;
    mass[k - 1] = static_cast<double>(by_mass[k].weight);
    RodNode node{static_cast<double>(to), 0, {}};
    // As many frames on either side of the middle, as far as there are.
    const auto above = std::lower_bound(at.begin(), at.end(), (from + to) / 2.0L);
    node.first_neighbour = std::clamp(static_cast<int>(above - at.begin()) - num_neighbours / 2, 0,
                                      static_cast<int>(at.size()) - num_neighbours);
    const auto first = at.begin() + node.first_neighbour;
    node.integral = hermite_integral({first, first + num_neighbours}, from, to);
    nodes.push_back(node);
  }
}

}  // namespace cdcr::detail
