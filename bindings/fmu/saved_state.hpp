#pragma once

#include <cstddef>

#include "instance.hpp"

// States of an instance as FMI hands them about: pointers that mean nothing outside, and bytes.
// All throw std::invalid_argument with a sentence.

namespace cdcr::fmu {

/// Into *state, which is made where it is null.
void save_state(const Instance& instance, void** state);
void restore_state(Instance& instance, const void* state);
void free_state(void** state) noexcept;

[[nodiscard]] std::size_t serialized_size(const Instance& instance) noexcept;
void serialize_state(const void* state, void* bytes, std::size_t size);
void deserialize_state(const Instance& instance, const void* bytes, std::size_t size, void** state);

}  // namespace cdcr::fmu
