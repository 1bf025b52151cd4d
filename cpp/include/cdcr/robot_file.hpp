#pragma once

#include <string>
#include <string_view>

#include "cdcr/export.hpp"
#include "cdcr/robot.hpp"

// Robot files (TOML), as Python reads and writes them: the same keys, the same refusals. Set-up; in
// a target of its own, cdcr::toml.

namespace CDCR_EXPORT cdcr {

/// The robot of a file. Throws std::invalid_argument where the file cannot be read, where it is no
/// TOML, and for unknown or missing keys, wrong types and values out of range: a sentence for each,
/// one a line, that names file, line where there is one, key and what it must be.
[[nodiscard]] Robot load_robot(const std::string& path);

/// The robot of the text of such a file; `where` stands in the sentences for its name.
[[nodiscard]] Robot robot_from_toml(std::string_view text, const std::string& where = "robot");

}  // namespace CDCR_EXPORT cdcr
