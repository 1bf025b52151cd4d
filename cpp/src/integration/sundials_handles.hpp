#pragma once

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <type_traits>
#include <utility>

namespace cdcr::detail {

/// Frees any SUNDIALS object in its own way.
struct Free {
  void operator()(SUNContext context) const noexcept { SUNContext_Free(&context); }
  void operator()(N_Vector vector) const noexcept { N_VDestroy(vector); }
  void operator()(SUNMatrix matrix) const noexcept { SUNMatDestroy(matrix); }
  void operator()(SUNLinearSolver solver) const noexcept { SUNLinSolFree(solver); }
  void operator()(void* cvode) const noexcept { CVodeFree(&cvode); }
};

/// Owner of a SUNDIALS object, given its handle type. A context must outlive what is made with
/// it: declare it first.
template <typename Handle>
using Owner = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

// Where SUNDIALS 6 and 7 differ.

inline int create(SUNContext* context) noexcept {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context);
#else
  return SUNContext_Create(nullptr, context);
#endif
}

/// Keeps SUNDIALS from writing to stderr what codes say as well.
inline int silence([[maybe_unused]] SUNContext context, [[maybe_unused]] void* cvode) noexcept {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_ClearErrHandlers(context);
#else
  const auto silent = [](int, const char*, const char*, char*, void*) {};
  return CVodeSetErrHandlerFn(cvode, silent, nullptr);
#endif
}

}  // namespace cdcr::detail
