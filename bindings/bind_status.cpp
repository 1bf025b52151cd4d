#include <pybind11/native_enum.h>

#include "bind.hpp"
#include "cdcr/status.hpp"

namespace cdcr::python {

void bind_status(pybind11::module_& m) {
  namespace py = pybind11;
  py::native_enum<Status> status(m, "Status", "enum.Enum",
                                 "How a computation ended; anything but ok is a failure.");
  for (int i = 0; i <= static_cast<int>(Status::interrupted); ++i) {
    status.value(name(static_cast<Status>(i)), static_cast<Status>(i));
  }
  status.finalize();
  m.def(
      "status_message", [](Status s) { return message(s); }, py::arg("status"),
      "What happened and what to try next; empty for ok.");
}

}  // namespace cdcr::python
