#pragma once

#include "cdcr/simulator.hpp"

namespace cdcr::detail {

/// What the base of a plant feels: base_wrench() at the accelerations that its cables make, with
/// their friction and the play of their drives. Real-time safe after construction.
class PlantBase {
 public:
  explicit PlantBase(const Model& model);

  /// At the plant's state, under commands (num_cables) and wrenches that validate() accepts; (6).
  void feel(const Simulator& plant, const VectorXd& command, const Wrenches& wrenches,
            VectorRef on_base) noexcept;

 private:
  Data data_;
  VectorXd felt_, force_, rate_, qdd_;
};

}  // namespace cdcr::detail
