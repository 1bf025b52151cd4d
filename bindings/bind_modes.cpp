#include "bind.hpp"
#include "cdcr/modes.hpp"
#include "docs.hpp"
#include "states.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// Writes answer i of an array that has `answer.size()` numbers for each state.
template <class Answer>
void put(py::array_t<double>& out, Index i, const Answer& answer) {
  Eigen::Map<RowMatrixXd>(out.mutable_data() + i * answer.size(), answer.rows(), answer.cols()) =
      answer;
}

/// The fields of cdcr.Modes after q, in their order; an eigenvalue is a pair of real numbers.
py::tuple find_modes(const Model& self, const py::object& q, const py::object& tension,
                     const py::object& wrenches) {
  const States states{read_bendings(self, q), read_tensions(self, tension)};
  const Wrenches loads = read_wrenches(self, wrenches);
  const Index d = self.num_coordinates();
  auto frequency = states.output({d}), squared = states.output({d}), shape = states.output({d, d}),
       ratio = states.output({d}), eigenvalues = states.output({2 * d, 2}),
       stable = states.output({1});
  states.each([&](Index i, const auto& x, const auto& command) {
    const Modes found = modes(self, x, command, loads);
    put(frequency, i, found.frequency);
    put(squared, i, found.squared_frequency);
    put(shape, i, found.shape);
    put(ratio, i, found.damping_ratio);
    Eigen::MatrixX2d pairs(2 * d, 2);
    pairs << found.eigenvalues.real(), found.eigenvalues.imag();
    put(eigenvalues, i, pairs);
    stable.mutable_data()[i] = found.stable ? 1.0 : 0.0;
  });
  return py::make_tuple(frequency, squared, shape, ratio, eigenvalues, stable);
}

}  // namespace

void bind_modes(PyModel& model) {
  model.def("_modes", &find_modes, "q"_a, "tension"_a, "wrenches"_a, Doc("See cdcr.Model.modes."));
}

}  // namespace cdcr::python
