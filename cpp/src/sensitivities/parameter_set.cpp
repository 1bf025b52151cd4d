#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

#include "base/arguments.hpp"
#include "sensitivities/parameter_rooms.hpp"

namespace cdcr {
namespace {

using Slope = ParameterSet::Slope;

// Steps, in sizes of the parameter: of second degree a difference has no error but rounding.
constexpr double wide = 1.0 / 8.0, narrow = 0.01;
constexpr int num_probes = 3;

/// Weights of values at these offsets in the derivative at 0: those of the polynomial through them.
std::vector<double> difference_weights(const std::vector<int>& offsets) {
  std::vector<double> weights;
  for (const int own : offsets) {
    double derivative = 0.0;
    for (const int cut : offsets) {
      if (cut == own) continue;
      double product = 1.0 / (own - cut);
      for (const int other : offsets) {
        if (other != own && other != cut) product *= -1.0 * other / (own - other);
      }
      derivative += product;
    }
    weights.push_back(derivative);
  }
  return weights;
}

/// Offsets around 0, upwards or downwards, whose difference is of this even order.
std::vector<int> offsets_of(int order, int side) {
  std::vector<int> offsets;
  const int from = side == 0 ? -order / 2 : 0;
  for (int k = from; k <= from + order; ++k) {
    if (side == 0 && k == 0) continue;
    offsets.push_back(side < 0 ? -k : k);
  }
  return offsets;
}

/// What a robot must keep for its derivatives to exist.
void require_same_kind(const Model& model, const Model& other) {
  bool same = model.num_coordinates() == other.num_coordinates() &&
              model.num_cables() == other.num_cables() && model.has_rods() == other.has_rods();
  for (std::size_t j = 0; same && j < model.cables().size(); ++j) {
    same = model.cables()[j].length_driven() == other.cables()[j].length_driven();
  }
  detail::require(same,
                  "a change of it makes another kind of robot (an arc becomes a rod, or a cable is "
                  "driven otherwise)");
}

Slope slope_at(const Model& model, const Parameter& parameter, double step, int order, int side) {
  Slope slope;
  const std::vector<int> offsets = offsets_of(order, side);
  const std::vector<double> weights = difference_weights(offsets);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    Model there(parameter.robot_at(parameter.value + offsets[i] * step), model);
    require_same_kind(model, there);
    slope.points.push_back({std::move(there), weights[i] / step});
  }
  return slope;
}

/// On both sides where the parameter may go there, else on one. What forbids an increase says most.
Slope slope_with(const Model& model, const Parameter& parameter, double step, int order) {
  std::exception_ptr refusal;
  for (const int side : {0, 1, -1}) {
    try {
      return slope_at(model, parameter, step, order, side);
    } catch (const std::invalid_argument&) {
      if (side == 1) refusal = std::current_exception();
    }
  }
  std::rethrow_exception(refusal);
}

/// A state in which all terms count, with a wrench, and cables that pull.
struct Probe {
  Probe(const Model& model, std::mt19937& engine) {
    const auto draw = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
    };
    const Index d = model.num_coordinates();
    q.resize(d);
    qd.resize(d);
    qdd.resize(d);
    const std::vector<std::string> names = model.coordinate_names();
    for (Index i = 0; i < d; ++i) {
      const std::string& name = names[static_cast<std::size_t>(i)];
      const double size = name[0] == 'e' ? 0.02 * model.robot().sections[0].length : 0.5;
      q[i] = draw(-size, size);
      qd[i] = draw(-10.0 * size, 10.0 * size);
      qdd[i] = draw(-200.0 * size, 200.0 * size);
    }
    command.resize(model.num_cables());
    for (Index j = 0; j < command.size(); ++j) {
      const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
      command[j] = by_length ? draw(0.3, 0.4) * model.straight_lengths()[j] : draw(2.0, 8.0);
    }
    for (const auto frame : {Wrench::Frame::base, Wrench::Frame::local}) {
      const Vector3d force(draw(0.5, 1.0), draw(0.5, 1.0), draw(0.5, 1.0));
      wrenches.push_back({model.num_sections() - 1, 0.7, force, 0.1 * force, frame});
    }
  }

  VectorXd q, qd, qdd, command;
  Wrenches wrenches;
};

/// Inertia force and load of a model in a probe, and their derivatives by a slope.
class Probing {
 public:
  explicit Probing(const Model& model) : room_(model) {
    std::mt19937 engine(1);  // NOLINT(bugprone-random-generator-seed): so must the answer be
    for (int i = 0; i < num_probes; ++i) probes_.emplace_back(model, engine);
    for (const Probe& probe : probes_) sizes_.push_back(values(model, probe).cwiseAbs());
  }

  /// (2 d, num_probes): of M qdd + h, then of the loads.
  MatrixXd derivatives(const Slope& slope) {
    MatrixXd all = MatrixXd::Zero(sizes_[0].size(), num_probes);
    for (const Slope::Point& point : slope.points) {
      for (int i = 0; i < num_probes; ++i) {
        all.col(i) += point.weight * values(point.model, probes_[static_cast<std::size_t>(i)]);
      }
    }
    return all;
  }

  /// The same, and notes in the slope which of the two depends on the parameter.
  MatrixXd find_dependence(Slope& slope) {
    MatrixXd all = derivatives(slope);
    slope.inertia = !all.topRows(all.rows() / 2).isZero(0.0);
    slope.force = !all.bottomRows(all.rows() / 2).isZero(0.0);
    return all;
  }

  /// Whether two derivatives differ by no more than rounding in steps of this size.
  [[nodiscard]] bool agree(const MatrixXd& a, const MatrixXd& b, double step) const {
    constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    for (int i = 0; i < num_probes; ++i) {
      const double size = sizes_[static_cast<std::size_t>(i)].maxCoeff();
      const double error = (a.col(i) - b.col(i)).cwiseAbs().maxCoeff();
      if (!(error <= rounding * (size / step + b.col(i).cwiseAbs().maxCoeff()))) return false;
    }
    return true;
  }

 private:
  VectorXd values(const Model& model, const Probe& probe) {
    const Index d = probe.q.size();
    VectorXd both(2 * d);
    room_.inverse_dynamics(model, probe.q.data(), probe.qd.data(), probe.qdd.data(), both.data());
    room_.load(model, probe.q.data(), probe.qd.data(), probe.command.data(), probe.wrenches,
               both.data() + d);
    return both;
  }

  ParameterData::Rooms room_;
  std::vector<Probe> probes_;
  std::vector<VectorXd> sizes_;
};

Slope slope_of(const Model& model, const Parameter& parameter, Probing& probing) {
  detail::require(static_cast<bool>(parameter.robot_at), "no function of it is given");
  detail::require(
      std::isfinite(parameter.value) && std::isfinite(parameter.scale) && parameter.scale >= 0.0,
      "value and scale must be finite and >= 0, got ", parameter.value, " and ", parameter.scale);
  const double own = parameter.value == 0.0 ? 1.0 : std::abs(parameter.value);
  const double size = parameter.scale > 0.0 ? parameter.scale : own;
  Slope slope = slope_with(model, parameter, narrow * size, 8);
  const MatrixXd derivatives = probing.find_dependence(slope);
  try {
    Slope plain = slope_with(model, parameter, wide * size, 2);
    if (probing.agree(probing.derivatives(plain), derivatives, narrow * size)) {
      slope.points = std::move(plain.points);
      slope.exact = true;
    }
  } catch (const std::invalid_argument&) {
    return slope;  // it may not go so far
  }
  return slope;
}

}  // namespace

ParameterSet::ParameterSet(const Model& model, const std::vector<Parameter>& parameters)
    : model_(model) {
  std::vector<Slope> slopes;
  Probing probing(model);
  for (const Parameter& parameter : parameters) {
    try {
      slopes.push_back(slope_of(model, parameter, probing));
    } catch (const std::invalid_argument& error) {
      detail::refuse("parameter ", parameter.name, ": ", error.what());
    }
    names_.push_back(parameter.name);
  }
  slopes_ = std::make_shared<const std::vector<Slope>>(std::move(slopes));
}

ParameterSet::ParameterSet(const Model& model, const std::vector<ParameterSides>& parameters)
    : model_(model) {
  std::vector<Slope> slopes;
  Probing probing(model);
  for (const ParameterSides& sides : parameters) {
    names_.push_back(sides.name);
    Slope slope;
    try {
      for (const Model* there : {&sides.above, &sides.below}) {
        require_same_kind(model, *there);
        slope.points.push_back({*there, (there == &sides.above ? 1.0 : -1.0) / sides.width});
      }
    } catch (const std::invalid_argument& error) {
      detail::refuse("parameter ", sides.name, ": ", error.what());
    }
    probing.find_dependence(slope);
    slopes.push_back(std::move(slope));
  }
  slopes_ = std::make_shared<const std::vector<Slope>>(std::move(slopes));
}

bool ParameterSet::is_exact(Index parameter) const noexcept {
  return slopes()[static_cast<std::size_t>(parameter)].exact;
}

}  // namespace cdcr
