#pragma once

namespace cdcr::test {

/// Whether a function or member function is declared noexcept, read from its pointer's type.
template <class Pointer>
constexpr bool is_noexcept = false;
template <class Result, class... Arguments>
constexpr bool is_noexcept<Result (*)(Arguments...) noexcept> = true;
template <class Result, class Class, class... Arguments>
constexpr bool is_noexcept<Result (Class::*)(Arguments...) noexcept> = true;
template <class Result, class Class, class... Arguments>
constexpr bool is_noexcept<Result (Class::*)(Arguments...) const noexcept> = true;

}  // namespace cdcr::test
