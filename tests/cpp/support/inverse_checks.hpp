#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "cases.hpp"
#include "cdcr/inverse_kinematics.hpp"
#include "residual.hpp"
#include "tolerances.hpp"

// What holds for every answer of inverse kinematics.

namespace cdcr::test {

constexpr double full_circle = 2.0 * pi;

inline double total_length(const Model& model) {
  double length = 0.0;
  for (const Section& section : model.robot().sections) length += section.length;
  return length;
}

/// What every answer must say truthfully about itself.
inline void check_consistent(const Model& model, const Vector3d& p, const InverseKinematics& answer,
                             double max_theta = full_circle) {
  const Pose at = tip(model, answer.q);
  const double scale = std::fmax(total_length(model), p.norm());
  CHECK(answer.position == at.p);
  CHECK(answer.rotation == at.R);
  CHECK(residual(answer.distance, (at.p - p).norm(), scale) <= tolerance::rounding);
  CHECK(answer.residual >= answer.distance);
  CHECK(answer.reachable == (answer.reach == IkStatus::reached));
  CHECK(answer.reachable == answer.message.empty());
  for (Index i = 0; i < model.num_sections(); ++i) {
    CHECK(answer.q.segment<2>(2 * i).norm() <= max_theta);
  }
}

/// Outward pull of section i at q: minus the slope of |tip - p|^2 / 2 along q_i, and across it.
struct Pull {
  double outward, across;
};

inline Pull pull(const Model& model, const InverseKinematics& answer, const Vector3d& p, Index i) {
  MatrixXd J(6, model.num_coordinates());
  jacobian(model, answer.q, model.num_sections() - 1, 1.0, J);
  const Eigen::Vector2d slope = -J.block<3, 2>(0, 2 * i).transpose() * (answer.position - p);
  const Eigen::Vector2d n = answer.q.segment<2>(2 * i).normalized();
  return {slope.dot(n), slope[1] * n[0] - slope[0] * n[1]};
}

}  // namespace cdcr::test
