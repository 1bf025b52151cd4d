#pragma once

#include "integration/sundials_handles.hpp"

namespace cdcr::detail {

/// What SUNDIALS gets in place of a clone that there is no memory for: N_VClone and SUNMatClone
/// write to what they were given without a look at it. `used` tells, and the call has failed.
class Spare {
 public:
  /// Takes a vector and a matrix as large as those cloned.
  Spare(Owner<N_Vector> vector, Owner<SUNMatrix> matrix) noexcept
      : vector_(std::move(vector)), matrix_(std::move(matrix)) {
    // SUNDIALS destroys its clones, the spare ones too.
    destroy_vector_ = std::exchange(vector_->ops->nvdestroy, [](N_Vector) {});
    destroy_matrix_ = std::exchange(matrix_->ops->destroy, [](SUNMatrix) {});
  }
  Spare(const Spare&) = delete;
  Spare& operator=(const Spare&) = delete;
  ~Spare() {
    vector_->ops->nvdestroy = destroy_vector_;
    matrix_->ops->destroy = destroy_matrix_;
  }

  /// For as long as it lives, clones of this thread may take the spare ones.
  class Use {
   public:
    explicit Use(Spare& spare) noexcept : before_(std::exchange(in_use, &spare)) {}
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use() { in_use = before_; }

   private:
    Spare* before_;
  };

  [[nodiscard]] bool used() const noexcept { return used_; }

  /// Lets clones of these, and clones of clones, take the spare ones.
  static void serve(N_Vector vector, SUNMatrix matrix) noexcept {
    vector->ops->nvclone = clone_vector;
    matrix->ops->clone = clone_matrix;
  }

 private:
  static N_Vector clone_vector(N_Vector v) noexcept {
    const N_Vector clone = N_VClone_Serial(v);
    return clone != nullptr || in_use == nullptr ? clone : in_use->take(in_use->vector_.get());
  }
  static SUNMatrix clone_matrix(SUNMatrix m) noexcept {
    const SUNMatrix clone = SUNMatClone_Dense(m);
    return clone != nullptr || in_use == nullptr ? clone : in_use->take(in_use->matrix_.get());
  }
  template <class Handle>
  Handle take(Handle handle) noexcept {
    used_ = true;
    return handle;
  }

  inline static thread_local Spare* in_use = nullptr;
  Owner<N_Vector> vector_;
  Owner<SUNMatrix> matrix_;
  void (*destroy_vector_)(N_Vector);
  void (*destroy_matrix_)(SUNMatrix);
  bool used_ = false;
};

}  // namespace cdcr::detail
