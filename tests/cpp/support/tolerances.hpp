#pragma once

// Every tolerance of the laws, relative unless said otherwise. A residual is a largest difference
// over a largest magnitude. CDCR_TOL_SCALE=0 prints the true residuals.

namespace cdcr::test::tolerance {

/// A handful of operations on numbers of the size of the scale.
constexpr double rounding = 1e-14;
/// Differences of numbers that cancel some digits.
constexpr double cancelled = 1e-12;
/// Mass matrix, energies and bias against the sum over elements.
constexpr double model = 1e-14;
/// Second derivatives with respect to q, which the series lose digits to.
constexpr double model_second = 1e-12;
/// Positions over the length, rotations and Jacobians.
constexpr double frame = 1e-14;
/// Slope of the distance at the nearest point: a minimum is found to the root of rounding.
constexpr double stationary = 1e-7;
/// Closed forms in double precision that cancel up to six digits at small theta.
constexpr double printed = 1e-10;
/// Derivatives by differences of sixth order in double precision.
constexpr double differences = 1e-9;
/// Unbalanced moment at an equilibrium over the moments in balance.
constexpr double at_rest = 1e-12;
/// Energy and momentum balances along runs at rtol 1e-12.
constexpr double balance = 1e-9;
/// States of runs at the tightest tolerances, a few seconds long.
constexpr double straight = 1e-10;

}  // namespace cdcr::test::tolerance
