#pragma once

#include "cdcr/controller.hpp"

namespace cdcr::python {

/// Keeps a controller, which has a state, from driving two runs at once, and from being changed
/// while one asks it in another thread. All of it with Python's lock held.
class Driving {
 public:
  /// For as long as it lives; `loop` is who will go on with the controller, null where a run ends.
  explicit Driving(const Controller& controller, const void* loop = nullptr);
  Driving(const Driving&) = delete;
  Driving& operator=(const Driving&) = delete;
  ~Driving();

  /// Throws where a run asks it at this moment.
  static void refuse_during_run(const Controller& controller);
  /// Throws where another than this loop has driven it since.
  static void require_last(const Controller& controller, const void* loop);
  /// The loop goes.
  static void forget(const Controller& controller, const void* loop);

 private:
  const Controller* controller_;
};

}  // namespace cdcr::python
