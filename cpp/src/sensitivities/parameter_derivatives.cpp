#include <Eigen/LU>
#include <algorithm>

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/parameters.hpp"
#include "cdcr/statics.hpp"
#include "chain/single_section.hpp"
#include "dynamics/parts.hpp"
#include "loads/total_force.hpp"
#include "sensitivities/parameter_rooms.hpp"

namespace cdcr {

ParameterData::Rooms::Rooms(const Model& model)
    : qdd(model.num_coordinates()),
      force(model.num_coordinates()),
      mass(model.num_coordinates()),
      slack_(static_cast<std::size_t>(model.num_cables()), 0) {
  const detail::Chain& chain = detail::chain_of(model);
  if (chain.has_rods()) {
    rods_ = std::make_unique<detail::RodMotionState>(chain);
  } else {
    arcs_ = std::make_unique<detail::MotionState>(chain);
  }
}

void ParameterData::Rooms::inverse_dynamics(const Model& model, const double* q, const double* qd,
                                            const double* accelerations, double* out) noexcept {
  const detail::Chain& chain = detail::chain_of(model);
  if (model.has_closed_form()) {
    detail::closed_form::inverse_dynamics(detail::single_of(model), q, qd, accelerations, out);
  } else if (arcs_) {
    update_motion(chain, *arcs_, q, qd);
    inverse_motion(chain, *arcs_, accelerations, out);
  } else {
    update_motion(chain, *rods_, q, qd);
    inverse_motion(chain, *rods_, accelerations, out);
  }
}

void ParameterData::Rooms::find_slack(const Model& model, const double* q, const double* qd,
                                      const double* command) noexcept {
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    slack_[static_cast<std::size_t>(j)] =
        cable.length_driven() && !(detail::spring_force(model, j, q, qd, command[j]) > 0.0) ? 1 : 0;
  }
}

void ParameterData::Rooms::load(const Model& model, const double* q, const double* qd,
                                const double* command, const Wrenches& wrenches,
                                double* out) noexcept {
  if (model.has_plain_cables()) return detail::total_force(model, q, qd, command, wrenches, out);
  std::fill_n(out, model.num_coordinates(), 0.0);
  for (Index j = 0; j < model.num_cables(); ++j) {
    if (slack_[static_cast<std::size_t>(j)] != 0) continue;
    const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
    const double tension =
        by_length ? detail::spring_force(model, j, q, qd, command[j]) : command[j];
    detail::add_pulled_force(model, j, q, qd, tension, out);
  }
  detail::add_wrench_force(detail::chain_of(model), q, wrenches, out);
}

ParameterData::ParameterData(const Model& model) : rooms_(std::make_unique<Rooms>(model)) {}
ParameterData::ParameterData(ParameterData&&) noexcept = default;
ParameterData& ParameterData::operator=(ParameterData&&) noexcept = default;
ParameterData::~ParameterData() = default;

void imbalance_derivatives(const ParameterSet& parameters, ParameterData& room,
                           const ConstVectorRef& q, const ConstVectorRef& qd,
                           const ConstVectorRef& qdd, const ConstVectorRef& command,
                           const Wrenches& wrenches, MatrixRef slopes) noexcept {
  assert(detail::has_size(slopes, q.size(), parameters.size()));
  ParameterData::Rooms& rooms = room.rooms();
  VectorXd& value = rooms.force;
  rooms.find_slack(parameters.model(), q.data(), qd.data(), command.data());
  slopes.setZero();
  for (Index k = 0; k < parameters.size(); ++k) {
    const ParameterSet::Slope& slope = parameters.slopes()[static_cast<std::size_t>(k)];
    for (const auto& [model, weight] : slope.points) {
      if (slope.inertia) {
        rooms.inverse_dynamics(model, q.data(), qd.data(), qdd.data(), value.data());
        slopes.col(k) += weight * value;
      }
      if (slope.force) {
        rooms.load(model, q.data(), qd.data(), command.data(), wrenches, value.data());
        slopes.col(k) -= weight * value;
      }
    }
  }
}

void parameter_derivatives(const Model& model, Data& data, const ParameterSet& parameters,
                           ParameterData& room, const ConstVectorRef& q, const ConstVectorRef& qd,
                           const ConstVectorRef& command, const Wrenches& wrenches,
                           MatrixRef slopes) noexcept {
  ParameterData::Rooms& rooms = room.rooms();
  forward_dynamics(model, data, q, qd, command, wrenches, rooms.qdd);
  imbalance_derivatives(parameters, room, q, qd, rooms.qdd, command, wrenches, slopes);
  mass_matrix(model, data, q, rooms.mass.matrix);
  rooms.mass.factorize();
  for (Index k = 0; k < slopes.cols(); ++k) rooms.mass.solve(slopes.col(k).data());
  slopes *= -1.0;
}

MatrixXd equilibrium_derivatives(const Model& model, const ParameterSet& parameters,
                                 const VectorXd& q, const VectorXd& command,
                                 const Wrenches& wrenches) {
  const Index d = model.num_coordinates();
  detail::require_finite("q", q, d);
  detail::require_finite("command", command, model.num_cables());
  validate(model, wrenches);
  ParameterData room(model);
  MatrixXd slopes(d, parameters.size()), stiffness(d, d);
  const VectorXd still = VectorXd::Zero(d);
  imbalance_derivatives(parameters, room, q, still, still, command, wrenches, slopes);
  static_stiffness(model, q, command, wrenches, stiffness);
  return -stiffness.partialPivLu().solve(slopes);
}

}  // namespace cdcr
