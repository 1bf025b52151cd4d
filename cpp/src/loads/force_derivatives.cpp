#include "loads/force_derivatives.hpp"

#include "loads/cable_force.hpp"
#include "loads/wrench_derivatives.hpp"
#include "section/width.hpp"

namespace cdcr::detail {
namespace {

double& lane(const LaneMap& lanes, Quad* rows, Index row, Index at) {
  return rows[row * lanes.width() + at / Quad::count][static_cast<int>(at % Quad::count)];
}

/// Whether cables and their springs pull with the same B at all states.
bool pulls_constantly(const Model& model) {
  return model.has_constant_actuation() && !model.has_friction();
}

/// Of such cables.
void add_constant_columns(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                          const ConstVectorRef& command, const LaneMap& lanes, Quad* rows) {
  const MatrixXd& B = model.actuation_matrix();
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    const Index size = model.cable_rows()[static_cast<std::size_t>(j)];
    double on_command = 1.0;
    if (cable.length_driven()) {
      if (!(spring_force(model, j, q.data(), qd.data(), double{command[j]}) > 0.0)) continue;
      on_command = -cable.stiffness;
      for (Index i = 0; i < size; ++i) {
        for (Index k = 0; k < size; ++k) {
          const double both = B(i, j) * B(k, j);
          lane(lanes, rows, i, lanes.on_q(k)) -= cable.stiffness * both;
          lane(lanes, rows, i, lanes.on_qd(k)) -= cable.damping * both;
        }
      }
    }
    for (Index i = 0; i < size; ++i) {
      lane(lanes, rows, i, lanes.on_command(j)) += on_command * B(i, j);
    }
  }
}

/// Of all others, cable by cable on dual numbers.
void add_cable_columns(const Model& model, ForceDuals& duals, const LaneMap& lanes, Quad* rows) {
  const Index d = model.num_coordinates();
  // Of the cables that it concerns.
  const auto sweep = [&](Index quad, const auto& concerns) {
    for (Index i = 0; i < d; ++i) duals.force[i] = Dual(0.0);
    for (Index j = 0; j < model.num_cables(); ++j) {
      if (!concerns(j)) continue;
      add_cable_force(model, j, duals.q.data(), duals.qd.data(), duals.command[j],
                      duals.force.data());
    }
    for (Index i = 0; i < d; ++i) rows[i * lanes.width() + quad] += duals.force[i].slopes;
  };
  for (Index section = 0; section < model.num_sections(); ++section) {
    const Index first = model.first_coordinate(section),
                size = model.first_coordinate(section + 1) - first;
    const auto passes = [&](Index j) {
      const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
      return cable.start_section <= section && section <= cable.end_section;
    };
    for (Index quad = lanes.first_quad(section), k = 0; quad < lanes.first_quad(section + 1);
         ++quad, k += Quad::count) {
      const auto seed = [&](double slope) {
        for (int l = 0; l < Quad::count && k + l < 2 * size; ++l) {
          const Index at = first + (k + l) % size;
          (k + l < size ? duals.q : duals.qd)[at].slopes[l] = slope;
        }
      };
      seed(1.0);
      sweep(quad, passes);
      seed(0.0);
    }
  }
  for (Index k = 0, quad = lanes.num_state_quads(); quad < lanes.width();
       ++quad, k += Quad::count) {
    const auto seed = [&](double slope) {
      for (int l = 0; l < Quad::count && k + l < model.num_cables(); ++l) {
        duals.command[k + l].slopes[l] = slope;
      }
    };
    seed(1.0);
    sweep(quad, [&](Index j) { return k <= j && j < k + Quad::count; });
    seed(0.0);
  }
}

}  // namespace

ForceDuals::ForceDuals(const Model& model) {
  if (pulls_constantly(model)) return;
  q.resize(static_cast<std::size_t>(model.num_coordinates()));
  qd.resize(q.size());
  force.resize(q.size());
  command.resize(static_cast<std::size_t>(model.num_cables()));
}

void add_force_derivatives(const Model& model, ForceDuals& duals, const ConstVectorRef& q,
                           const ConstVectorRef& qd, const ConstVectorRef& command,
                           const Wrenches& wrenches, const LaneMap& lanes, Quad* rows) noexcept {
  if (pulls_constantly(model)) {
    add_constant_columns(model, q, qd, command, lanes, rows);
  } else {
    for (Index i = 0; i < q.size(); ++i) {
      duals.q[i] = Dual(q[i]);
      duals.qd[i] = Dual(qd[i]);
    }
    for (Index j = 0; j < command.size(); ++j) duals.command[j] = Dual(command[j]);
    with_fma<double>([&] { add_cable_columns(model, duals, lanes, rows); });
  }
  for (const Wrench& wrench : wrenches) {
    differentiate_wrench(chain_of(model), q.data(), wrench,
                         [&](Index row, Index coordinate, double slope) {
                           lane(lanes, rows, row, lanes.on_q(coordinate)) += slope;
                         });
  }
}

void subtract_wrench_stiffness(const Model& model, const ConstVectorRef& q,
                               const Wrenches& wrenches, MatrixRef K) noexcept {
  for (const Wrench& wrench : wrenches) {
    differentiate_wrench(
        chain_of(model), q.data(), wrench,
        [&](Index row, Index coordinate, double slope) { K(row, coordinate) -= slope; });
  }
}

}  // namespace cdcr::detail
