// SPDX-License-Identifier: MIT
/// \file
/// Names of the measured expressions that the anatomy was calibrated on. Results on these expressions are no independent test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::rig {

inline constexpr const char* kCalibrationFile = "calibration.json";  ///< of the standard anatomy

/// Calibration files: {"format": "risorius-calibration", "version": 1, "source": "...", "expressions": [names]}. A list of names, or
/// the path of such a file, may stand in its place.
std::vector<std::string> read_calibration(const JsonCursor& json);

/// The names that a rig file gives; empty when it gives none. Throws Error.
std::vector<std::string> calibrated_on(const std::filesystem::path& rig_file);

}  // namespace risorius::rig
