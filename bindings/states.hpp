#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "cdcr/dynamics.hpp"
#include "gil.hpp"

namespace cdcr::python {

/// Refuses an argument whose leading dimensions do not broadcast with those of the ones before it.
[[noreturn]] void refuse_leading(const StateArgument& argument, const std::vector<Index>& before);

/// Arguments of one state each, or of arrays of states, broadcast against one another by NumPy's
/// rules. A function of one state is called for each state; without the GIL where there are many.
template <std::size_t N>
class States {
 public:
  template <class... Arguments>
  explicit States(Arguments&&... arguments) : arguments_{std::forward<Arguments>(arguments)...} {
    const auto many = [](const StateArgument& argument) { return argument.array.ndim() > 1; };
    if (std::any_of(arguments_.begin(), arguments_.end(), many)) broadcast();
  }

  /// f(rows..) of each state: a float for one state, else an array.
  template <class F>
  [[nodiscard]] py::object values(F&& f) const {
    if (dimensions_.empty()) {
      double value = 0.0;
      each([&](Index, const auto&... rows) { value = f(rows...); });
      return py::float_(value);
    }
    py::array_t<double> out = output({});
    double* data = out.mutable_data();
    each([&](Index i, const auto&... rows) { data[i] = f(rows...); });
    return py::object(std::move(out));
  }

  /// f(rows.., vector) of each state, which writes the vector: (.., size).
  template <class F>
  [[nodiscard]] py::array_t<double> vectors(Index size, F&& f) const {
    py::array_t<double> out = output({size});
    double* data = out.mutable_data();
    each([&](Index i, const auto&... rows) {
      Eigen::Map<VectorXd> vector(data + i * size, size);
      f(rows..., vector);
    });
    return out;
  }

  /// f(rows.., matrix) of each state, which writes the matrix: (.., num_rows, num_columns).
  template <class F>
  [[nodiscard]] py::array_t<double> matrices(Index num_rows, Index num_columns, F&& f) const {
    py::array_t<double> out = output({num_rows, num_columns});
    double* data = out.mutable_data();
    MatrixXd matrix(num_rows, num_columns);
    each([&](Index i, const auto&... rows) {
      f(rows..., matrix);
      Eigen::Map<RowMatrixXd>(data + i * matrix.size(), num_rows, num_columns) = matrix;
    });
    return out;
  }

  /// An array with room for one answer of shape `core` for each state.
  [[nodiscard]] py::array_t<double> output(std::initializer_list<Index> core) const {
    if (dimensions_.empty()) return py::array_t<double>(core);
    std::vector<Index> shape = sizes();
    shape.insert(shape.end(), core);
    return py::array_t<double>(std::move(shape));
  }

  /// Whether the states are many, counted by one dimension.
  [[nodiscard]] bool is_one_row() const { return dimensions_.size() == 1; }

  /// Where it is, f(first, count, rows..) of blocks of them, each argument as StateRows.
  template <class F>
  void blocks(F&& f) const {
    blocks(std::forward<F>(f), std::make_index_sequence<N>());
  }

  /// f(i, rows..) for each state: its number, and what each argument holds of it.
  template <class F>
  void each(F&& f) const {
    each(std::forward<F>(f), std::make_index_sequence<N>());
  }

 private:
  /// Of the array of states: its size, and how far apart its states are in each argument.
  struct Dimension {
    Index size = 1;
    std::array<Index, N> stride{};
  };

  void broadcast() {
    std::size_t count = 0;
    for (const StateArgument& argument : arguments_) {
      count = std::max(count, static_cast<std::size_t>(argument.array.ndim()) - 1);
    }
    dimensions_.resize(count);
    for (std::size_t k = 0; k < N; ++k) {
      const Array& array = arguments_[k].array;
      const std::vector<Index> before = sizes();
      const Index missing = static_cast<Index>(count) - (array.ndim() - 1);
      Index stride = arguments_[k].size;
      for (Index axis = array.ndim() - 1; axis-- > 0;) {
        Dimension& dimension = dimensions_[static_cast<std::size_t>(axis + missing)];
        const Index size = array.shape(axis);
        if (size == 1) continue;
        if (dimension.size != 1 && dimension.size != size) refuse_leading(arguments_[k], before);
        dimension.size = size;
        dimension.stride[k] = stride;
        stride *= size;
      }
    }
  }

  [[nodiscard]] std::vector<Index> sizes() const {
    std::vector<Index> sizes;
    sizes.reserve(dimensions_.size() + 2);
    for (const Dimension& dimension : dimensions_) sizes.push_back(dimension.size);
    return sizes;
  }

  [[nodiscard]] Eigen::Map<const VectorXd> row(std::size_t k, Index offset) const {
    return {arguments_[k].array.data() + offset, arguments_[k].size};
  }

  template <class F, std::size_t... K>
  void blocks(F&& f, std::index_sequence<K...>) const {
    constexpr Index largest = 1024;
    const Dimension& row = dimensions_.front();
    Interruption interruption;
    const auto run = [&] {
      const Unlocked unlocked;
      for (Index first = 0; first < row.size && !interruption(); first += largest) {
        f(first, std::min(largest, row.size - first),
          StateRows{arguments_[K].array.data() + first * row.stride[K], row.stride[K]}...);
      }
    };
    run();
    interruption.raise();
  }

  template <class F, std::size_t... K>
  void each(F&& f, std::index_sequence<K...>) const {
    if (dimensions_.empty()) return f(Index{0}, row(K, 0)...);
    Interruption interruption;
    run(f, interruption, std::index_sequence<K...>());
    interruption.raise();
  }

  template <class F, std::size_t... K>
  void run(F& f, Interruption& interruption, std::index_sequence<K...>) const {
    constexpr Index states_between_looks = 128;
    const Unlocked unlocked;
    Index count = 1;
    for (const Dimension& dimension : dimensions_) count *= dimension.size;
    std::vector<Index> index(dimensions_.size(), 0);
    std::array<Index, N> offset{};
    for (Index i = 0; i < count; ++i) {
      f(i, row(K, offset[K])...);
      if (i % states_between_looks == states_between_looks - 1 && interruption()) return;
      for (std::size_t axis = dimensions_.size(); axis-- > 0;) {
        const Dimension& dimension = dimensions_[axis];
        const bool wraps = ++index[axis] == dimension.size;
        const Index steps = wraps ? 1 - dimension.size : 1;
        ((offset[K] += steps * dimension.stride[K]), ...);
        if (!wraps) break;
        index[axis] = 0;
      }
    }
  }

  std::array<StateArgument, N> arguments_;
  std::vector<Dimension> dimensions_;  // empty for one state
};

template <class... Arguments>
States(Arguments&&...) -> States<sizeof...(Arguments)>;

}  // namespace cdcr::python
