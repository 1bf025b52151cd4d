// FMI 2.0, co-simulation. Functions of what this FMU does not have log a sentence and return
// fmi2Error, as the standard asks for.

#include <cstring>
#include <exception>
#include <string>

#include "fmi2Functions.h"
#include "instance.hpp"
#include "saved_state.hpp"

namespace {

using cdcr::fmu::given;
using cdcr::fmu::Instance;
using cdcr::fmu::need;

struct Logger {
  fmi2CallbackLogger callback = nullptr;
  fmi2ComponentEnvironment environment = nullptr;
  std::string instance;

  void error(const std::string& sentence) const {
    if (!callback) return;
    std::string format;  // the message is a format: a percent sign is written twice
    for (const char c : sentence) format += c == '%' ? std::string("%%") : std::string(1, c);
    callback(environment, instance.c_str(), fmi2Error, "logStatusError", format.c_str());
  }
};

struct Component {
  Instance instance;
  Logger logger;
  double start = 0.0, stop = Instance::infinite;
};

/// Calls f(Component&); what it throws is logged.
template <typename F>
fmi2Status guarded(fmi2Component handle, const char* function, F&& f) {
  auto* component = static_cast<Component*>(handle);
  if (!component) return fmi2Error;
  try {
    f(*component);
    return fmi2OK;
  } catch (const std::exception& error) {
    component->logger.error(std::string(function) + ": " + error.what());
    return fmi2Error;
  }
}

fmi2Status refuse(fmi2Component handle, const char* function, const char* sentence) {
  return guarded(handle, function, [&](Component&) { need(false, sentence); });
}

/// Of a type of which there are no variables: nothing is all that can be got or set.
fmi2Status no_variables(fmi2Component handle, const char* function, size_t count) {
  if (count == 0) return fmi2OK;
  return refuse(handle, function, "all variables of this FMU are of type Real");
}

/// "file:///a/b%20c" is /a/b c.
std::string path_of(const std::string& location) {
  std::string rest = location;
  if (rest.rfind("file:", 0) == 0) {
    rest.erase(0, 5);
    if (rest.rfind("//", 0) == 0) rest.erase(0, rest.find('/', 2));  // and the host
  }
  std::string path;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const bool escape = rest[i] == '%' && i + 2 < rest.size();
    path += escape ? static_cast<char>(std::stoi(rest.substr(i + 1, 2), nullptr, 16)) : rest[i];
    if (escape) i += 2;
  }
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

constexpr const char* co_simulation_only = "this FMU is for co-simulation alone";
constexpr const char* no_pending = "steps of this FMU end before fmi2DoStep returns";

}  // namespace

#define UNSUPPORTED(function, parameters, sentence) \
  fmi2Status function parameters {                  \
    return refuse(instance, #function, sentence);   \
  }
#define NO_VARIABLES(type)                                                                  \
  fmi2Status fmi2Get##type(fmi2Component instance, const fmi2ValueReference*, size_t count, \
                           fmi2##type*) {                                                   \
    return no_variables(instance, "fmi2Get" #type, count);                                  \
  }                                                                                         \
  fmi2Status fmi2Set##type(fmi2Component instance, const fmi2ValueReference*, size_t count, \
                           const fmi2##type*) {                                             \
    return no_variables(instance, "fmi2Set" #type, count);                                  \
  }

const char* fmi2GetTypesPlatform() {
  return fmi2TypesPlatform;
}
const char* fmi2GetVersion() {
  return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component instance, fmi2Boolean, size_t count,
                               const fmi2String categories[]) {
  return guarded(instance, "fmi2SetDebugLogging", [&](Component&) {  // errors are logged always
    for (size_t i = 0; i < count; ++i) {
      need(std::strcmp(categories[i], "logStatusError") == 0,
           "the one category of messages is logStatusError");
    }
  });
}

// Instances -------------------------------------------------------------------------------------

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String token,
                              fmi2String resources, const fmi2CallbackFunctions* callbacks,
                              fmi2Boolean, fmi2Boolean) {
  Logger logger;
  if (callbacks) logger = {callbacks->logger, callbacks->componentEnvironment, given(name)};
  try {
    need(type == fmi2CoSimulation, co_simulation_only);
    return new Component{Instance(path_of(given(resources)), given(token)), logger};
  } catch (const std::exception& error) {
    logger.error(std::string("fmi2Instantiate: ") + error.what());
    return nullptr;
  }
}

void fmi2FreeInstance(fmi2Component instance) {
  delete static_cast<Component*>(instance);
}

fmi2Status fmi2SetupExperiment(fmi2Component instance, fmi2Boolean, fmi2Real, fmi2Real start,
                               fmi2Boolean stop_defined, fmi2Real stop) {
  return guarded(instance, "fmi2SetupExperiment", [&](Component& component) {
    component.start = start;
    component.stop = stop_defined ? stop : Instance::infinite;
  });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component instance) {
  return guarded(instance, "fmi2EnterInitializationMode", [](Component& component) {
    component.instance.enter_initialization(component.start, component.stop);
  });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component instance) {
  return guarded(instance, "fmi2ExitInitializationMode",
                 [](Component& component) { component.instance.exit_initialization(); });
}

fmi2Status fmi2Terminate(fmi2Component instance) {
  return guarded(instance, "fmi2Terminate",
                 [](Component& component) { component.instance.terminate(); });
}

fmi2Status fmi2Reset(fmi2Component instance) {
  return guarded(instance, "fmi2Reset", [](Component& component) {
    component.instance.reset();
    component.start = 0.0;
    component.stop = Instance::infinite;
  });
}

// Variables -------------------------------------------------------------------------------------

fmi2Status fmi2GetReal(fmi2Component instance, const fmi2ValueReference references[], size_t count,
                       fmi2Real values[]) {
  return guarded(instance, "fmi2GetReal",
                 [&](Component& component) { component.instance.get(references, count, values); });
}

fmi2Status fmi2SetReal(fmi2Component instance, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[]) {
  return guarded(instance, "fmi2SetReal",
                 [&](Component& component) { component.instance.set(references, count, values); });
}

NO_VARIABLES(Integer)
NO_VARIABLES(Boolean)
NO_VARIABLES(String)

// State -----------------------------------------------------------------------------------------

fmi2Status fmi2GetFMUstate(fmi2Component instance, fmi2FMUstate* state) {
  return guarded(instance, "fmi2GetFMUstate",
                 [&](Component& component) { save_state(component.instance, state); });
}

fmi2Status fmi2SetFMUstate(fmi2Component instance, fmi2FMUstate state) {
  return guarded(instance, "fmi2SetFMUstate",
                 [&](Component& component) { restore_state(component.instance, state); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component instance, fmi2FMUstate* state) {
  return guarded(instance, "fmi2FreeFMUstate", [&](Component&) { cdcr::fmu::free_state(state); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component instance, fmi2FMUstate, size_t* size) {
  return guarded(instance, "fmi2SerializedFMUstateSize",
                 [&](Component& component) { *size = serialized_size(component.instance); });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component instance, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size) {
  return guarded(instance, "fmi2SerializeFMUstate",
                 [&](Component&) { cdcr::fmu::serialize_state(state, bytes, size); });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component instance, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate* state) {
  return guarded(instance, "fmi2DeSerializeFMUstate", [&](Component& component) {
    deserialize_state(component.instance, bytes, size, state);
  });
}

// Derivatives -----------------------------------------------------------------------------------

fmi2Status fmi2GetDirectionalDerivative(fmi2Component instance, const fmi2ValueReference unknowns[],
                                        size_t num_unknowns, const fmi2ValueReference knowns[],
                                        size_t num_knowns, const fmi2Real seed[],
                                        fmi2Real sensitivity[]) {
  return guarded(instance, "fmi2GetDirectionalDerivative", [&](Component& component) {
    component.instance.derivative(unknowns, num_unknowns, knowns, num_knowns, seed, sensitivity);
  });
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component instance,
                                        const fmi2ValueReference references[], size_t count,
                                        const fmi2Integer orders[], fmi2Real values[]) {
  return guarded(instance, "fmi2GetRealOutputDerivatives", [&](Component& component) {
    component.instance.output_derivatives(references, count, orders, values);
  });
}

UNSUPPORTED(fmi2SetRealInputDerivatives,
            (fmi2Component instance, const fmi2ValueReference[], size_t, const fmi2Integer[],
             const fmi2Real[]),
            "inputs are held over a step")

// Time ------------------------------------------------------------------------------------------

fmi2Status fmi2DoStep(fmi2Component instance, fmi2Real time, fmi2Real step, fmi2Boolean) {
  return guarded(instance, "fmi2DoStep",
                 [&](Component& component) { component.instance.step(time, step); });
}

UNSUPPORTED(fmi2CancelStep, (fmi2Component instance), no_pending)
UNSUPPORTED(fmi2GetStatus, (fmi2Component instance, const fmi2StatusKind, fmi2Status*), no_pending)
UNSUPPORTED(fmi2GetIntegerStatus, (fmi2Component instance, const fmi2StatusKind, fmi2Integer*),
            no_pending)
UNSUPPORTED(fmi2GetStringStatus, (fmi2Component instance, const fmi2StatusKind, fmi2String*),
            no_pending)

fmi2Status fmi2GetRealStatus(fmi2Component instance, const fmi2StatusKind kind, fmi2Real* value) {
  return guarded(instance, "fmi2GetRealStatus", [&](Component& component) {
    need(kind == fmi2LastSuccessfulTime, no_pending);
    *value = component.instance.time();
  });
}

fmi2Status fmi2GetBooleanStatus(fmi2Component instance, const fmi2StatusKind kind,
                                fmi2Boolean* value) {
  return guarded(instance, "fmi2GetBooleanStatus", [&](Component&) {
    need(kind == fmi2Terminated, no_pending);
    *value = fmi2False;  // this FMU never asks for the end
  });
}

// Model exchange ----------------------------------------------------------------------------------

UNSUPPORTED(fmi2EnterEventMode, (fmi2Component instance), co_simulation_only)
UNSUPPORTED(fmi2NewDiscreteStates, (fmi2Component instance, fmi2EventInfo*), co_simulation_only)
UNSUPPORTED(fmi2EnterContinuousTimeMode, (fmi2Component instance), co_simulation_only)
UNSUPPORTED(fmi2CompletedIntegratorStep,
            (fmi2Component instance, fmi2Boolean, fmi2Boolean*, fmi2Boolean*), co_simulation_only)
UNSUPPORTED(fmi2SetTime, (fmi2Component instance, fmi2Real), co_simulation_only)
UNSUPPORTED(fmi2SetContinuousStates, (fmi2Component instance, const fmi2Real[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi2GetDerivatives, (fmi2Component instance, fmi2Real[], size_t), co_simulation_only)
UNSUPPORTED(fmi2GetEventIndicators, (fmi2Component instance, fmi2Real[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi2GetContinuousStates, (fmi2Component instance, fmi2Real[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi2GetNominalsOfContinuousStates, (fmi2Component instance, fmi2Real[], size_t),
            co_simulation_only)
