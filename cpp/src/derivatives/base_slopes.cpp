#include "derivatives/base_slopes.hpp"

#include "base/sizes.hpp"
#include "dynamics/kept.hpp"

namespace cdcr::detail {

BaseSlopes::BaseSlopes(const Model& model) : kept_(std::make_unique<Data::Kept>(model)) {}
BaseSlopes::BaseSlopes(BaseSlopes&&) noexcept = default;
BaseSlopes::~BaseSlopes() = default;

void BaseSlopes::update(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                        const ConstVectorRef& qdd, MatrixRef slopes) noexcept {
  assert(of_coordinates(model, q, qd, qdd) && has_size(slopes, 6, 3 * model.num_coordinates()));
  kept_->with_derivatives(
      model,
      [&](auto& chain, auto& state, auto& derivatives) {
        derivatives.differentiate_base(chain, state, q.data(), qd.data(), qdd.data(), slopes);
      },
      q.data(), qd.data());
}

}  // namespace cdcr::detail
