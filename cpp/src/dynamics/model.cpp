#include "cdcr/model.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/magnitudes.hpp"
#include "base/rotation.hpp"
#include "dynamics/kept.hpp"
#include "section/inertia_series.hpp"

namespace cdcr {
namespace {

detail::SectionSeries series_of(const Section& section, double payload, Formulation formulation) {
  const bool printed =
      formulation == Formulation::printed || formulation == Formulation::printed_taylor;
  const bool cut = formulation == Formulation::taylor || formulation == Formulation::printed_taylor;
  const detail::SectionSeries series =
      printed ? detail::printed_series(section, payload) : detail::exact_series(section, payload);
  return cut ? detail::cut_after_fourth_power(series) : series;
}

}  // namespace

Model::Model(Robot robot, Formulation formulation)
    : Model(std::move(robot), formulation, nullptr) {}
Model::Model(Robot robot, const Model& like) : Model(std::move(robot), like.formulation_, &like) {}

Model::Model(Robot robot, Formulation formulation, const Model* like) : formulation_(formulation) {
  validate(robot);
  robot.base_orientation = detail::nearest_rotation(robot.base_orientation);
  has_tool_ = robot.tool != Transform::Identity();
  robot.tool.topLeftCorner<3, 3>() = detail::nearest_rotation(robot.tool.topLeftCorner<3, 3>());
  robot_ = std::make_shared<const Robot>(std::move(robot));
  const detail::KnownTables known =
      like == nullptr ? detail::KnownTables()
                      : detail::KnownTables{&like->robot_->sections, &like->parts_->chain};
  const auto parts =
      std::make_shared<Parts>(Parts{detail::Chain(*robot_, known), {}, {}, {}, {}, {}});
  parts_ = parts;
  first_ = parts->chain.first;
  has_rods_ = parts->chain.has_rods();
  set_elasticity(*parts);
  set_cables(*parts);
  detail::require_magnitudes(*this);

  const bool point = robot_->payload_position.isZero(0.0) && robot_->payload_inertia.isZero(0.0);
  const Section& first = robot_->sections[0];
  const bool alike =
      first.disk_positions.empty() && first.disk_masses.empty() && first.disk_diameters.empty();
  if (num_sections() == 1 && point && !has_rods_ && (alike || formulation == Formulation::exact)) {
    const bool known_shape = like != nullptr && like->has_closed_form_ &&
                             like->robot_->payload == robot_->payload &&
                             detail::moves_alike(like->robot_->sections[0], first);
    const detail::ShapeTable table =
        known_shape ? detail::single_of(*like).table
                    : detail::ShapeTable(series_of(first, robot_->payload, formulation));
    parts->single = detail::SingleSection{table,       first.length,     stiffness_[0],
                                          damping_[0], Vector3d::Zero(), false};
    has_closed_form_ = true;
  } else if (formulation != Formulation::exact) {
    throw std::invalid_argument(std::string("formulation must be exact for this robot, got ") +
                                name(formulation) +
                                ": the paper's inertia is that of one section with equal, equally "
                                "spaced disks, and nothing but a point on its tip");
  }
  singular_section_ = detail::find_singular_section(parts->chain);
  set_gravity(robot_->gravity, parts);
}

void Model::set_elasticity(Parts& parts) {
  const detail::Chain& chain = parts.chain;
  const Index d = chain.num_coordinates(), n = chain.num_sections();
  stiffness_.resize(n);
  damping_.resize(n);
  parts.rest = VectorXd::Zero(d);
  parts.elastic_stiffness = MatrixXd::Zero(d, d);
  for (Index i = 0; i < n; ++i) {
    const detail::SectionParameters& section = chain.sections[i];
    const Index at = first_[i], size = first_[i + 1] - at;
    stiffness_[i] = section.stiffness;
    damping_[i] = section.damping;
    if (has_rods_) {
      parts.elastic_stiffness.block(at, at, size, size) = section.rod->stiffness;
      parts.rest.segment(at, size) = section.rod->rest;
    } else {
      parts.elastic_stiffness.diagonal().segment(at, size).setConstant(section.stiffness);
    }
  }
}

/// A cable runs from the base of its first section to the end of its last: Q_k += r e(gamma) F.
void Model::set_cables(Parts& parts) {
  const detail::Chain& chain = parts.chain;
  const Index d = chain.num_coordinates(), n = chain.num_sections();
  cables_ = robot_->all_cables();
  const auto num_cables = static_cast<Index>(cables_.size());
  actuation_.setZero(d, num_cables);
  straight_lengths_.setZero(num_cables);
  friction_.setZero(n, num_cables);
  sheath_decay_.setOnes(num_cables);
  slack_offset_.setZero(num_cables);
  const VectorXd straight = VectorXd::Zero(d);
  for (Index j = 0; j < num_cables; ++j) {
    const Cable& cable = cables_[j];
    cable_rows_.push_back(first_[cable.end_section + 1]);
    for (Index k = cable.start_section; k <= cable.end_section; ++k) {
      friction_(k, j) = cable.friction.value_or(robot_->sections[k].cable_friction);
      const bool twists =
          robot_->sections[k].twist_order != locked || robot_->sections[k].rest_twist != 0.0;
      if (twists || !cable.straight()) has_constant_actuation_ = false;
      if (has_rods_) continue;
      const CableRoute route = cable.route(static_cast<int>(k));
      actuation_.col(j).segment<detail::ConstantCurvature<double>::m>(first_[k]) =
          detail::ConstantCurvature<double>::actuation(route.base_radius, route.base_angle);
      straight_lengths_[j] += robot_->sections[k].length;
    }
    if (has_rods_) {
      parts.paths.emplace_back(chain, cable);
      straight_lengths_[j] =
          parts.paths.back().length(chain, straight.data(), 1.0, actuation_.col(j).data());
    }
    sheath_decay_[j] = std::exp(-cable.sheath_friction);
    has_friction_ = has_friction_ || cable.entry_friction > 0.0 || cable.sheath_friction > 0.0 ||
                    cable.viscosity > 0.0;
    if (cable.length_driven()) {
      has_plain_cables_ = false;
      slack_offset_[j] = -cable.pretension / cable.stiffness;
      has_backlash_ = has_backlash_ || cable.backlash > 0.0;
    }
    if (cable.start_section > 0) has_nested_cables_ = false;
  }
  has_friction_ = has_friction_ || (friction_.array() > 0.0).any();
  if (has_friction_ && robot_->presliding_stiffness > 0.0) num_deflections_ = num_cables;
  if (num_deflections_ > 0) least_friction_ = detail::least_friction(*this);
  if (num_deflections_ > 0 && !has_rods_) parts.cable_lanes = detail::CableLanes(*this);
  has_plain_cables_ = has_plain_cables_ && !has_friction_ && has_constant_actuation_;
  has_nested_cables_ = has_nested_cables_ && !has_rods_;
}

void Model::set_gravity(const Vector3d& gravity, const std::shared_ptr<Parts>& parts) {
  root_gravity_ = robot_->base_orientation.transpose() * gravity;
  has_gravity_ = gravity != Vector3d::Zero();
  double mass = parts->chain.payload.mass;
  for (const detail::SectionParameters& section : parts->chain.sections) mass += section.mass;
  base_energy_ = -mass * gravity.dot(robot_->base_position);
  parts->chain.gravity = gravity;
  if (parts->single) {
    parts->single->gravity = root_gravity_;
    parts->single->has_gravity = has_gravity_;
  }
  parts_ = parts;
}

const VectorXd& Model::rest() const noexcept {
  return parts_->rest;
}
const MatrixXd& Model::elastic_stiffness() const noexcept {
  return parts_->elastic_stiffness;
}

Model Model::with_gravity(const Vector3d& gravity) const {
  const auto robot = std::make_shared<Robot>(*robot_);
  robot->gravity = gravity;
  validate(*robot);
  Model model = *this;
  model.robot_ = robot;
  model.set_gravity(gravity, std::make_shared<Parts>(*parts_));
  return model;
}

std::vector<std::string> Model::coordinate_names() const {
  std::vector<std::string> names;
  const auto add = [&](const std::string& strain, int order) {
    names.push_back(order == 0 ? strain : strain + "_" + std::to_string(order));
  };
  for (Index i = 0; i < num_sections(); ++i) {
    const Section& section = robot_->sections[i];
    const std::string number = std::to_string(i + 1);
    for (int k = 0; k <= section.bending_order; ++k) {
      for (const char* component : detail::ConstantCurvature<double>::component_names) {
        add("q" + number + "_" + component, k);
      }
    }
    for (int k = 0; k <= section.twist_order; ++k) add("t" + number, k);
    for (int k = 0; k <= section.stretch_order; ++k) add("e" + number, k);
  }
  return names;
}

void require_inertia(const Model& model) {
  if (model.has_inertia()) return;
  throw std::invalid_argument(
      "the robot has no dynamics, because section " + std::to_string(model.singular_section() + 1) +
      (model.has_rods() ? " can move" : " can bend") +
      " without moving any mass: give it a backbone_mass or disks with a disk_mass, or "
      "the robot a payload");
}

Data::Data(const Model& model)
    : force(VectorXd::Zero(model.num_coordinates())),
      parts_(model.parts()),
      kept_(model.has_closed_form() && model.has_plain_cables() ? nullptr
                                                                : std::make_unique<Kept>(model)) {}
Data::Data(const Data& other)
    : force(other.force),
      parts_(other.parts_),
      kept_(other.kept_ ? std::make_unique<Kept>(*other.kept_) : nullptr) {}
Data::Data(Data&& other) noexcept = default;
Data& Data::operator=(const Data& other) {
  if (this != &other) *this = Data(other);
  return *this;
}
Data& Data::operator=(Data&& other) noexcept = default;
Data::~Data() = default;

}  // namespace cdcr
