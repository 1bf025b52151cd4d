#pragma once

#include <doctest/doctest.h>

#include <stdexcept>

/// Checks that an expression throws std::invalid_argument with exactly this text.
#define CHECK_THROWS_SENTENCE(expression, sentence) \
  CHECK_THROWS_WITH_AS(static_cast<void>(expression), sentence, std::invalid_argument)
