#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kalman_filter.hpp"
#include "cdcr/momentum_observer.hpp"
#include "docs.hpp"
#include "loop_options.hpp"
#include "pickling.hpp"

namespace cdcr::python {

using namespace py::literals;

/// An estimator that knows the model and the options as Python has them.
template <class Law>
class Estimating final : public Law {
 public:
  template <class... More>
  Estimating(py::object of, py::dict given, More&&... more)
      : Law(read_model(of), std::forward<More>(more)...),
        model(std::move(of)),
        options(std::move(given)) {}

  py::object model;
  py::dict options;
};

namespace {

std::optional<Place> read_place(const py::dict& given, const char* name) {
  if (given[name].is_none()) return std::nullopt;
  const auto [section, fraction] = given[name].cast<std::pair<Index, double>>();
  return Place{section, fraction};
}

KalmanOptions read_kalman(const Model& model, const py::dict& given) {
  KalmanOptions options;
  options.sensors = read_sensors(given);
  options.actuators = read_actuators(given);
  options.period = given["period"].cast<double>();
  options.substeps = given["substeps"].cast<int>();
  options.acceleration_noise =
      *VectorArgument(given["acceleration_noise"], "acceleration_noise", any_size);
  if (!given["start"].is_none()) options.start = *read_bending(model, given["start"], "start");
  options.deviation = given["deviation"].cast<double>();
  options.rate_deviation = given["rate_deviation"].cast<double>();
  options.force_at = read_place(given, "force_at");
  options.force_noise = given["force_noise"].cast<double>();
  options.force_deviation = given["force_deviation"].cast<double>();
  for (const py::handle& one : given["variants"]) options.variants.push_back(read_model(one));
  options.share_noise = given["share_noise"].cast<double>();
  options.share_deviation = given["share_deviation"].cast<double>();
  return options;
}

using Extended = Estimating<ExtendedKalman>;
using Unscented = Estimating<UnscentedKalman>;
using Observer = Estimating<MomentumObserver>;

Extended* make_extended(const py::object& model, const py::dict& given) {
  return new Extended(model, given, read_kalman(read_model(model), given));
}

Unscented* make_unscented(const py::object& model, const py::dict& given) {
  const UnscentedOptions spread{given["spread"].cast<double>(), given["beta"].cast<double>(),
                                given["kappa"].cast<double>()};
  return new Unscented(model, given, read_kalman(read_model(model), given), spread);
}

Observer* make_observer(const py::object& model, const py::dict& given) {
  MomentumObserverOptions options;
  options.bandwidth = given["bandwidth"].cast<double>();
  options.period = given["period"].cast<double>();
  options.damping = given["damping"].cast<double>();
  options.actuators = read_actuators(given);
  options.force_at = read_place(given, "force_at");
  const py::object states = given["states"];
  return new Observer(model, given, options,
                      states.is_none() ? nullptr : states.cast<Estimator*>());
}

/// The robot that an estimator bound here reckons with.
const Model& model_of(const Estimator& self) {
  if (const auto* filter = dynamic_cast<const KalmanFilter*>(&self)) return filter->model();
  return dynamic_cast<const MomentumObserver&>(self).model();
}

/// The filter that hears sensors: an estimator itself, or what an observer asks; or nothing.
const KalmanFilter* filter_of(const Estimator& self) {
  if (const auto* observer = dynamic_cast<const Observer*>(&self)) {
    const py::object states = observer->options["states"];
    return states.is_none() ? nullptr : filter_of(states.cast<const Estimator&>());
  }
  return dynamic_cast<const KalmanFilter*>(&self);
}

void reset(Estimator& self, const py::object& q, const py::object& qd, const py::object& command) {
  const Model& model = model_of(self);
  const VectorXd q0 = *read_bending(model, q, "q");
  const VectorXd qd0 = *VectorArgument(qd, "qd", model.num_coordinates(), of_coordinates(model));
  VectorXd first(model.num_cables());
  rest_command(model, first);
  if (!command.is_none()) first = *read_tension(model, command, "command");
  self.reset(q0, qd0, first);
}

py::tuple update(Estimator& self, const py::sequence& measurements, const py::object& command,
                 const py::object& q, const py::object& qd) {
  const Model& model = model_of(self);
  const Index d = model.num_coordinates();
  std::vector<Measurement> told;
  const KalmanFilter* filter = filter_of(self);
  if (PyObject_Size(measurements.ptr()) < 0) {  // an array without dimensions
    PyErr_Clear();
    throw py::type_error(
        "measurements must be a sequence of arrays or None, one for each sensor, got " +
        std::string(py::str(py::type::of(measurements).attr("__name__"))) + " without dimensions");
  }
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const std::string item = "measurements[" + std::to_string(i) + "]";
    const py::object one = measurements[i];
    if (!one.is_none()) {
      const bool known = filter != nullptr && i < filter->options().sensors.size();
      const Index size = known ? filter->measurement_size(i) : any_size;
      told.push_back({*VectorArgument(one, item.c_str(), size), true});
    } else if (filter != nullptr && i < filter->options().sensors.size()) {
      told.push_back({VectorXd::Zero(filter->measurement_size(i)), false});
    }
  }
  VectorXd at = VectorXd::Zero(d), rate = at;
  if (!q.is_none()) at = *read_bending(model, q, "q");
  if (!qd.is_none()) rate = *VectorArgument(qd, "qd", d, of_coordinates(model));
  const VectorXd asked = *read_tension(model, command, "command");
  const Status status = self.update(0.0, told, asked, at, rate);
  if (status == Status::wrong_size) {
    throw py::value_error("measurements must have an array of its size, or None, for each sensor");
  }
  if (status != Status::ok) throw py::value_error(message(status));
  return py::make_tuple(to_array(at), to_array(rate));
}

/// Values by name, or their standard deviations.
py::dict named(const Estimator& self, bool deviations) {
  const std::vector<std::string> names = self.value_names();
  VectorXd values(names.size()), spread(names.size());
  self.write_values(values, spread);
  py::dict found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    found[names[i].c_str()] = (deviations ? spread : values)[static_cast<Index>(i)];
  }
  return found;
}

py::dict diagnostics(const Estimator& self) {
  const EstimatorDiagnostics found = self.diagnostics();
  return py::dict("updates"_a = found.updates, "duration"_a = found.duration,
                  "innovation"_a = found.innovation, "measured"_a = found.measured);
}

void bind_estimator(py::module_& m) {
  py::class_<Estimator>(m, "Estimator", "Makes a state of measurements, each period.")
      .def_property_readonly("period", &Estimator::period, "Time between updates [s].")
      .def("reset", &reset, "q"_a, "qd"_a, "command"_a = py::none(),
           Doc("Begin anew, with the state at the start.",
               {docs::one_q, docs::one_qd,
                "command : (num_cables,) array_like, optional\n    What actuators give there [N], "
                "[m]; by default what leaves the straight robot alone.\n"},
               "", docs::bad_argument))
      .def(
          "update", &update, "measurements"_a, "command"_a, "q"_a = py::none(), "qd"_a = py::none(),
          Doc("Go on by a period, with what sensors tell at its end; the first after reset, at the "
              "start.",
              {"measurements : sequence of arrays or None\n    What each sensor tells [of its "
               "kind]; None where nothing is new.\n",
               "command : (num_cables,) array_like\n    What the controller asked for over the "
               "period [N], [m].\n",
               "q, qd : (d,) array_like, optional\n    The state that an observer is told [rad], "
               "[rad/s]; filters do without.\n"},
              "(d,) array, (d,) array\n    Coordinates and rates [rad], [rad/s].",
              docs::bad_argument))
      .def_property_readonly(
          "values", [](const Estimator& self) { return named(self, false); },
          "What else it estimates, a dict: forces [N], [N m], shares [1].")
      .def_property_readonly(
          "deviations", [](const Estimator& self) { return named(self, true); },
          "Standard deviations of `values`, 0 where it has none [N], [N m], [1].")
      .def_property_readonly(
          "diagnostics", &diagnostics,
          "Numbers about the last update, a dict: `updates` since the reset, the `duration` of "
          "the\nlast [s], its `innovation`, chi-square with as many degrees as values were "
          "`measured` [1].");
  py::class_<KalmanFilter, Estimator>(m, "KalmanFilter", "A Kalman filter on a model.")
      .def_property_readonly(
          "state", [](const KalmanFilter& self) { return to_array(self.state()); },
          "Coordinates, rates, force and shares (n,) [rad], [rad/s], [N], [1].")
      .def_property_readonly(
          "covariance",
          [](const KalmanFilter& self) { return to_rows(RowMatrixXd(self.covariance())); },
          "Covariance of the state (n, n) [rad^2], ..., by as much earlier as the latest sensor is "
          "late.");
}

template <class Law, class Base>
py::class_<Estimating<Law>, Base> bind_law(py::module_& m, const char* name, const char* about,
                                           Estimating<Law>* (*make)(const py::object&,
                                                                    const py::dict&)) {
  py::class_<Estimating<Law>, Base> law(m, name, about);
  law.def(py::init(make), "model"_a, "options"_a,
          Doc("Make an estimator, which has no state until `reset`.",
              {"model : Model\n    The robot that it reckons with.\n",
               "options : dict\n    What the class in Python takes by keyword, all of it.\n"},
              "", docs::bad_argument))
      .def_readonly("model", &Estimating<Law>::model, "The robot that it reckons with.")
      .def_readonly("options", &Estimating<Law>::options, "What it was made of, a dict.");
  make_picklable(
      law,
      [](const Estimating<Law>& self) {
        return py::make_tuple(self.model, self.options, to_array(self.memory()));
      },
      [make](const py::tuple& state) {
        std::unique_ptr<Estimating<Law>> made(make(state[0], state[1].cast<py::dict>()));
        made->set_memory(to_vector(state[2]));
        return made.release();
      });
  return law;
}

}  // namespace

void bind_estimators(py::module_& m) {
  bind_estimator(m);
  bind_law<ExtendedKalman, KalmanFilter>(m, "ExtendedKalman",
                                         "By Jacobians; see cdcr.ExtendedKalman.", &make_extended);
  bind_law<UnscentedKalman, KalmanFilter>(m, "UnscentedKalman",
                                          "By points; see cdcr.UnscentedKalman.", &make_unscented);
  bind_law<MomentumObserver, Estimator>(m, "MomentumObserver",
                                        "Hears forces; see cdcr.MomentumObserver.", &make_observer)
      .def_property_readonly(
          "generalized_force",
          [](const Observer& self) { return to_array(self.generalized_force()); },
          "Generalised force that the model knows nothing of (d,) [N m].")
      .def_property_readonly(
          "force", [](const Observer& self) { return to_array(self.force()); },
          "Force on `force_at` that explains it best, in the base frame (3,) [N].");
}

}  // namespace cdcr::python
