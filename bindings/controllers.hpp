#pragma once

#include <exception>

#include "cdcr/controller.hpp"

namespace cdcr::python {

/// A controller written in Python, which takes any robot: what it gives is checked at each call.
class PythonController final : public Controller {
 public:
  explicit PythonController(double period);

  void reset() noexcept override;
  [[nodiscard]] Status update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                              VectorRef command) noexcept override;
  [[nodiscard]] double period() const noexcept override { return period_; }
  [[nodiscard]] Index num_coordinates() const noexcept override { return any_size; }
  [[nodiscard]] Index num_cables() const noexcept override { return any_size; }

  /// After a run: throws what its methods have thrown.
  void rethrow();

 private:
  template <class Function>
  Status guarded(Function&& function) noexcept;

  double period_;
  std::exception_ptr exception_;
};

}  // namespace cdcr::python
