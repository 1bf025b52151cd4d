#pragma once

#include <memory>
#include <vector>

#include "chain/chain.hpp"
#include "json.hpp"
#include "section/rod.hpp"

// Chains of rods (section/rod.hpp): of the reference cases, and of robots of arcs.

namespace cdcr::test {

/// A case of tests/data/general_sections.json.
inline std::vector<Json> rod_cases() {
  return Json::load(CDCR_TEST_DATA "/general_sections.json").items();
}

inline detail::RodDescription described_rod(const Json& s) {
  detail::RodDescription rod;
  rod.length = s["length"].number();
  const VectorXd diameter = s["backbone_diameter"].vector();
  rod.mass = {s["backbone_mass"].number(),
              diameter[0],
              diameter[1],
              s["backbone_inner_diameter"].number(),
              {}};
  const int num_disks = s["num_disks"].integer();
  for (int k = 1; k <= num_disks; ++k) {
    rod.mass.disks.push_back(
        {static_cast<double>(k) / num_disks, s["disk_mass"].number(), s["disk_diameter"].number()});
  }
  rod.youngs_modulus = s["youngs_modulus"].number();
  rod.shear_modulus = s["shear_modulus"].number();
  rod.damping = s["damping"].number();
  rod.twist_damping = s["twist_damping"].number();
  rod.stretch_damping = s["stretch_damping"].number();
  rod.bending_order = s["bending_order"].integer();
  rod.twist_order = s["twist_order"].integer();
  rod.stretch_order = s["stretch_order"].integer();
  return rod;
}

/// A constant-curvature section as a rod of these orders.
inline detail::RodDescription described_rod(const Section& s, int bending_order, int twist_order,
                                            int stretch_order) {
  detail::RodDescription rod;
  rod.length = s.length;
  rod.mass = {s.backbone_mass, s.backbone_diameter, s.backbone_diameter, 0.0, s.disks()};
  rod.youngs_modulus = s.youngs_modulus;
  rod.shear_modulus = s.youngs_modulus / 2.6;
  rod.damping = s.damping;
  rod.twist_damping = 0.5 * s.damping;
  rod.stretch_damping = s.damping / (s.length * s.length);
  rod.bending_order = bending_order;
  rod.twist_order = twist_order;
  rod.stretch_order = stretch_order;
  return rod;
}

/// The chain with rods in place of its sections.
inline detail::Chain chain_of_rods(detail::Chain chain,
                                   const std::vector<detail::RodDescription>& rods) {
  chain.sections.resize(rods.size(), chain.sections[0]);
  chain.first = {0};
  for (std::size_t i = 0; i < rods.size(); ++i) {
    detail::SectionParameters& section = chain.sections[i];
    section.rod = std::make_shared<const detail::RodParameters>(rods[i]);
    section.mass = section.rod->mass;
    chain.first.push_back(chain.first.back() + section.rod->size());
  }
  return chain;
}

/// The chain of a reference case.
inline detail::Chain rod_chain(const Json& reference, int num_nodes) {
  Robot robot = amouri2020();  // for what its sections do not tell
  robot.gravity = reference["gravity"].vector();
  robot.payload = reference["payload"].number();
  std::vector<detail::RodDescription> rods;
  for (const Json& section : reference["sections"].items()) {
    rods.push_back(described_rod(section));
    rods.back().num_nodes = num_nodes;
  }
  return chain_of_rods(detail::Chain(robot), rods);
}

}  // namespace cdcr::test
