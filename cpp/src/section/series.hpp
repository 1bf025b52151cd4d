#pragma once

#include <vector>

#include "cdcr/robot.hpp"

namespace cdcr::detail {

/// Coefficients of sigma^0, sigma^1, ...; extended precision because re-centring cancels digits.
using Series = std::vector<long double>;

/// The four functions of sigma = theta^2 that hold all of one section's inertia and weight
/// (cpp/README.md, eqs. (9), (10), (13), (14)).
struct SectionSeries {
  Series a;    ///< M = a I + b q q^T [kg m^2]
  Series b;    ///< [kg m^2]
  Series G_A;  ///< sum m x^2 A(x theta) [kg]
  Series G_S;  ///< sum m x S(x theta) [kg]
};

/// Power series about the straight section, exact up to the last term kept.
[[nodiscard]] SectionSeries exact_series(const Section& section, double payload);

/// The paper's factors as printed, made consistent (paper_series.cpp).
[[nodiscard]] SectionSeries printed_series(const Section& section, double payload);

/// M11 and M22 cut after theta^4; weight is left whole.
[[nodiscard]] SectionSeries cut_after_fourth_power(SectionSeries series);

}  // namespace cdcr::detail
