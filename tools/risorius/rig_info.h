// SPDX-License-Identifier: MIT
/// \file
/// What a rig is made of and what scripts can drive on it.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"

namespace risorius::cli {

/// name, mesh, parts, size, landmarks, muscles, action units, expressions and kinematic channels.
Json rig_info(const std::filesystem::path& rig_file);

}  // namespace risorius::cli
