// SPDX-License-Identifier: MIT
/// \file
/// Reads the action units of a rig as a coder of FACS measures them, see scene/unit_reader.h.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/unit_reader.h"

namespace risorius::inverse {

struct UnitReadings {
    std::string rig;  ///< file name
    scene::FaceLengths neutral;
    std::vector<scene::UnitReading> units;
    Json json() const;
};

/// Reads units of the rig's table that have landmark targets; `only` names units, empty: all. Throws Error for an unknown unit, or a rig
/// that cannot be used, and Interrupted when the monitor asks to stop.
UnitReadings read_units(const std::filesystem::path& rig, const std::vector<std::string>& only,
                        const std::string& quality, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
