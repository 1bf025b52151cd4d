#include <cdcr.h>

#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "cdcr/cdcr.hpp"
#include "cdcr/robot_file.hpp"

struct cdcr_model {
  cdcr::Model model;
};

struct cdcr_workspace {
  cdcr::Model model;
  cdcr::Data data;
  cdcr::VectorXd state;        // (q, qd), to tell what is wrong with it
  cdcr::VectorXd coordinates;  // an output, until it is known to be good
  cdcr::VectorXd lengths;      // likewise
  cdcr::MatrixXd on_q, on_qd, on_command, on_wrenches;

  explicit cdcr_workspace(const cdcr::Model& of)
      : model(of),
        data(model),
        state(2 * model.num_coordinates()),
        coordinates(model.num_coordinates()),
        lengths(model.num_cables()),
        on_q(model.num_coordinates(), model.num_coordinates()),
        on_qd(on_q),
        on_command(model.num_coordinates(), model.num_cables()),
        on_wrenches(model.num_coordinates(), 0) {}
};

struct cdcr_simulator {
  cdcr::Simulator simulator;
};

namespace {

using cdcr::Index;
using cdcr::MatrixXd;
using cdcr::VectorXd;
using Input = Eigen::Map<const VectorXd>;
using Output = Eigen::Map<VectorXd>;

std::string& last_error() {
  thread_local std::string text;
  return text;
}

cdcr_status code(cdcr::Status status) noexcept {
  return static_cast<cdcr_status>(status);
}

cdcr_status failed(cdcr_status status, const char* text) noexcept {
  try {
    last_error() = text;
  } catch (...) {  // no memory for it
    last_error().clear();
  }
  return status;
}

/// Runs what may throw, for set-up.
template <class Call>
cdcr_status guarded(Call&& call) noexcept {
  try {
    return call();
  } catch (const std::invalid_argument& error) {
    return failed(CDCR_INVALID_ARGUMENT, error.what());
  } catch (const std::bad_alloc&) {
    return failed(CDCR_OUT_OF_MEMORY, "there is not enough memory");
  } catch (const std::exception& error) {
    return failed(CDCR_FAILED, error.what());
  } catch (...) {
    return failed(CDCR_FAILED, "an exception of unknown kind");
  }
}

cdcr_status null_given() noexcept {
  return failed(CDCR_INVALID_ARGUMENT, "a pointer is NULL that must not be");
}

template <class... Pointers>
bool any_null(const Pointers*... pointers) noexcept {
  return ((pointers == nullptr) || ...);
}

Input input(const double* values, Index size) {
  return {values, size};
}

/// A robot without inertia has statics but no accelerations.
cdcr_status no_inertia(const cdcr_workspace& w) noexcept {
  return guarded([&] {
    cdcr::require_inertia(w.model);
    return CDCR_OK;
  });
}

/// Writes a result where it is finite, or tells what is wrong with the state that led to it.
template <class Result>
cdcr_status write(cdcr_workspace& w, const double* q, const double* qd, const Result& result,
                  double* to) noexcept {
  if (result.allFinite()) {
    Eigen::Map<MatrixXd>(to, result.rows(), result.cols()) = result;
    return CDCR_OK;
  }
  const Index d = w.model.num_coordinates();
  w.state.head(d) = input(q, d);
  w.state.tail(d).setZero();
  if (qd != nullptr) w.state.tail(d) = input(qd, d);
  const cdcr_status status = code(cdcr::check_state(w.model, w.state));
  return status == CDCR_OK ? CDCR_NON_FINITE_STATE : status;
}

}  // namespace

const char* cdcr_message(cdcr_status status) {
  switch (status) {
    case CDCR_INVALID_ARGUMENT:
      return "an argument is not what it must be; cdcr_last_error() says which";
    case CDCR_OUT_OF_MEMORY:
      return "there is not enough memory";
    case CDCR_FAILED:
      return "the call failed; cdcr_last_error() says why";
    default:
      return cdcr::message(static_cast<cdcr::Status>(status));
  }
}

const char* cdcr_last_error(void) {
  return last_error().c_str();
}

const char* cdcr_version(void) {
  return cdcr::version;
}

cdcr_status cdcr_model_load(const char* path, cdcr_model** model) {
  if (any_null(path, model)) return null_given();
  return guarded([&] {
    *model = nullptr;
    *model = new cdcr_model{cdcr::Model(cdcr::load_robot(path))};
    return CDCR_OK;
  });
}

cdcr_status cdcr_model_from_toml(const char* text, cdcr_model** model) {
  if (any_null(text, model)) return null_given();
  return guarded([&] {
    *model = nullptr;
    *model = new cdcr_model{cdcr::Model(cdcr::robot_from_toml(text))};
    return CDCR_OK;
  });
}

void cdcr_model_free(cdcr_model* model) {
  delete model;
}

int cdcr_num_sections(const cdcr_model* model) {
  return model == nullptr ? 0 : static_cast<int>(model->model.num_sections());
}

int cdcr_num_coordinates(const cdcr_model* model) {
  return model == nullptr ? 0 : static_cast<int>(model->model.num_coordinates());
}

int cdcr_num_cables(const cdcr_model* model) {
  return model == nullptr ? 0 : static_cast<int>(model->model.num_cables());
}

cdcr_status cdcr_equilibrium(const cdcr_model* model, const double* command, const double* start,
                             double* q, int* stable) {
  if (any_null(model, command, q)) return null_given();
  return guarded([&] {
    const cdcr::Model& m = model->model;
    VectorXd q0;
    if (start != nullptr) q0 = input(start, m.num_coordinates());
    const cdcr::Equilibrium rest = cdcr::equilibrium(m, input(command, m.num_cables()), q0);
    Output(q, m.num_coordinates()) = rest.q;
    if (stable != nullptr) *stable = rest.stable ? 1 : 0;
    return code(rest.status);
  });
}

cdcr_status cdcr_workspace_create(const cdcr_model* model, cdcr_workspace** workspace) {
  if (any_null(model, workspace)) return null_given();
  return guarded([&] {
    *workspace = nullptr;
    *workspace = new cdcr_workspace(model->model);
    return CDCR_OK;
  });
}

void cdcr_workspace_free(cdcr_workspace* workspace) {
  delete workspace;
}

cdcr_status cdcr_forward_dynamics(cdcr_workspace* workspace, const double* q, const double* qd,
                                  const double* command, double* qdd) {
  if (any_null(workspace, q, qd, command, qdd)) return null_given();
  cdcr_workspace& w = *workspace;
  if (!w.model.has_inertia()) return no_inertia(w);
  const Index d = w.model.num_coordinates();
  cdcr::forward_dynamics(w.model, w.data, input(q, d), input(qd, d),
                         input(command, w.model.num_cables()), w.coordinates);
  return write(w, q, qd, w.coordinates, qdd);
}

cdcr_status cdcr_inverse_dynamics(cdcr_workspace* workspace, const double* q, const double* qd,
                                  const double* qdd, double* force) {
  if (any_null(workspace, q, qd, qdd, force)) return null_given();
  cdcr_workspace& w = *workspace;
  const Index d = w.model.num_coordinates();
  cdcr::inverse_dynamics(w.model, w.data, input(q, d), input(qd, d), input(qdd, d), w.coordinates);
  return write(w, q, qd, w.coordinates, force);
}

cdcr_status cdcr_derivatives(cdcr_workspace* workspace, const double* q, const double* qd,
                             const double* command, double* on_q, double* on_qd,
                             double* on_command) {
  if (any_null(workspace, q, qd, command, on_q, on_qd, on_command)) return null_given();
  cdcr_workspace& w = *workspace;
  if (!w.model.has_inertia()) return no_inertia(w);
  const Index d = w.model.num_coordinates();
  cdcr::acceleration_derivatives(w.model, w.data, input(q, d), input(qd, d),
                                 input(command, w.model.num_cables()), cdcr::no_wrenches(), w.on_q,
                                 w.on_qd, w.on_command, w.on_wrenches);
  if (!w.on_qd.allFinite() || !w.on_command.allFinite()) w.on_q(0, 0) = std::nan("");
  const cdcr_status status = write(w, q, qd, w.on_q, on_q);
  if (status != CDCR_OK) return status;
  Eigen::Map<MatrixXd>(on_qd, d, d) = w.on_qd;
  Eigen::Map<MatrixXd>(on_command, d, w.model.num_cables()) = w.on_command;
  return CDCR_OK;
}

cdcr_status cdcr_mass_matrix(cdcr_workspace* workspace, const double* q, double* mass) {
  if (any_null(workspace, q, mass)) return null_given();
  cdcr_workspace& w = *workspace;
  cdcr::mass_matrix(w.model, w.data, input(q, w.model.num_coordinates()), w.on_q);
  return write(w, q, nullptr, w.on_q, mass);
}

cdcr_status cdcr_cable_lengths(cdcr_workspace* workspace, const double* q, double* lengths) {
  if (any_null(workspace, q, lengths)) return null_given();
  cdcr_workspace& w = *workspace;
  cdcr::cable_lengths(w.model, input(q, w.model.num_coordinates()), w.lengths);
  return write(w, q, nullptr, w.lengths, lengths);
}

cdcr_status cdcr_tip_pose(cdcr_workspace* workspace, const double* q, double* position,
                          double* rotation) {
  if (any_null(workspace, q, position, rotation)) return null_given();
  cdcr_workspace& w = *workspace;
  const cdcr::Pose pose = cdcr::tip(w.model, input(q, w.model.num_coordinates()));
  const cdcr_status status = write(w, q, nullptr, pose.R, rotation);
  return status == CDCR_OK ? write(w, q, nullptr, pose.p, position) : status;
}

cdcr_status cdcr_simulator_create(const cdcr_model* model, double period, int substeps,
                                  cdcr_simulator** simulator) {
  if (any_null(model, simulator)) return null_given();
  return guarded([&] {
    *simulator = nullptr;
    *simulator = new cdcr_simulator{cdcr::Simulator(model->model, period, substeps)};
    return CDCR_OK;
  });
}

void cdcr_simulator_free(cdcr_simulator* simulator) {
  delete simulator;
}

cdcr_status cdcr_simulator_reset(cdcr_simulator* simulator, const double* q, const double* qd,
                                 double time) {
  if (any_null(simulator, q, qd)) return null_given();
  return guarded([&] {
    const Index d = simulator->simulator.model().num_coordinates();
    simulator->simulator.reset(input(q, d), input(qd, d), time);
    return CDCR_OK;
  });
}

cdcr_status cdcr_simulator_step(cdcr_simulator* simulator, const double* command) {
  if (any_null(simulator, command)) return null_given();
  return code(simulator->simulator.step(input(command, simulator->simulator.model().num_cables())));
}

cdcr_status cdcr_simulator_state(const cdcr_simulator* simulator, double* q, double* qd,
                                 double* time) {
  if (any_null(simulator)) return null_given();
  const cdcr::Simulator& s = simulator->simulator;
  if (!s.started()) return CDCR_NOT_STARTED;
  if (q != nullptr) Output(q, s.q().size()) = s.q();
  if (qd != nullptr) Output(qd, s.qd().size()) = s.qd();
  if (time != nullptr) *time = s.time();
  return CDCR_OK;
}
