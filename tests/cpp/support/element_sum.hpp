#pragma once

#include <array>
#include <functional>
#include <vector>

#include "cdcr/robot.hpp"
#include "cdcr/types.hpp"

// The section as a plain list of rigid elements, slow and obvious, in extended precision: the
// backbone is cut into slices at the points of Gauss quadrature, each disk and the payload is one
// element. From an element come its position and rotation, by sines and cosines alone; all else
// follows by numerical differentiation. Nothing of the library's own derivation enters.

namespace cdcr::test {

using Real = long double;
using Real2 = Eigen::Matrix<Real, 2, 1>;
using Real22 = Eigen::Matrix<Real, 2, 2>;
using Real3 = Eigen::Matrix<Real, 3, 1>;
using Real33 = Eigen::Matrix<Real, 3, 3>;

/// Position and rotation at fraction x of a section, paper eqs. (1), (2).
struct Frame {
  Real3 r;
  Real33 R;
};
Frame frame_at(Real length, Real x, const Real2& q);

/// Nodes and weights on [0, 1], exact for polynomials up to degree 39.
constexpr int num_gauss = 20;
struct Quadrature {
  std::array<Real, num_gauss> node, weight;
};
const Quadrature& gauss();

/// Central difference of eighth order, step h: error about h^8 f^(9)/630 plus rounding/h.
template <class Value>
Value derivative(const std::function<Value(Real)>& f, Real h = 0.01L) {
  Value sum = (f(h) - f(-h)) * (4.0L / 5.0L);
  sum -= (f(2 * h) - f(-2 * h)) * (1.0L / 5.0L);
  sum += (f(3 * h) - f(-3 * h)) * (4.0L / 105.0L);
  sum -= (f(4 * h) - f(-4 * h)) * (1.0L / 280.0L);
  return sum / h;
}

class ElementSum {
 public:
  explicit ElementSum(const Robot& robot);

  Real22 mass_matrix(const Real2& q) const;
  Real kinetic_energy(const Real2& q, const Real2& qd) const;
  Real potential_energy(const Real2& q) const;
  Real2 potential_gradient(const Real2& q) const;
  Real22 potential_hessian(const Real2& q) const;
  /// Lagrange: h = d/dt (dT/dqd) - dT/dq + dU/dq + c qd at qdd = 0.
  Real2 bias(const Real2& q, const Real2& qd) const;

  /// sum m x^2 (1 - cos y)/y^2 and sum m x sin y / y, with y = x theta.
  Real G_A(Real theta) const;
  Real G_S(Real theta) const;

  /// Largest weight moment there can be: the scale of rounding errors in U.
  Real weight_scale() const;
  Real total_mass() const;

 private:
  struct Element {
    Real x, mass, transverse, axial;  // fraction of the length [-], [kg], [kg m^2] twice
  };
  Real length_, stiffness_, damping_;
  Real3 gravity_;
  std::vector<Element> elements_;
};

}  // namespace cdcr::test
