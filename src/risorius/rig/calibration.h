// Which measured expressions the numbers of an anatomy were tuned with, so that results can be told apart from those of others.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::rig {

inline constexpr const char* kCalibrationFile = "calibration.json";  ///< of the standard anatomy

/// Files: {"format": "risorius-calibration", "version": 1, "source": "...", "expressions": [names]}. A list of names stands for
/// one, too, and so does its path.
std::vector<std::string> read_calibration(const JsonCursor& json);

/// Of a rig file; none when it does not say. Throws Error.
std::vector<std::string> calibrated_on(const std::filesystem::path& rig_file);

}  // namespace risorius::rig
