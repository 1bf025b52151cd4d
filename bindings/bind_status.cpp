#include <pybind11/native_enum.h>

#include "bind.hpp"
#include "cdcr/status.hpp"
#include "docs.hpp"

namespace cdcr::python {

void bind_status(pybind11::module_& m) {
  namespace py = pybind11;
  py::native_enum<Status> status(m, "Status", "enum.Enum",
                                 "How a computation ended; anything but ok is a failure.");
  for (int i = 0; i <= static_cast<int>(Status::compression_limit); ++i) {
    status.value(name(static_cast<Status>(i)), static_cast<Status>(i));
  }
  status.finalize();
  m.def(
      "status_message", [](Status s) { return message(s); }, py::arg("status"),
      Doc("What happened and what to try next, in one sentence.",
          {"status : Status\n    How a computation ended.\n"}, "str\n    Empty for ok."));
}

}  // namespace cdcr::python
