#pragma once

#include <array>

#include "cdcr/controller.hpp"
#include "cdcr/estimator.hpp"

namespace cdcr::python {

/// Keeps a controller and an estimator, which have a state, from serving two runs at once, and the
/// controller from being changed while one asks it in another thread. All of it with Python's lock
/// held.
class Driving {
 public:
  /// For as long as it lives; `loop` is who will go on with them, null where a run ends.
  explicit Driving(const Controller& controller, const void* loop = nullptr,
                   const Estimator* estimator = nullptr);
  Driving(const Driving&) = delete;
  Driving& operator=(const Driving&) = delete;
  ~Driving();

  /// Throws where a run asks it at this moment.
  static void refuse_during_run(const Controller& controller);
  /// Throws where another than this loop has driven one of them since.
  static void require_last(const Controller& controller, const Estimator* estimator,
                           const void* loop);
  /// The loop goes.
  static void forget(const Controller& controller, const Estimator* estimator, const void* loop);

 private:
  std::array<const void*, 2> used_;  // the second may be null
};

}  // namespace cdcr::python
