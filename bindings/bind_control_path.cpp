#include <cmath>
#include <sstream>

#include "docs.hpp"
#include "pickling.hpp"
#include "tracking.hpp"

namespace cdcr::python {

using namespace py::literals;

namespace {

MatrixXd read_rows(const py::object& object, const char* name, Index rows = any_size) {
  const Array read = read_array(object, name, {rows, any_size});
  return Eigen::Map<const RowMatrixXd>(read.data(), read.shape(0), read.shape(1));
}

VectorXd read_one(const py::object& object, const char* name, Index size = any_size) {
  return *VectorArgument(object, name, size);
}

ReferencePath helix(const py::object& center, const py::object& x, const py::object& y,
                    const py::object& climb, double turns, double duration, bool rest_to_rest) {
  const VectorXd middle = read_one(center, "center", read_one(x, "x").size());
  const Index size = middle.size();
  return ReferencePath::helix(middle, read_one(x, "x", size), read_one(y, "y", size),
                              read_one(climb, "climb", size), turns, duration, rest_to_rest);
}

constexpr const char* on_times =
    "t : (N,) array_like\n    Times, at least two, strictly increasing "
    "[s].\n";
constexpr const char* a_path = "ReferencePath";
constexpr const char* round =
    "center, x, y : (m,) array_like\n    The path is center + cos(a) x + sin(a) y, in the unit of "
    "coordinates [rad] or tip [m].\n";
constexpr const char* turning =
    "turns : float\n    How often a goes round [1]; below 0 the other way.\n"
    "duration : float\n    Of all turns [s], > 0.\n"
    "rest_to_rest : bool, default True\n    Begin and end at rest, by minimum jerk; or turn "
    "evenly.\n";

}  // namespace

py::tuple take_path(const ReferencePath& path) {
  return py::make_tuple(to_array(path.times()), to_rows(path.coefficients()), to_rows(path.turn()),
                        path.size());
}

ReferencePath put_path(const py::tuple& parts) {
  return ReferencePath::of_parts(read_one(parts[0], "times"), read_rows(parts[1], "coefficients"),
                                 read_rows(parts[2], "turn"), parts[3].cast<Index>());
}

void bind_reference_path(py::module_& m) {
  const py::arg_v rests = "rest_to_rest"_a.noconvert() = true;
  py::class_<ReferencePath> path(
      m, "ReferencePath",
      "A motion that a controller follows: coordinates (d,) [rad] or the tip's position (3,) "
      "[m].\n\n"
      "Values over time with their first two derivatives; it stands still before its start and "
      "after\nits end. Made by its class methods; cpp/control.md eqs. (84), (85).\n\n"
      "Examples\n--------\n"
      ">>> import cdcr\n"
      ">>> path = cdcr.ReferencePath.spline([0.0, 1.0, 2.0], [[0.0, 0.0], [0.3, 0.1], [0.0, "
      "0.4]])\n"
      ">>> value, rate, acceleration = path.evaluate(1.0)\n"
      ">>> value\n"
      "array([0.3, 0.1])");
  path.def_static(
          "constant",
          [](const py::object& value) { return ReferencePath::constant(read_one(value, "value")); },
          "value"_a,
          Doc("The same at all times.",
              {"value : (m,) array_like\n    Coordinates [rad] or the position of the tip [m].\n"},
              a_path, docs::bad_argument))
      .def_static(
          "spline",
          [](const py::object& t, const py::object& points) {
            const VectorXd times = read_one(t, "t");
            return ReferencePath::spline(times, read_rows(points, "points", times.size()));
          },
          "t"_a, "points"_a,
          Doc("The smoothest way through points, from rest to rest: least squared jerk.",
              {on_times, "points : (N, m) array_like\n    Coordinates [rad] or positions [m].\n"},
              a_path, docs::bad_argument))
      .def_static(
          "hermite",
          [](const py::object& t, const py::object& values, const py::object& rates,
             const py::object& accelerations) {
            const VectorXd times = read_one(t, "t");
            return ReferencePath::hermite(times, read_rows(values, "values", times.size()),
                                          read_rows(rates, "rates", times.size()),
                                          read_rows(accelerations, "accelerations", times.size()));
          },
          "t"_a, "values"_a, "rates"_a, "accelerations"_a,
          Doc("Quintics through values, rates and accelerations.",
              {on_times,
               "values, rates, accelerations : (N, m) array_like\n    Of coordinates [rad] or "
               "positions [m], per second and per second squared.\n"},
              a_path, docs::bad_argument))
      .def_static(
          "polygon",
          [](const py::object& corners, double duration) {
            return ReferencePath::polygon(read_rows(corners, "corners"), duration);
          },
          "corners"_a, "duration"_a,
          Doc("Along straight lines from corner to corner, at rest in each.",
              {"corners : (N, m) array_like\n    Coordinates [rad] or positions [m]; a square has "
               "five.\n",
               "duration : float\n    Of all of it [s], > 0; a side has its share by length.\n"},
              a_path, docs::bad_argument))
      .def_static(
          "circle",
          [](const py::object& center, const py::object& x, const py::object& y, double turns,
             double duration, bool rest_to_rest) {
            const VectorXd none = VectorXd::Zero(read_one(x, "x").size());
            return helix(center, x, y, to_array(none), turns, duration, rest_to_rest);
          },
          "center"_a, "x"_a, "y"_a, "turns"_a, "duration"_a, rests,
          Doc("Round a circle or an ellipse.", {round, turning}, a_path, docs::bad_argument))
      .def_static(
          "helix", &helix, "center"_a, "x"_a, "y"_a, "climb"_a, "turns"_a, "duration"_a, rests,
          Doc("Round a circle that moves on.",
              {round,
               "climb : (m,) array_like\n    By how much it moves on in a turn [rad], [m].\n",
               turning},
              a_path, docs::bad_argument))
      .def("delayed", &ReferencePath::delayed, "delay"_a,
           Doc("The same motion that begins later.", {"delay : float\n    By how much [s].\n"},
               a_path, docs::bad_argument))
      .def(
          "evaluate",
          [](const ReferencePath& self, double t) {
            if (std::isnan(t)) throw py::value_error("t must be a number [s], got nan");
            Setpoint found(self.size());
            self.evaluate(t, found);
            return py::make_tuple(to_array(found.value), to_array(found.rate),
                                  to_array(found.acceleration));
          },
          "t"_a,
          Doc("Value, rate and acceleration at one time.", {"t : float\n    The time [s].\n"},
              "tuple of (m,) array\n    Coordinates [rad] or positions [m], per second and per "
              "second squared.",
              docs::bad_argument))
      .def_property_readonly("size", &ReferencePath::size, "Number of values m.")
      .def_property_readonly("start", &ReferencePath::start, "When it begins [s].")
      .def_property_readonly("end", &ReferencePath::end, "When it ends [s].")
      .def("__repr__", [](const ReferencePath& self) {
        std::ostringstream text;
        text << "<ReferencePath: " << self.size() << " values";
        if (!self.is_constant()) text << ", t = " << self.start() << " to " << self.end() << " s";
        text << ">";
        return text.str();
      });
  make_picklable(path, &take_path,
                 [](const py::tuple& parts) { return new ReferencePath(put_path(parts)); });
}

}  // namespace cdcr::python
