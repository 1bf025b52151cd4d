#pragma once

#include <memory>

#include "cdcr/model.hpp"

namespace cdcr::detail {

/// How cdcr::base_wrench without wrenches changes with (q, qd, qdd), exact to rounding. Set-up
/// allocates; the rest is real-time safe.
class BaseSlopes {
 public:
  explicit BaseSlopes(const Model& model);
  BaseSlopes(BaseSlopes&&) noexcept;
  ~BaseSlopes();

  /// (6, 3d), of the model that it was made for.
  void update(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
              const ConstVectorRef& qdd, MatrixRef slopes) noexcept;

 private:
  std::unique_ptr<Data::Kept> kept_;  // Data has none of one section in closed form
};

}  // namespace cdcr::detail
