#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <set>
#include <utility>

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

/// Keeps a controller, which has a state, from driving two runs at once.
class Driving {
 public:
  explicit Driving(const Controller& controller) : controller_(&controller) {
    if (all().insert(controller_).second) return;
    throw pybind11::value_error(
        "the controller drives another run at this moment: make one for each run");
  }
  Driving(const Driving&) = delete;
  Driving& operator=(const Driving&) = delete;
  ~Driving() { all().erase(controller_); }

 private:
  static std::set<const Controller*>& all() {  // Python's lock guards it
    static std::set<const Controller*> controllers;
    return controllers;
  }
  const Controller* controller_;
};

}  // namespace cdcr::python
