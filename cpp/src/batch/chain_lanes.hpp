#pragma once

#include <memory>

#include "batch/pack_tables.hpp"
#include "chain/chain.hpp"

namespace cdcr::detail {

/// A place of the backbone that a frame is wanted of, and what the frame is moved by there, or
/// turned.
struct Place {
  Index section;
  double fraction;
  Vector3d offset = Vector3d::Zero();  // in the frame there
  Matrix3d turn = Matrix3d::Identity();
};

/// The functions of chain/functions.hpp, of W states of a chain of arcs at once. Made for one
/// chain, which must outlive it. Real-time safe.
template <int W>
class ChainLanes {
 public:
  using P = Pack<W>;

  explicit ChainLanes(const Chain& chain)
      : chain_(chain), state_(std::make_unique<ArcChainState<P>>()) {}

  /// All of num_coordinates, force and qdd generalised forces and accelerations.
  void accelerate(const P* q, const P* qd, const P* force, P* qdd) noexcept;
  /// Without `qdd` the bias.
  void inverse_dynamics(const P* q, const P* qd, const P* qdd, P* force) noexcept;
  /// Column by column.
  void mass_matrix(const P* q, P* M) noexcept;
  void kinetic_energy(const P* q, const P* qd, P* T) noexcept;
  void potential_energy(const P* q, P* U) noexcept;
  void potential_gradient(const P* q, P* gradient) noexcept;
  /// R, row by row, and p from the base.
  void pose(const P* q, const Place& place, P* R, P* p) noexcept;
  /// Of that frame, row by row (6, d).
  void jacobian(const P* q, const Place& place, P* J) noexcept;

 private:
  void update_position(const P* q) noexcept;
  void update(const P* q, const P* qd) noexcept;

  const Chain& chain_;
  std::unique_ptr<ArcChainState<P>> state_;  // too large for some stacks
};

extern template class ChainLanes<2>;
#if defined(__x86_64__)
extern template class ChainLanes<4>;
#endif

}  // namespace cdcr::detail
