#pragma once

#include <pybind11/pybind11.h>

#include <chrono>

// Python's lock (GIL) in threads that may outlive the interpreter: a daemon thread that asks for
// the lock while Python ends gets pthread_exit, which no C++ destructor may let through. It stays
// where it is instead, until the process ends; so does Python itself from 3.14 on.

namespace cdcr::python {

/// For as long as it lives, other threads may run Python.
class Unlocked {
 public:
  Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked();

 private:
  PyThreadState* before_;
};

/// For as long as it lives, this thread may call Python again, where it was unlocked.
class Locked {
 public:
  Locked();
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  ~Locked();

 private:
  PyThreadState* state_;
};

/// Calls what the user gave, with the lock held.
[[nodiscard]] pybind11::object call(const pybind11::object& function, const pybind11::tuple& args);

/// Asked now and then by what takes long: whether to end it, as Ctrl-C does. Looks but now and then
/// itself, since the lock may be in other hands. Who ends for it calls `raise`, with the lock held.
class Interruption {
 public:
  [[nodiscard]] bool operator()();
  /// Raises what the handler of a signal raised.
  void raise() const;
  /// In its place where what is done is handed back: Ctrl-C is forgotten where the answer tells of
  /// it, as one does not that was done by then; what else a handler raised is raised.
  void forgive(bool told) const;

 private:
  static constexpr std::chrono::milliseconds pause_{50};
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + pause_;
  bool found_ = false;
};

}  // namespace cdcr::python
