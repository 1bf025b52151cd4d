// A robot of any description, and every function of one state.
#include "cdcr/cables.hpp"
#include "cdcr/coordinates.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/statics.hpp"
#include "input.hpp"

namespace cdcr::fuzz {
namespace {

/// What a usual robot has at a usual state.
void demand_usual(bool usual, bool finite, const char* what) {
  demand(!usual || finite, what);
}

/// Whether friction may make more of a tension than a double holds, e^(mu theta) of eq. (103).
bool rubs_beyond_measure(const Model& model, const VectorXd& q) {
  for (Index j = 0; j < model.num_cables(); ++j) {
    double turn = 0.0;
    for (Index k = 0; k < model.num_sections(); ++k) {
      turn += model.friction()(k, j) * q.segment(2 * k, 2).norm();
    }
    if (turn > 300.0) return true;
  }
  return false;
}

void check_positions(const Model& model, Input& input, const VectorXd& q, bool usual) {
  const auto section = Index{input.integer(0, static_cast<int>(model.num_sections()) - 1)};
  const double fraction = input.byte() / 255.0;
  const Pose frame = pose(model, q, section, fraction), end = tip(model, q);
  MatrixXd J(6, model.num_coordinates());
  jacobian(model, q, section, fraction, J);
  VectorXd lengths(model.num_cables());
  cable_lengths(model, q, lengths);
  demand_usual(usual,
               frame.p.allFinite() && frame.R.allFinite() && end.p.allFinite() &&
                   end.R.isUnitary(1e-6) && J.allFinite() && lengths.allFinite(),
               "a frame, a Jacobian or a length that is not finite");
}

void check_cables(const Model& model, Input& input, const VectorXd& q, const VectorXd& qd,
                  const VectorXd& command, bool usual) {
  VectorXd tension(model.num_cables()), force(model.num_coordinates());
  MatrixXd along(model.num_sections() + 1, model.num_cables());
  cable_tensions(model, q, qd, command, tension);
  cable_force(model, q, qd, command, force);
  tensions_along(model, q, qd, command, along);
  const Wrenches wrenches = input.wrenches(model, 2);
  usual = usual && !input.is_wild();
  if (check_wrenches(model, wrenches) == Status::ok) add_wrench_force(model, q, wrenches, force);
  demand_usual(usual,
               tension.allFinite() && force.allFinite() && along.allFinite() &&
                   std::isfinite(friction_power(model, q, qd, command)) &&
                   std::isfinite(cable_energy(model, q, command)),
               "a force of cables or wrenches that is not finite");
}

void check_motion(const Model& model, const VectorXd& q, const VectorXd& qd,
                  const VectorXd& command, bool usual) {
  const Index d = model.num_coordinates();
  Data data(model);
  VectorXd qdd(d), force(d);
  MatrixXd M(d, d), A(2 * d, 2 * d), B(2 * d, model.num_cables());
  mass_matrix(model, data, q, M);
  bias(model, data, q, qd, force);
  demand_usual(usual, M.allFinite() && force.allFinite(), "a mass or a bias that is not finite");
  potential_gradient(model, data, q, force);
  potential_hessian(model, data, q, M);
  demand_usual(usual,
               M.allFinite() && force.allFinite() &&
                   std::isfinite(potential_energy(model, data, q)) &&
                   std::isfinite(kinetic_energy(model, data, q, qd)),
               "an energy or its derivative that is not finite");
  static_stiffness(model, q, command, no_wrenches(), M);
  demand_usual(usual, M.allFinite(), "a stiffness that is not finite");
  inverse_dynamics(model, data, q, qd, qd, force);
  demand_usual(usual, force.allFinite(), "inverse dynamics that are not finite");
  if (!model.has_inertia()) return;
  forward_dynamics(model, data, q, qd, command, qdd);
  linearize(model, data, q, qd, command, A, B);
  demand_usual(usual, qdd.allFinite() && A.allFinite() && B.allFinite(),
               "an acceleration or its derivative that is not finite");
}

void check(Input input) {
  const std::optional<Model> model = input.model();
  if (!model) return;
  const VectorXd q = input.vector(model->num_coordinates(), 1.0);
  const VectorXd qd = input.vector(model->num_coordinates(), 1.0);
  const VectorXd command = input.magnitudes(model->num_cables(), 1.0);
  const bool usual = !input.is_wild() && model->formulation() == Formulation::exact &&
                     !rubs_beyond_measure(*model, q);
  check_positions(*model, input, q, usual);
  check_cables(*model, input, q, qd, command, usual);
  check_motion(*model, q, qd, command, usual);
  const Polar angles = polar(q[0], q[1]);
  demand_usual(usual, std::isfinite(angles.theta) && std::isfinite(angles.phi),
               "angles that are not finite");
}

}  // namespace
}  // namespace cdcr::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cdcr::fuzz::check({data, size});
  return 0;
}
