#include "gil.hpp"

#include <unistd.h>

#include <utility>

namespace cdcr::python {
namespace {

namespace py = pybind11;

/// Of this thread, while it is unlocked.
PyThreadState*& released() {
  thread_local PyThreadState* state = nullptr;
  return state;
}

/// Waits for the end of the process.
[[noreturn]] void stay() {
  for (;;) pause();
}

bool python_ends() {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

/// The thread's state is its own, and may be a dangling pointer when Python has ended, of which
/// PyEval_RestoreThread knows.
void lock(PyThreadState* state) noexcept {
  if (python_ends()) stay();
  try {
    PyEval_RestoreThread(state);
  } catch (...) {  // pthread_exit
    stay();
  }
}

}  // namespace

Unlocked::Unlocked() : before_(std::exchange(released(), PyEval_SaveThread())) {}

Unlocked::~Unlocked() {
  lock(std::exchange(released(), before_));
}

Locked::Locked() : state_(std::exchange(released(), nullptr)) {
  if (state_ != nullptr) lock(state_);
}

Locked::~Locked() {
  if (state_ != nullptr) released() = PyEval_SaveThread();
}

py::object call(const py::object& function, const py::tuple& args) {
  // pthread_exit strikes in Python's code too, wherever it would take the lock again: nothing may
  // stand between here and there whose destructor touches Python.
  PyObject* value = nullptr;
  try {
    value = PyObject_Call(function.ptr(), args.ptr(), nullptr);
  } catch (...) {
    stay();
  }
  if (value == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(value);
}

bool Interruption::operator()() {
  const auto now = std::chrono::steady_clock::now();
  if (found_ || now < next_) return found_;
  next_ = now + pause_;
  const Locked locked;
  found_ = PyErr_CheckSignals() != 0;
  return found_;
}

void Interruption::raise() const {
  if (found_) throw py::error_already_set();
}

void Interruption::forgive(bool told) const {
  if (!found_) return;
  if (!told || PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) {
    throw py::error_already_set();
  }
  PyErr_Clear();
}

}  // namespace cdcr::python
