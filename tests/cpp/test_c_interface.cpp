// The C interface gives what the C++ library gives, to the last bit, and nothing leaves it but
// codes.
#include <cdcr.h>
#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "cdcr/cdcr.hpp"
#include "cdcr/robot_file.hpp"
#include "support/allocations.hpp"

namespace cdcr::test {
namespace {

const std::string folder = CDCR_TEST_DATA "/robot_files/";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <auto free>
struct Free {
  template <class T>
  void operator()(T* handle) const {
    free(handle);
  }
};
using ModelHandle = std::unique_ptr<cdcr_model, Free<cdcr_model_free>>;
using WorkspaceHandle = std::unique_ptr<cdcr_workspace, Free<cdcr_workspace_free>>;
using SimulatorHandle = std::unique_ptr<cdcr_simulator, Free<cdcr_simulator_free>>;

ModelHandle load(const std::string& name) {
  cdcr_model* model = nullptr;
  REQUIRE(cdcr_model_load((folder + name + ".toml").c_str(), &model) == CDCR_OK);
  return ModelHandle(model);
}
WorkspaceHandle workspace_of(const ModelHandle& model) {
  cdcr_workspace* workspace = nullptr;
  REQUIRE(cdcr_workspace_create(model.get(), &workspace) == CDCR_OK);
  return WorkspaceHandle(workspace);
}

template <class A, class B>
bool same(const A& a, const B& b) {
  return (a.array() == b.array()).all();
}

TEST_SUITE_BEGIN("c_interface");

TEST_CASE("every answer is that of the C++ library, without allocating") {
  for (const std::string name : {"amouri2020", "three_sections", "rods", "every_key"}) {
    CAPTURE(name);
    const ModelHandle handle = load(name);
    const WorkspaceHandle workspace = workspace_of(handle);
    cdcr_workspace* const w = workspace.get();
    const Model model(load_robot(folder + name + ".toml"));
    Data data(model);
    const Index d = model.num_coordinates(), c = model.num_cables();
    REQUIRE(cdcr_num_sections(handle.get()) == model.num_sections());
    REQUIRE(cdcr_num_coordinates(handle.get()) == d);
    REQUIRE(cdcr_num_cables(handle.get()) == c);
    const VectorXd q = VectorXd::LinSpaced(d, 0.02, 0.03), qd = VectorXd::LinSpaced(d, -0.4, 0.5),
                   command = VectorXd::LinSpaced(c, 0.1, 0.3);

    VectorXd found(d), wanted(d), lengths(c), wanted_lengths(c);
    MatrixXd M(d, d), on_q(d, d), on_qd(d, d), on_command(d, c), on_wrenches(d, 0);
    MatrixXd c_M(d, d), c_on_q(d, d), c_on_qd(d, d), c_on_command(d, c);
    Vector3d p;
    Matrix3d R;
    const long count = allocations_of([&] {
      CHECK_EQ(cdcr_forward_dynamics(w, q.data(), qd.data(), command.data(), found.data()),
               CDCR_OK);
      forward_dynamics(model, data, q, qd, command, wanted);
      CHECK(same(found, wanted));
      CHECK_EQ(cdcr_inverse_dynamics(w, q.data(), qd.data(), qd.data(), found.data()), CDCR_OK);
      inverse_dynamics(model, data, q, qd, qd, wanted);
      CHECK(same(found, wanted));
      CHECK_EQ(cdcr_mass_matrix(w, q.data(), c_M.data()), CDCR_OK);
      mass_matrix(model, data, q, M);
      CHECK(same(c_M, M));
      CHECK_EQ(cdcr_derivatives(w, q.data(), qd.data(), command.data(), c_on_q.data(),
                                c_on_qd.data(), c_on_command.data()),
               CDCR_OK);
      acceleration_derivatives(model, data, q, qd, command, no_wrenches(), on_q, on_qd, on_command,
                               on_wrenches);
      CHECK(same(c_on_q, on_q));
      CHECK(same(c_on_qd, on_qd));
      CHECK(same(c_on_command, on_command));
      CHECK_EQ(cdcr_cable_lengths(w, q.data(), lengths.data()), CDCR_OK);
      cable_lengths(model, q, wanted_lengths);
      CHECK(same(lengths, wanted_lengths));
      CHECK_EQ(cdcr_tip_pose(w, q.data(), p.data(), R.data()), CDCR_OK);
      const Pose pose = tip(model, q);
      CHECK(same(p, pose.p));
      CHECK(same(R, pose.R));
    });
    if (allocations_counted) CHECK(count == 0);
  }
}

TEST_CASE("a robot moves and rests as in C++") {
  const ModelHandle handle = load("three_sections");
  const Model model(load_robot(folder + "three_sections.toml"));
  const Index d = model.num_coordinates(), c = model.num_cables();
  const VectorXd zero = VectorXd::Zero(d), command = VectorXd::LinSpaced(c, 0.0, 1.0);

  VectorXd q(d), qd(d);
  int stable = -1;
  REQUIRE(cdcr_equilibrium(handle.get(), command.data(), nullptr, q.data(), &stable) == CDCR_OK);
  const Equilibrium rest = equilibrium(model, command);
  CHECK(same(q, rest.q));
  CHECK(stable == (rest.stable ? 1 : 0));
  CHECK(cdcr_equilibrium(handle.get(), command.data(), rest.q.data(), q.data(), nullptr) ==
        CDCR_OK);

  cdcr_simulator* made = nullptr;
  REQUIRE(cdcr_simulator_create(handle.get(), 1e-3, 2, &made) == CDCR_OK);
  const SimulatorHandle simulator(made);
  double time = 0.0;
  CHECK(cdcr_simulator_state(made, q.data(), qd.data(), &time) == CDCR_NOT_STARTED);
  CHECK(cdcr_simulator_step(made, command.data()) == CDCR_NOT_STARTED);
  REQUIRE(cdcr_simulator_reset(made, zero.data(), zero.data(), 1.5) == CDCR_OK);
  Simulator twin(model, 1e-3, 2);
  twin.reset(zero, zero, 1.5);
  const long count = allocations_of([&] {
    for (int i = 0; i < 50; ++i) {
      CHECK_EQ(cdcr_simulator_step(made, command.data()), CDCR_OK);
      CHECK(twin.step(command) == Status::ok);
    }
    CHECK_EQ(cdcr_simulator_state(made, q.data(), qd.data(), &time), CDCR_OK);
  });
  if (allocations_counted) CHECK(count == 0);
  CHECK(same(q, twin.q()));
  CHECK(same(qd, twin.qd()));
  CHECK(time == twin.time());
  CHECK(cdcr_simulator_state(made, nullptr, nullptr, nullptr) == CDCR_OK);
}

TEST_CASE("what is wrong is a code and a sentence") {
  cdcr_model* none = nullptr;
  CHECK(cdcr_model_load("none.toml", &none) == CDCR_INVALID_ARGUMENT);
  CHECK(std::string(cdcr_last_error()) == "none.toml: there is no such file, or it cannot be read");
  CHECK(cdcr_model_from_toml("sections = []", &none) == CDCR_INVALID_ARGUMENT);
  CHECK(std::string(cdcr_last_error()) == "robot: the number of sections must be 1 to 32, got 0");
  CHECK(none == nullptr);
  CHECK(cdcr_model_load(nullptr, &none) == CDCR_INVALID_ARGUMENT);
  CHECK(std::string(cdcr_last_error()) == "a pointer is NULL that must not be");
  CHECK(cdcr_num_coordinates(nullptr) == 0);
  cdcr_model_free(nullptr);
  cdcr_workspace_free(nullptr);
  cdcr_simulator_free(nullptr);

  const ModelHandle model = load("amouri2020");
  const WorkspaceHandle workspace = workspace_of(model);
  cdcr_workspace* const w = workspace.get();
  const double zero[3] = {}, far[2] = {10.0, 0.0}, wrong[2] = {nan, 0.0},
               push[3] = {-1.0, 0.0, 0.0};
  double out[2] = {7.0, 7.0}, more[12];
  CHECK(cdcr_forward_dynamics(w, far, zero, zero, out) == CDCR_BENDING_LIMIT);
  CHECK(cdcr_forward_dynamics(w, wrong, zero, zero, out) == CDCR_NON_FINITE_STATE);
  CHECK(cdcr_forward_dynamics(w, zero, wrong, zero, out) == CDCR_NON_FINITE_STATE);
  CHECK(cdcr_derivatives(w, far, zero, zero, more, more + 4, more + 8) == CDCR_BENDING_LIMIT);
  CHECK(cdcr_tip_pose(w, far, more, more + 3) == CDCR_BENDING_LIMIT);
  CHECK(cdcr_forward_dynamics(w, zero, zero, nullptr, out) == CDCR_INVALID_ARGUMENT);
  CHECK(out[0] == 7.0);  // nothing was written
  CHECK(cdcr_equilibrium(model.get(), push, nullptr, out, nullptr) == CDCR_INVALID_ARGUMENT);
  CHECK(std::strstr(cdcr_last_error(), "a cable cannot push") != nullptr);

  cdcr_simulator* made = nullptr;
  CHECK(cdcr_simulator_create(model.get(), 0.0, 1, &made) == CDCR_INVALID_ARGUMENT);
  REQUIRE(cdcr_simulator_create(model.get(), 1e-3, 1, &made) == CDCR_OK);
  const SimulatorHandle simulator(made);
  CHECK(cdcr_simulator_reset(made, far, zero, 0.0) == CDCR_INVALID_ARGUMENT);
  REQUIRE(cdcr_simulator_reset(made, zero, zero, 0.0) == CDCR_OK);
  CHECK(cdcr_simulator_step(made, push) == CDCR_INVALID_TENSION);
}

TEST_CASE("a robot without inertia has statics alone") {
  const ModelHandle model = load("rao2021");
  const WorkspaceHandle workspace = workspace_of(model);
  const VectorXd zero =
      VectorXd::Zero(std::max(cdcr_num_coordinates(model.get()), cdcr_num_cables(model.get())));
  VectorXd out(zero.size());
  double p[3], R[9];
  CHECK(cdcr_tip_pose(workspace.get(), zero.data(), p, R) == CDCR_OK);
  CHECK(cdcr_forward_dynamics(workspace.get(), zero.data(), zero.data(), zero.data(), out.data()) ==
        CDCR_INVALID_ARGUMENT);
  CHECK(std::string(cdcr_last_error()).size() > 20);
}

TEST_CASE("codes are those of Status, in its order, and each has a sentence") {
  CHECK(CDCR_NON_FINITE_STATE == static_cast<int>(Status::non_finite_state));
  CHECK(CDCR_BENDING_LIMIT == static_cast<int>(Status::bending_limit));
  CHECK(CDCR_INVALID_WRENCH == static_cast<int>(Status::invalid_wrench));
  CHECK(CDCR_COMPRESSION_LIMIT == static_cast<int>(Status::compression_limit));
  CHECK(std::string(cdcr_message(CDCR_OK)).empty());
  for (int code = CDCR_FAILED; code <= CDCR_COMPRESSION_LIMIT; ++code) {
    if (code != 0) CHECK(std::strlen(cdcr_message(static_cast<cdcr_status>(code))) > 10);
  }
  CHECK(std::string(cdcr_version()) == version);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
