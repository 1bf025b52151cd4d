#pragma once

namespace cdcr::test {

/// df/ds at s = 0: central difference of eighth order in double precision, with steps of h.
template <class Function>
auto difference(const Function& f, double h) {
  using Value = decltype(f(h));
  Value sum = (f(h) - f(-h)) * (4.0 / 5.0);
  sum -= (f(2 * h) - f(-2 * h)) * (1.0 / 5.0);
  sum += (f(3 * h) - f(-3 * h)) * (4.0 / 105.0);
  sum -= (f(4 * h) - f(-4 * h)) * (1.0 / 280.0);
  return Value(sum / h);
}

}  // namespace cdcr::test
