// SPDX-License-Identifier: MIT
/// \file
/// Reads the action units of a rig as a coder of FACS measures them, see scene/unit_reader.h, and writes what a coder needs to judge them
/// by eye: a page with pictures and cues, and a kit of clips without names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/unit_reader.h"

namespace risorius::inverse {

struct UnitReadings {
    std::string rig;  ///< file name
    scene::FaceMeasures neutral;
    std::vector<scene::UnitReading> units;
    Json json() const;
};

struct UnitOptions {
    std::filesystem::path rig = {};
    std::filesystem::path out = {};      ///< a folder for the report; empty: nothing is written
    std::vector<std::string> only = {};  ///< ids of units; empty: all with landmark targets
    std::string quality = "preview";
    bool pictures = true;
    bool steps = true;       ///< also at a quarter, a half and three quarters of the intensity
    bool kit = false;        ///< also a kit of clips for coders; needs `out`
    std::uint64_t seed = 1;  ///< order of the clips of the kit
};

/// Reads units of the rig's table that have landmark targets, and writes the report if one is asked for:
///
///   index.html, coder.js   each unit beside the neutral face, with its cues, its numbers and boxes to tick
///   pictures/UNIT.png, pictures/UNIT_moved.png, pictures/neutral.png, contact_sheet.png
///   results.json           the readings
///   kit/                   with `kit`: see detail/coder_kit.h
///
/// Throws Error for an unknown unit, or a rig that cannot be used, and Interrupted when the monitor asks to stop.
UnitReadings read_units(const UnitOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
