#include "cdcr/command_input.hpp"

#include <cmath>
#include <utility>

#include "base/arguments.hpp"

namespace cdcr {
namespace {

template <class Item>
void require_pulling(double value, const Item& item) {
  detail::require(value >= 0.0 && std::isfinite(value), item,
                  " must be finite and >= 0 N (a cable cannot push), got ", value);
}

}  // namespace

CommandInput CommandInput::constant(const VectorXd& tension) {
  for (Index j = 0; j < tension.size(); ++j) {
    require_pulling(tension[j], detail::sentence("tension[", j, "] (cable ", j + 1, ")"));
  }
  return CommandInput(Signal::constant(tension));
}

CommandInput CommandInput::table(const VectorXd& times, const MatrixXd& tensions,
                                 Interpolation interpolation) {
  CommandInput input(Signal::table("a tension table", times, tensions, interpolation));
  for (Index i = 0; i < tensions.rows(); ++i) {
    for (Index j = 0; j < tensions.cols(); ++j) {
      require_pulling(tensions(i, j),
                      detail::sentence("tension[", i, ", ", j, "] (cable ", j + 1, ")"));
    }
  }
  return input;
}

CommandInput CommandInput::function(Function function, Index num_cables,
                                    std::vector<double> break_points) {
  return CommandInput(Signal::function("the tension function", std::move(function), num_cables,
                                       std::move(break_points)));
}

}  // namespace cdcr
