#pragma once

#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <vector>

#include "base/lanes.hpp"
#include "base/pack.hpp"
#include "cdcr/batch.hpp"

namespace cdcr::detail {

/// An argument of many states, or an answer, of so many numbers each.
struct Argument {
  StateRows rows;
  Index size;
};
struct Answer {
  double* data;  // null: not wanted
  Index size;
};

/// f(size), as a constant where it is that of vectors of one section: coordinates, cables.
template <class F>
void with_size(Index size, const F& f) {
  if (size == 2) return f(std::integral_constant<Index, 2>());
  if (size == 3) return f(std::integral_constant<Index, 3>());
  if (size == 4) return f(std::integral_constant<Index, 4>());
  f(size);
}

/// The arguments of a pack of states from `first` on, state(lane) of them in each lane.
template <class P, class State>
[[gnu::always_inline]] inline void gather(std::initializer_list<Argument> arguments, Index first,
                                          const State& state, P* to) {
  for (const Argument& argument : arguments) {
    const Index apart = argument.rows.apart;
    const double* rows = argument.rows.data + first * apart;
    with_size(argument.size, [&](auto size) {
      for (Index i = 0; i < size; ++i) {
        to[i] = P::of_lanes([&](Index lane) { return rows[state(lane) * apart + i]; });
      }
    });
    to += argument.size;
  }
}

/// An answer about a pack of states from `first` on, of which there are so many.
template <class P>
[[gnu::always_inline]] inline void scatter(const Answer& answer, Index first, Index count,
                                           const P* from) {
  with_size(answer.size, [&](auto size) {
    double* row = answer.data + first * answer.size;
    for (Index lane = 0; lane < count; ++lane, row += size) {
      for (Index i = 0; i < size; ++i) row[i] = get_lane(from[i], lane);
    }
  });
}

/// f(in, out) of packs of states in registers of W: all arguments of a pack one after another, and
/// room for its answers likewise.
template <int W, class P, class F>
void in_packs(Index count, std::initializer_list<Argument> arguments,
              std::initializer_list<Answer> answers, const F& f) {
  Index num_in = 0, num_out = 0;
  for (const Argument& argument : arguments) num_in += argument.size;
  for (const Answer& answer : answers) num_out += answer.size;
  std::vector<P> room(static_cast<std::size_t>(num_in + num_out));
  P *in = room.data(), *out = in + num_in;
  in_lanes_of(std::integral_constant<int, W>(), [&](auto /*width*/) {
    for (Index first = 0; first < count; first += P::size) {
      const Index last = count - 1 - first;
      if (last >= P::size - 1) {
        gather(arguments, first, [](Index lane) { return lane; }, in);
      } else {  // the last again where there are too few
        gather(arguments, first, [last](Index lane) { return std::min(lane, last); }, in);
      }
      f(static_cast<const P*>(in), out);
      const P* from = out;
      for (const Answer& answer : answers) {
        if (answer.data != nullptr)
          scatter(answer, first, std::min(last + 1, Index{P::size}), from);
        from += answer.size;
      }
    }
  });
}

/// The vector of one state.
[[nodiscard]] inline Eigen::Map<const VectorXd> row(const StateRows& rows, Index i, Index size) {
  return {rows.data + i * rows.apart, size};
}

}  // namespace cdcr::detail
