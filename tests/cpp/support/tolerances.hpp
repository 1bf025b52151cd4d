#pragma once

// Every tolerance of the laws, relative unless said otherwise, each ten times the largest
// residual seen or more: tools/residuals.sh shows those above a tenth.

namespace cdcr::test::tolerance {

/// A handful of operations on numbers of the size of the scale.
constexpr double rounding = 2e-14;
/// Differences of numbers that cancel a digit or two.
constexpr double cancelled = 1e-13;

/// Mass matrix, energies and bias against the sum over elements.
constexpr double model = 5e-14;
/// Second derivatives: as far as differences in extended precision can tell.
constexpr double model_second = 2e-13;
/// Closed forms of the paper, which cancel up to four digits at the smallest theta tried.
constexpr double printed = 4e-12;
/// Derivatives by differences of sixth order in double precision.
constexpr double differences = 2e-9;

/// Recursions over many sections: a rounding or two for each, relative to the terms that are added;
/// forward dynamics after inverse dynamics over the condition of the mass matrix.
constexpr double recursion = 3e-13;
/// The same where gravity is turned: weights cancel, and rotations are orthonormal to rounding.
constexpr double turned = 1e-12;
/// Derivatives of energies and forces by differences of eighth order, in steps of 0.02 rad.
constexpr double recursion_differences = 1e-11;
/// Lagrange's equations by the same differences, of products of energies and rates.
constexpr double lagrange = 2e-11;
/// The same of accelerations, which change faster: steps of 0.003 rad.
constexpr double linearized = 1e-9;

/// Slope of the distance at the nearest point: a minimum is found to the root of rounding.
constexpr double stationary = 1e-7;
/// Unbalanced moment at an equilibrium over the moments in balance.
constexpr double at_rest = 1e-14;

/// States of Dormand-Prince runs at the tightest tolerances, over a few swings.
constexpr double run = 4e-12;
/// The same of order 8, which meets tolerances as closely, with fewer steps.
constexpr double dop853_run = 5e-11;
/// The same of Runge-Kutta with steps of 1 ms.
constexpr double rk4_run = 4e-8;
/// Work against energy over two seconds at rtol 1e-12.
constexpr double balance = 4e-12;
/// What is conserved over a hundred seconds at rtol 1e-12.
constexpr double conserved = 2e-9;

}  // namespace cdcr::test::tolerance
