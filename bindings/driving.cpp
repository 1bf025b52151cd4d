#include "driving.hpp"

#include <pybind11/pybind11.h>

#include <map>

namespace cdcr::python {
namespace {

struct Use {
  bool now = false;
  const void* loop = nullptr;  // that drove it last; it keeps the controller alive
};

/// Those that a run or a loop uses.
std::map<const Controller*, Use>& uses() {
  static std::map<const Controller*, Use> all;
  return all;
}

}  // namespace

Driving::Driving(const Controller& controller, const void* loop) : controller_(&controller) {
  Use& use = uses()[controller_];
  if (use.now) {
    throw pybind11::value_error(
        "the controller drives another run at this moment: make one for each run");
  }
  use = {true, loop};
}

Driving::~Driving() {
  const auto found = uses().find(controller_);
  found->second.now = false;
  if (found->second.loop == nullptr) uses().erase(found);
}

void Driving::refuse_during_run(const Controller& controller) {
  const auto found = uses().find(&controller);
  if (found == uses().end() || !found->second.now) return;
  throw pybind11::value_error(
      "the controller drives a run at this moment: what it follows is set before, as a path");
}

void Driving::require_last(const Controller& controller, const void* loop) {
  const auto found = uses().find(&controller);
  if (found != uses().end() && (found->second.now || found->second.loop == loop)) return;
  throw pybind11::value_error(
      "the controller has driven another run since this loop was reset: reset the loop, or make a "
      "controller for each");
}

void Driving::forget(const Controller& controller, const void* loop) {
  const auto found = uses().find(&controller);
  if (found != uses().end() && found->second.loop == loop) uses().erase(found);
}

}  // namespace cdcr::python
