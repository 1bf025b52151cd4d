#include "driving.hpp"

#include <pybind11/pybind11.h>

#include <map>
#include <string>

namespace cdcr::python {
namespace {

struct Use {
  bool now = false;
  const void* loop = nullptr;  // that used it last, and keeps it alive
};

/// Those that a run or a loop uses.
std::map<const void*, Use>& uses() {
  static std::map<const void*, Use> all;
  return all;
}

bool is_in_use(const void* one) {
  const auto found = uses().find(one);
  return found != uses().end() && found->second.now;
}

void require_free(const void* one, const std::string& what) {
  if (!is_in_use(one)) return;
  throw pybind11::value_error("the " + what + " another run at this moment: make one for each run");
}

void require_last_of(const void* one, const std::string& what, const void* loop) {
  const auto found = uses().find(one);
  if (found != uses().end() && (found->second.now || found->second.loop == loop)) return;
  throw pybind11::value_error("the " + what +
                              " another run since this loop was reset: reset the loop, or make one "
                              "for each");
}

}  // namespace

Driving::Driving(const Controller& controller, const void* loop, const Estimator* estimator)
    : used_{&controller, estimator} {
  require_free(&controller, "controller drives");
  if (estimator != nullptr) require_free(estimator, "estimator serves");
  for (const void* one : used_) {
    if (one != nullptr) uses()[one] = {true, loop};
  }
}

Driving::~Driving() {
  for (const void* one : used_) {
    const auto found = uses().find(one);
    if (found == uses().end()) continue;
    found->second.now = false;
    if (found->second.loop == nullptr) uses().erase(found);
  }
}

void Driving::refuse_during_run(const Controller& controller) {
  if (!is_in_use(&controller)) return;
  throw pybind11::value_error(
      "the controller drives a run at this moment: what it follows is set before, as a path");
}

void Driving::require_last(const Controller& controller, const Estimator* estimator,
                           const void* loop) {
  require_last_of(&controller, "controller has driven", loop);
  if (estimator != nullptr) require_last_of(estimator, "estimator has served", loop);
}

void Driving::forget(const Controller& controller, const Estimator* estimator, const void* loop) {
  for (const void* one :
       {static_cast<const void*>(&controller), static_cast<const void*>(estimator)}) {
    const auto found = uses().find(one);
    if (found != uses().end() && found->second.loop == loop) uses().erase(found);
  }
}

}  // namespace cdcr::python
