#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "cdcr/model.hpp"
#include "cdcr/wrench.hpp"

// Bytes read as robots, states and loads, for the fuzz targets; and what these demand of cdcr.
//
// A byte of zero, and every byte past the end, gives the usual value, so short inputs mean ordinary
// robots. Most other bytes give a value near the usual one; the rest give any double at all.

namespace cdcr::fuzz {

/// Ends the program, which libFuzzer reports with the input.
inline void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

/// Runs body(); a refusal in a sentence and a lack of memory are answers, all else is a fault.
template <class Body>
bool attempt(Body body) {
  try {
    body();
    return true;
  } catch (const std::invalid_argument& refusal) {
    demand(!std::string(refusal.what()).empty(), "a refusal without a sentence");
  } catch (const std::bad_alloc&) {
  }
  return false;
}

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() noexcept { return next_ < size_ ? data_[next_++] : std::uint8_t{0}; }
  /// low + 0, 1, ...
  int integer(int low, int high) { return low + byte() % (high - low + 1); }
  bool coin() { return byte() % 2 == 1; }
  bool rare() { return byte() > 247; }

  /// About as large as `usual`, which is positive; or anything.
  double positive(double usual) {
    const int b = byte();
    if (b == 0) return usual;
    return b < first_wild ? usual * std::exp2((b - 115) / 16.0) : wild(usual);
  }
  /// The same of either sign.
  double number(double usual) {
    const int b = byte();
    return b < first_wild ? usual * b / 50.0 * (b % 2 == 0 ? 1.0 : -1.0) : wild(usual);
  }
  VectorXd vector(Index size, double usual) {
    VectorXd v(size);
    for (double& value : v) value = number(usual);
    return v;
  }
  Vector3d vector3(double usual) { return vector(3, usual); }
  /// What should not be negative, such as tensions.
  VectorXd magnitudes(Index size, double usual) {
    VectorXd v(size);
    for (double& value : v) value = coin() ? positive(usual) : 0.0;
    return v;
  }
  /// The size, or now and then another.
  Index size_near(Index size) { return rare() ? Index{integer(0, 9)} : size; }

  /// Whether any number so far was none of the usual ones.
  [[nodiscard]] bool is_wild() const noexcept { return wild_; }

  Robot robot();
  std::optional<Model> model();
  Wrenches wrenches(const Model& model, int most);

 private:
  static constexpr int first_wild = 236;

  double wild(double usual);
  Section section();
  Cable cable(int num_sections);
  void add_payload(Robot& robot);

  const std::uint8_t* data_;
  std::size_t size_, next_ = 0;
  bool wild_ = false;
};

}  // namespace cdcr::fuzz
