#pragma once

#include <vector>

#include "cdcr/wrench.hpp"
#include "element_sum.hpp"

// A robot of any number of sections as a plain list of rigid elements in extended precision: the
// slices of every backbone at the points of Gauss quadrature, every disk, and the payload. The
// poses of the elements are products of the sections' poses, by sines and cosines; velocities,
// energies and equations of motion follow by numerical differentiation. Nothing of the library's
// recursion enters, and no closed form.

namespace cdcr::test {

using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using RealMatrix6 = Eigen::Matrix<Real, 6, Eigen::Dynamic>;

class ChainSum {
 public:
  explicit ChainSum(const Robot& robot);

  RealMatrix mass_matrix(const RealVector& q) const;
  Real kinetic_energy(const RealVector& q, const RealVector& qd) const;
  Real potential_energy(const RealVector& q) const;
  RealVector potential_gradient(const RealVector& q) const;
  /// Lagrange: h = d/dt (dT/dqd) - dT/dq + dU/dq + c qd at qdd = 0.
  RealVector bias(const RealVector& q, const RealVector& qd) const;
  /// Virtual work of a wrench along each coordinate.
  RealVector wrench_force(const RealVector& q, const Wrench& wrench) const;

  /// Frame of the backbone in the base frame.
  Frame frame(const RealVector& q, Index section, Real fraction) const;

  /// Weight moment of all that hangs beyond the base of each section, at the full length of the
  /// arm: the scale of rounding errors in U and, for its coordinates (2n), in dU/dq.
  RealVector weight_scale() const;

 private:
  struct Element {
    Index section;
    Real fraction;
    Real mass;
    Real3 offset;    // of the centre of mass, in the frame at that fraction
    Real33 inertia;  // about the centre of mass, in that frame
  };
  /// For each element: its centre of mass, then its rotation, four columns.
  using Poses = Eigen::Matrix<Real, 3, Eigen::Dynamic>;

  void add(Index section, Real fraction, Real mass, Real diameter);
  std::vector<Frame> section_bases(const RealVector& q) const;
  Frame frame_from(const std::vector<Frame>& bases, const RealVector& q, Index section,
                   Real fraction) const;
  Poses poses(const RealVector& q) const;
  RealMatrix6 twists(const RealVector& q, const RealVector& qd) const;
  RealMatrix6 momenta(const RealMatrix6& twists) const;
  RealVector momentum(const RealVector& q, const RealVector& qd) const;

  std::vector<Real> length_;
  RealVector stiffness_, damping_;  // one for each coordinate
  Real3 gravity_;
  Real33 base_;
  std::vector<Element> elements_;
};

}  // namespace cdcr::test
