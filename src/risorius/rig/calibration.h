// SPDX-License-Identifier: MIT
/// \file
/// Names of the measured expressions on which the anatomy was calibrated. Results on these expressions are not an independent
/// test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::rig {

/// A file of the standard anatomy
inline constexpr const char* kCalibrationFile = "calibration.json";

/// Reads a calibration file: {"format": "risorius-calibration", "version": 1, "source": "...", "expressions": [names]}. A list of
/// names, or the path of such a file, may be given instead.
std::vector<std::string> read_calibration(const JsonCursor& json);

/// Returns the names that a rig file gives; empty if it gives none. Throws Error when the file cannot be read.
std::vector<std::string> calibrated_on(const std::filesystem::path& rig_file);

}  // namespace risorius::rig
