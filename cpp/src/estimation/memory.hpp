#pragma once

#include <cmath>
#include <type_traits>
#include <vector>

#include "base/arguments.hpp"

// What estimators remember, as one vector of numbers: each visits its members, in one order, to
// write them and to read them.

namespace cdcr::detail {

/// Writes numbers one after the other.
class MemoryWriter {
 public:
  template <class Derived>
  void operator()(const Eigen::PlainObjectBase<Derived>& numbers) {
    numbers_.insert(numbers_.end(), numbers.data(), numbers.data() + numbers.size());
  }
  template <class T>
  void operator()(const std::vector<T>& numbers) {
    for (const T one : numbers) (*this)(one);
  }
  template <class T, class = std::enable_if_t<std::is_arithmetic_v<T>>>
  void operator()(T number) {
    numbers_.push_back(static_cast<double>(number));
  }
  [[nodiscard]] VectorXd memory() const {
    return Eigen::Map<const VectorXd>(numbers_.data(), static_cast<Index>(numbers_.size()));
  }

 private:
  std::vector<double> numbers_;
};

/// Counts that doubles hold, and switches, are below.
inline constexpr double largest = 1e15;

/// Reads them in that order. Throws std::invalid_argument where there are not as many.
class MemoryReader {
 public:
  MemoryReader(const VectorXd& memory, Index size) : at_(memory.data()) {
    require(memory.size() == size, "memory must be ", size, " numbers, got ", memory.size());
  }
  template <class Derived>
  void operator()(Eigen::PlainObjectBase<Derived>& numbers) {
    for (Index i = 0; i < numbers.size(); ++i) numbers.data()[i] = *at_++;
  }
  template <class T>
  void operator()(std::vector<T>& numbers) {
    for (T& one : numbers) (*this)(one);
  }
  template <class T, class = std::enable_if_t<std::is_arithmetic_v<T>>>
  void operator()(T& number) {
    require(std::abs(*at_) <= largest, "memory must be of an estimator made alike, got ", *at_,
            " for a count");
    number = static_cast<T>(*at_++);
  }

 private:
  const double* at_;
};

}  // namespace cdcr::detail
