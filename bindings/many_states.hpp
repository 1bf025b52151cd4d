#pragma once

#include "cdcr/batch.hpp"
#include "states.hpp"

// Functions of many states at once: cdcr/batch.hpp. Each argument comes as StateRows.

namespace cdcr::python {

/// f(first, count, rows..) of blocks of states.
template <std::size_t N, class F>
void in_blocks(const States<N>& states, F&& f) {
  if (states.is_one_row()) return states.blocks(std::forward<F>(f));
  states.each([&](Index i, const auto&... rows) { f(i, Index{1}, StateRows{rows.data(), 0}...); });
}

/// An array that f(count, rows.., out) writes, an answer of shape `core` for each state.
template <std::size_t N, class F>
[[nodiscard]] py::array_t<double> arrays(const States<N>& states, std::initializer_list<Index> core,
                                         F&& f) {
  py::array_t<double> out = states.output(core);
  double* data = out.mutable_data();
  Index size = 1;
  for (const Index n : core) size *= n;
  in_blocks(states, [&](Index first, Index count, const auto&... rows) {
    f(count, rows..., data + first * size);
  });
  return out;
}

/// The same of one number: a float for one state.
template <std::size_t N, class F>
[[nodiscard]] py::object numbers(const States<N>& states, F&& f) {
  py::array_t<double> out = arrays(states, {}, std::forward<F>(f));
  if (out.ndim() == 0) return py::float_(*out.data());
  return py::object(std::move(out));
}

}  // namespace cdcr::python
