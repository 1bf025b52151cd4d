#include "cdcr/model.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "chain.hpp"
#include "chain_functions.hpp"
#include "section_series.hpp"

namespace cdcr {

namespace {

detail::SectionSeries series_of(const Section& section, double payload, Formulation formulation) {
  switch (formulation) {
    case Formulation::exact:
      break;
    case Formulation::taylor:
      return detail::cut_after_fourth_power(detail::exact_series(section, payload));
    case Formulation::printed:
      return detail::printed_series(section, payload);
    case Formulation::printed_taylor:
      return detail::cut_after_fourth_power(detail::printed_series(section, payload));
  }
  return detail::exact_series(section, payload);
}

}  // namespace

Model::Model(Robot robot, Formulation formulation)
    : robot_(std::move(robot)), formulation_(formulation) {
  validate(robot_);
  const auto n = static_cast<Index>(robot_.sections.size());
  cables_ = robot_.all_cables();
  stiffness_.resize(n);
  damping_.resize(n);
  for (Index i = 0; i < n; ++i) {
    const Section& section = robot_.sections[i];
    stiffness_[i] = section.stiffness();
    damping_[i] = section.damping;
  }

  // A cable runs from the base to the end of its own section: Q_k += r e(gamma) F for k <= i.
  const auto num_cables = static_cast<Index>(cables_.size());
  actuation_.setZero(2 * n, num_cables);
  straight_lengths_.setZero(num_cables);
  for (Index j = 0; j < num_cables; ++j) {
    const Cable& cable = cables_[j];
    cable_rows_.push_back(2 * (static_cast<Index>(cable.end_section) + 1));
    for (Index k = 0; k <= cable.end_section; ++k) {
      actuation_(2 * k, j) = cable.radius * std::cos(cable.angle);
      actuation_(2 * k + 1, j) = cable.radius * std::sin(cable.angle);
      straight_lengths_[j] += robot_.sections[k].length;
    }
  }

  friction_.setZero(n, num_cables);
  for (Index j = 0; j < num_cables; ++j) {
    const Cable& cable = cables_[j];
    for (Index k = 0; k <= cable.end_section; ++k) {
      friction_(k, j) = cable.friction.value_or(robot_.sections[k].cable_friction);
    }
    if (cable.length_driven()) has_plain_cables_ = false;
  }
  has_friction_ = (friction_.array() > 0.0).any();
  has_plain_cables_ = has_plain_cables_ && !has_friction_;
  root_gravity_ = robot_.base_orientation.transpose() * robot_.gravity;
  has_gravity_ = robot_.gravity != Vector3d::Zero();

  chain_ = std::make_shared<const detail::Chain>(robot_);
  const bool point = robot_.payload_position.isZero(0.0) && robot_.payload_inertia.isZero(0.0);
  const Section& first = robot_.sections[0];
  const bool alike =
      first.disk_positions.empty() && first.disk_masses.empty() && first.disk_diameters.empty();
  if (n == 1 && point && (alike || formulation == Formulation::exact)) {
    const auto series = series_of(robot_.sections[0], robot_.payload, formulation);
    table_ = std::make_shared<const detail::ShapeTable>(series);
  } else if (formulation != Formulation::exact) {
    throw std::invalid_argument(std::string("formulation must be exact for this robot, got ") +
                                name(formulation) +
                                ": the paper's inertia is that of one section with equal, equally "
                                "spaced disks, and nothing "
                                "but a point on its tip");
  }
  singular_section_ = detail::find_singular_section(*chain_);
}

void require_inertia(const Model& model) {
  if (model.has_inertia()) return;
  const std::string section = "sections[" + std::to_string(model.singular_section()) + "]";
  throw std::invalid_argument(
      "the robot has no dynamics, because " + section +
      " can bend without moving any mass: give it a backbone_mass or disks with a disk_mass, or "
      "the robot a payload");
}

Data::Data(const Model& model)
    : force(VectorXd::Zero(model.num_coordinates())),
      acceleration(VectorXd::Zero(model.num_coordinates())) {}

}  // namespace cdcr
