#pragma once

// toml++ by its headers alone, whatever the package of the system defines, and without its writers.
#undef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>
