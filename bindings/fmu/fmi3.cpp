// FMI 3.0, co-simulation. Functions of what this FMU does not have log a sentence and return
// fmi3Error, as the standard asks for.

#include <cstring>
#include <exception>
#include <string>

#include "fmi3Functions.h"
#include "instance.hpp"
#include "saved_state.hpp"

namespace {

using cdcr::fmu::given;
using cdcr::fmu::Instance;
using cdcr::fmu::need;

struct Logger {
  fmi3InstanceEnvironment environment = nullptr;
  fmi3LogMessageCallback callback = nullptr;

  void error(const std::string& sentence) const {
    if (callback) callback(environment, fmi3Error, "logStatusError", sentence.c_str());
  }
};

struct Component {
  Instance instance;
  Logger logger;
};

/// Calls f(Instance&); what it throws is logged.
template <typename F>
fmi3Status guarded(fmi3Instance handle, const char* function, F&& f) {
  auto* component = static_cast<Component*>(handle);
  if (!component) return fmi3Error;
  try {
    f(component->instance);
    return fmi3OK;
  } catch (const std::exception& error) {
    component->logger.error(std::string(function) + ": " + error.what());
    return fmi3Error;
  }
}

fmi3Status refuse(fmi3Instance handle, const char* function, const char* sentence) {
  return guarded(handle, function, [&](Instance&) { need(false, sentence); });
}

/// Of a type of which there are no variables: nothing is all that can be got or set.
fmi3Status no_variables(fmi3Instance handle, const char* function, size_t count) {
  if (count == 0) return fmi3OK;
  return refuse(handle, function, "all variables of this FMU are of type Float64");
}

constexpr const char* same_counts = "there must be as many values as value references";
constexpr const char* co_simulation_only = "this FMU is for co-simulation alone";
constexpr const char* no_event_mode = "this FMU has no event mode";
constexpr const char* no_clocks = "this FMU has no clocks";
constexpr const char* no_configuration = "this FMU has no structural parameters";
constexpr const char* no_dependencies =
    "this FMU has no array variables; modelDescription.xml tells all dependencies";

}  // namespace

#define UNSUPPORTED(function, parameters, sentence) \
  fmi3Status function parameters {                  \
    return refuse(instance, #function, sentence);   \
  }
#define NO_VARIABLES(type)                                                                 \
  fmi3Status fmi3Get##type(fmi3Instance instance, const fmi3ValueReference*, size_t count, \
                           fmi3##type*, size_t) {                                          \
    return no_variables(instance, "fmi3Get" #type, count);                                 \
  }                                                                                        \
  fmi3Status fmi3Set##type(fmi3Instance instance, const fmi3ValueReference*, size_t count, \
                           const fmi3##type*, size_t) {                                    \
    return no_variables(instance, "fmi3Set" #type, count);                                 \
  }

const char* fmi3GetVersion() {
  return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean, size_t count,
                               const fmi3String categories[]) {
  return guarded(instance, "fmi3SetDebugLogging", [&](Instance&) {  // errors are logged always
    for (size_t i = 0; i < count; ++i) {
      need(std::strcmp(categories[i], "logStatusError") == 0,
           "the one category of messages is logStatusError");
    }
  });
}

// Instances -------------------------------------------------------------------------------------

fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String token, fmi3String resources,
                                         fmi3Boolean, fmi3Boolean, fmi3Boolean event_mode,
                                         fmi3Boolean, const fmi3ValueReference[],
                                         size_t num_intermediate,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback callback,
                                         fmi3IntermediateUpdateCallback) {
  const Logger logger{environment, callback};
  try {
    need(!event_mode, no_event_mode);
    need(num_intermediate == 0, "this FMU has no intermediate updates");
    return new Component{Instance(given(resources), given(token)), logger};
  } catch (const std::exception& error) {
    logger.error(std::string("fmi3InstantiateCoSimulation: ") + error.what());
    return nullptr;
  }
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback callback) {
  Logger{environment, callback}.error(std::string("fmi3InstantiateModelExchange: ") +
                                      co_simulation_only);
  return nullptr;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback callback,
                                               fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  Logger{environment, callback}.error(std::string("fmi3InstantiateScheduledExecution: ") +
                                      co_simulation_only);
  return nullptr;
}

void fmi3FreeInstance(fmi3Instance instance) {
  delete static_cast<Component*>(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64,
                                       fmi3Float64 start, fmi3Boolean stop_defined,
                                       fmi3Float64 stop) {
  return guarded(instance, "fmi3EnterInitializationMode", [&](Instance& robot) {
    robot.enter_initialization(start, stop_defined ? stop : Instance::infinite);
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return guarded(instance, "fmi3ExitInitializationMode",
                 [](Instance& robot) { robot.exit_initialization(); });
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return guarded(instance, "fmi3Terminate", [](Instance& robot) { robot.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return guarded(instance, "fmi3Reset", [](Instance& robot) { robot.reset(); });
}

// Variables -------------------------------------------------------------------------------------

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          size_t count, fmi3Float64 values[], size_t num_values) {
  return guarded(instance, "fmi3GetFloat64", [&](Instance& robot) {
    need(num_values == count, same_counts);
    robot.get(references, count, values);
  });
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          size_t count, const fmi3Float64 values[], size_t num_values) {
  return guarded(instance, "fmi3SetFloat64", [&](Instance& robot) {
    need(num_values == count, same_counts);
    robot.set(references, count, values);
  });
}

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(Int32)
NO_VARIABLES(UInt32)
NO_VARIABLES(Int64)
NO_VARIABLES(UInt64)
NO_VARIABLES(Boolean)
NO_VARIABLES(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference[], size_t count, size_t[],
                         fmi3Binary[], size_t) {
  return no_variables(instance, "fmi3GetBinary", count);
}
fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference[], size_t count,
                         const size_t[], const fmi3Binary[], size_t) {
  return no_variables(instance, "fmi3SetBinary", count);
}
fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference[], size_t count,
                        fmi3Clock[]) {
  return no_variables(instance, "fmi3GetClock", count);
}
fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference[], size_t count,
                        const fmi3Clock[]) {
  return no_variables(instance, "fmi3SetClock", count);
}

UNSUPPORTED(fmi3GetNumberOfVariableDependencies,
            (fmi3Instance instance, fmi3ValueReference, size_t*), no_dependencies)
UNSUPPORTED(fmi3GetVariableDependencies,
            (fmi3Instance instance, fmi3ValueReference, size_t[], fmi3ValueReference[], size_t[],
             fmi3DependencyKind[], size_t),
            no_dependencies)

// State -----------------------------------------------------------------------------------------

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return guarded(instance, "fmi3GetFMUState", [&](Instance& robot) { save_state(robot, state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return guarded(instance, "fmi3SetFMUState",
                 [&](Instance& robot) { restore_state(robot, state); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return guarded(instance, "fmi3FreeFMUState", [&](Instance&) { cdcr::fmu::free_state(state); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState, size_t* size) {
  return guarded(instance, "fmi3SerializedFMUStateSize",
                 [&](Instance& robot) { *size = serialized_size(robot); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size) {
  return guarded(instance, "fmi3SerializeFMUState",
                 [&](Instance&) { cdcr::fmu::serialize_state(state, bytes, size); });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState* state) {
  return guarded(instance, "fmi3DeserializeFMUState",
                 [&](Instance& robot) { deserialize_state(robot, bytes, size, state); });
}

// Derivatives -----------------------------------------------------------------------------------

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t num_unknowns, const fmi3ValueReference knowns[],
                                        size_t num_knowns, const fmi3Float64 seed[],
                                        size_t num_seed, fmi3Float64 sensitivity[],
                                        size_t num_sensitivity) {
  return guarded(instance, "fmi3GetDirectionalDerivative", [&](Instance& robot) {
    need(num_seed == num_knowns && num_sensitivity == num_unknowns, same_counts);
    robot.derivative(unknowns, num_unknowns, knowns, num_knowns, seed, sensitivity);
  });
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t num_unknowns, const fmi3ValueReference knowns[],
                                    size_t num_knowns, const fmi3Float64 seed[], size_t num_seed,
                                    fmi3Float64 sensitivity[], size_t num_sensitivity) {
  return guarded(instance, "fmi3GetAdjointDerivative", [&](Instance& robot) {
    need(num_seed == num_unknowns && num_sensitivity == num_knowns, same_counts);
    robot.derivative(unknowns, num_unknowns, knowns, num_knowns, seed, sensitivity, true);
  });
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference references[],
                                    size_t count, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t num_values) {
  return guarded(instance, "fmi3GetOutputDerivatives", [&](Instance& robot) {
    need(num_values == count, same_counts);
    robot.output_derivatives(references, count, orders, values);
  });
}

// Time ------------------------------------------------------------------------------------------

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 step, fmi3Boolean,
                      fmi3Boolean* event_handling_needed, fmi3Boolean* terminate_simulation,
                      fmi3Boolean* early_return, fmi3Float64* last_successful_time) {
  return guarded(instance, "fmi3DoStep", [&](Instance& robot) {
    *event_handling_needed = *terminate_simulation = *early_return = fmi3False;
    *last_successful_time = robot.time();
    robot.step(time, step);
    *last_successful_time = robot.time();
  });
}

// What a co-simulation without events and clocks has not
// -------------------------------------------

UNSUPPORTED(fmi3EnterEventMode, (fmi3Instance instance), no_event_mode)
UNSUPPORTED(fmi3EnterStepMode, (fmi3Instance instance), no_event_mode)
UNSUPPORTED(fmi3EvaluateDiscreteStates, (fmi3Instance instance), no_event_mode)
UNSUPPORTED(fmi3UpdateDiscreteStates,
            (fmi3Instance instance, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
             fmi3Boolean*, fmi3Float64*),
            no_event_mode)
UNSUPPORTED(fmi3EnterConfigurationMode, (fmi3Instance instance), no_configuration)
UNSUPPORTED(fmi3ExitConfigurationMode, (fmi3Instance instance), no_configuration)
UNSUPPORTED(fmi3GetIntervalDecimal,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, fmi3Float64[],
             fmi3IntervalQualifier[]),
            no_clocks)
UNSUPPORTED(fmi3GetIntervalFraction,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[],
             fmi3IntervalQualifier[]),
            no_clocks)
UNSUPPORTED(fmi3GetShiftDecimal,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, fmi3Float64[]), no_clocks)
UNSUPPORTED(fmi3GetShiftFraction,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[]),
            no_clocks)
UNSUPPORTED(fmi3SetIntervalDecimal,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, const fmi3Float64[]),
            no_clocks)
UNSUPPORTED(fmi3SetIntervalFraction,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, const fmi3UInt64[],
             const fmi3UInt64[]),
            no_clocks)
UNSUPPORTED(fmi3SetShiftDecimal,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, const fmi3Float64[]),
            no_clocks)
UNSUPPORTED(fmi3SetShiftFraction,
            (fmi3Instance instance, const fmi3ValueReference[], size_t, const fmi3UInt64[],
             const fmi3UInt64[]),
            no_clocks)
UNSUPPORTED(fmi3ActivateModelPartition, (fmi3Instance instance, fmi3ValueReference, fmi3Float64),
            co_simulation_only)
UNSUPPORTED(fmi3EnterContinuousTimeMode, (fmi3Instance instance), co_simulation_only)
UNSUPPORTED(fmi3CompletedIntegratorStep,
            (fmi3Instance instance, fmi3Boolean, fmi3Boolean*, fmi3Boolean*), co_simulation_only)
UNSUPPORTED(fmi3SetTime, (fmi3Instance instance, fmi3Float64), co_simulation_only)
UNSUPPORTED(fmi3SetContinuousStates, (fmi3Instance instance, const fmi3Float64[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi3GetContinuousStateDerivatives, (fmi3Instance instance, fmi3Float64[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi3GetEventIndicators, (fmi3Instance instance, fmi3Float64[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi3GetContinuousStates, (fmi3Instance instance, fmi3Float64[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi3GetNominalsOfContinuousStates, (fmi3Instance instance, fmi3Float64[], size_t),
            co_simulation_only)
UNSUPPORTED(fmi3GetNumberOfEventIndicators, (fmi3Instance instance, size_t*), co_simulation_only)
UNSUPPORTED(fmi3GetNumberOfContinuousStates, (fmi3Instance instance, size_t*), co_simulation_only)
