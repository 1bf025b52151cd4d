#include "cdcr/model.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

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
    tables_.emplace_back(series_of(section, robot_.payload, formulation));
    stiffness_[i] = section.stiffness();
    damping_[i] = section.damping;
  }

  // A cable runs from the base to the end of its own section: Q_k += r e(gamma) F for k <= i.
  const auto num_cables = static_cast<Index>(cables_.size());
  actuation_.setZero(2 * n, num_cables);
  straight_lengths_.setZero(num_cables);
  for (Index j = 0; j < num_cables; ++j) {
    const Cable& cable = cables_[j];
    for (Index k = 0; k <= cable.end_section; ++k) {
      actuation_(2 * k, j) = cable.radius * std::cos(cable.angle);
      actuation_(2 * k + 1, j) = cable.radius * std::sin(cable.angle);
      straight_lengths_[j] += robot_.sections[k].length;
    }
  }

  has_inertia_ = tables_[0](detail::ShapeTable::Group::inertia, 0.0)[0] > 0.0;
  has_gravity_ = robot_.gravity != Vector3d::Zero();
}

void require_inertia(const Model& model) {
  if (!model.has_inertia()) {
    throw std::invalid_argument(
        "the robot has no inertia, so it has no dynamics: give sections[0] a backbone_mass or "
        "disks with a disk_mass, or the robot a payload");
  }
}

Data::Data(const Model& model)
    : force(VectorXd::Zero(model.num_coordinates())),
      acceleration(VectorXd::Zero(model.num_coordinates())) {}

}  // namespace cdcr
