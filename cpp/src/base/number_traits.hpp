#pragma once

#include <Eigen/Core>

namespace cdcr::detail {

/// What Eigen hears of several doubles that count as one real number.
template <class Number>
struct NumberTraits : Eigen::GenericNumTraits<Number> {
  enum {  // NOLINTBEGIN(readability-identifier-naming): names of Eigen
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };  // NOLINTEND(readability-identifier-naming)
};

}  // namespace cdcr::detail
