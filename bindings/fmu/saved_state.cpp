#include "saved_state.hpp"

#include <cstring>
#include <memory>
#include <stdexcept>

namespace cdcr::fmu {
namespace {

const VectorXd& vector_in(const void* state) {
  if (!state) throw std::invalid_argument("there is no state");
  return *static_cast<const VectorXd*>(state);
}

}  // namespace

void save_state(const Instance& instance, void** state) {
  if (*state) {
    *static_cast<VectorXd*>(*state) = instance.save();
  } else {
    *state = new VectorXd(instance.save());
  }
}

void restore_state(Instance& instance, const void* state) {
  instance.restore(vector_in(state));
}

void free_state(void** state) noexcept {
  if (!state) return;
  delete static_cast<VectorXd*>(*state);
  *state = nullptr;
}

std::size_t serialized_size(const Instance& instance) noexcept {
  return static_cast<std::size_t>(instance.saved_size()) * sizeof(double);
}

void serialize_state(const void* state, void* bytes, std::size_t size) {
  const VectorXd& saved = vector_in(state);
  const std::size_t needed = static_cast<std::size_t>(saved.size()) * sizeof(double);
  need(size >= needed, "the array is too small for the state");
  std::memcpy(bytes, saved.data(), needed);
}

void deserialize_state(const Instance& instance, const void* bytes, std::size_t size,
                       void** state) {
  need(size == serialized_size(instance), "the state is not one of this FMU");
  auto saved = std::make_unique<VectorXd>(instance.saved_size());
  std::memcpy(saved->data(), bytes, size);
  free_state(state);
  *state = saved.release();
}

}  // namespace cdcr::fmu
