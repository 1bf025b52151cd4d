#include <algorithm>
#include <memory>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/pid.hpp"
#include "cdcr/rollout.hpp"
#include "controllers.hpp"
#include "docs.hpp"
#include "driving.hpp"
#include "gil.hpp"
#include "methods.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

RowMatrixXd read_states(const py::object& object, const char* name, const Model& model) {
  const Array array =
      read_array(object, name, {any_size, model.num_coordinates()}, of_coordinates(model));
  return Eigen::Map<const RowMatrixXd>(array.data(), array.shape(0), array.shape(1));
}

/// The controllers of a rollout, which drive no other run meanwhile.
class Controllers {
 public:
  /// One Pid, copied for each of so many motions, or a sequence of controllers.
  Controllers(const py::object& given, Index motions) {
    if (py::isinstance<Controller>(given)) {
      const auto* pid = dynamic_cast<const Pid*>(&given.cast<Controller&>());
      if (pid == nullptr) refuse_python();
      for (Index i = 0; i < motions; ++i) {
        copies_.push_back(std::make_unique<Pid>(*pid));
        all_.push_back(copies_.back().get());
      }
      return;
    }
    for (const py::handle one : given) {
      auto& controller = one.cast<Controller&>();
      if (dynamic_cast<PythonController*>(&controller) != nullptr) refuse_python();
      driving_.push_back(std::make_unique<Driving>(controller));
      all_.push_back(&controller);
    }
  }

  [[nodiscard]] const std::vector<Controller*>& all() const { return all_; }

 private:
  [[noreturn]] static void refuse_python() {
    throw py::type_error(
        "a controller written in Python cannot drive a rollout, which many threads run: give a "
        "function f(t, q, qd) of all states at once, or a cdcr.Pid");
  }

  std::vector<std::unique_ptr<Pid>> copies_;
  std::vector<std::unique_ptr<Driving>> driving_;
  std::vector<Controller*> all_;
};

py::list failures_of(const RolloutOutcome& outcome) {
  py::list failures;
  for (const RolloutFailure& failure : outcome.failures) {
    failures.append(py::make_tuple(failure.motion, failure.status, failure.message));
  }
  return failures;
}

/// Commands of shape (1 or N, 1 or steps, num_cables).
RolloutCommands spread(const Array& commands) {
  const Index cables = commands.shape(2), steps = commands.shape(1);
  return {commands.data(), commands.shape(0) == 1 ? 0 : steps * cables, steps == 1 ? 0 : cables};
}

py::tuple run_rollout(const py::sequence& models, const py::object& q0, const py::object& qd0,
                      const py::object& commands, const py::object& controllers,
                      const WrenchInput& loads, Method method, const Options& tolerances,
                      double step, long steps, long record_every, double start, int threads,
                      const py::object& progress) {
  RolloutOptions options;
  options.step = step;
  options.steps = steps;
  options.record_every = record_every;
  options.start = start;
  options.threads = threads;
  options.method = method;
  options.tolerances = tolerances;
  options.factory = make_any_integrator;
  validate(options);

  Motions motions;
  for (const py::handle model : models) motions.models.push_back(&read_model(model));
  const Model& first = *motions.models.at(0);
  motions.q0 = read_states(q0, "q0", first);
  motions.qd0 = read_states(qd0, "qd0", first);
  motions.loads = loads;
  const Index count = motions.size(), rows = options.rows(), d = first.num_coordinates();
  const bool driven = !controllers.is_none();
  const Controllers drivers(driven ? controllers : py::tuple(), count);
  motions.controllers = drivers.all();
  const Array given =
      driven ? Array() : read_array(commands, "tension", {any_size, any_size, first.num_cables()});
  if (!driven) motions.commands = spread(given);

  py::array_t<double> q({count, rows, d}), qd({count, rows, d});
  py::object command = py::none();
  RolloutRows out{q.mutable_data(), qd.mutable_data()};
  if (driven) {
    py::array_t<double> asked({count, rows, first.num_cables()});
    out.command = asked.mutable_data();
    command = std::move(asked);
  }
  Interruption interruption;
  Index told = 0;
  const auto report = [&](Index ended) {
    if (!progress.is_none() && ended != told) {
      told = ended;
      const Locked locked;
      (void)call(progress, py::make_tuple(ended));
    }
    return !interruption();
  };
  const auto unlocked_run = [&] {
    const Unlocked unlocked;
    return rollout(motions, options, out, report);
  };
  const RolloutOutcome outcome = unlocked_run();
  interruption.forgive(std::any_of(
      outcome.failures.begin(), outcome.failures.end(),
      [](const RolloutFailure& failure) { return failure.status == Status::interrupted; }));
  return py::make_tuple(std::move(q), std::move(qd), std::move(command), failures_of(outcome),
                        outcome.stats);
}

}  // namespace

void bind_rollout(py::module_& m) {
  m.def("rollout", &run_rollout, "models"_a, "q0"_a, "qd0"_a, "commands"_a, "controllers"_a,
        "loads"_a, "method"_a, "options"_a, "step"_a, "steps"_a, "record_every"_a, "start"_a,
        "threads"_a, "progress"_a,
        Doc("Many motions at once; see cdcr.rollout.",
            {"models : sequence of Model\n    One for all motions, or one for each.\n",
             "q0, qd0 : (N, d) array_like\n    Where they start [rad], [rad/s].\n",
             "commands : (1 or N, 1 or steps, num_cables)\n    Tensions [N], or lengths [m].\n",
             "controllers : Pid, sequence of Controller or None\n    In place of commands.\n",
             "loads : Loads\n    Wrenches over time.\n", "method : Method\n    How to integrate.\n",
             "options : Options\n    Tolerances and limits.\n",
             "step : float\n    Between commands, and of rk4 [s].\n",
             "steps, record_every : int\n    Steps of each motion, and from row to row.\n",
             "start : float\n    Time at which they begin [s].\n",
             "threads : int\n    0: one for each processor.\n",
             "progress : callable or None\n    Told how many have ended now and then.\n"},
            "tuple\n    q, qd (N, rows, d), commands (N, rows, num_cables) of controllers or\n"
            "    None, of each failure its motion, status and message, and the Stats of all.",
            docs::bad_argument));
}

}  // namespace cdcr::python
