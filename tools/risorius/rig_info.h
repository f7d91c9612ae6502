// SPDX-License-Identifier: MIT
/// \file
/// A summary of a rig: its parts, and what scripts can drive.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"

namespace risorius::cli {

/// Returns name, mesh, parts, size, landmarks, muscles, action units, expressions and kinematic channels. Throws Error.
Json rig_info(const std::filesystem::path& rig_file);

}  // namespace risorius::cli
