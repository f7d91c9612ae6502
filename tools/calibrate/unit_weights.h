// SPDX-License-Identifier: MIT
/// \file
/// Finds the muscle weights of action units from goals for landmarks, on several heads.
///
/// File of goals: {"AU14": {"muscles": ["buccinator", ...], "go": {"ch": [0.8, 2, -5.7], ...}, "stay": ["ls", ...], "from": {...}}}
///   go    displacement in mm on the average head; landmarks of the left side or the midline
///   stay  landmarks that should not move; they count a quarter
///   from  weights to start from, muscle -> weight. Default: those of the rig's table
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/scene/rig_files.h"

namespace risorius::calibrate {

/// Prints the weights found on each head, their mean, and the gains with that mean.
void find_unit_weights(const std::vector<std::filesystem::path>& rigs,
                       const std::filesystem::path& goals, const std::vector<std::string>& only,
                       double keep);

/// Measures the gains of the units of a rig (fitting/fit_units.h) and writes them into its file.
void write_unit_gains(const std::filesystem::path& rig);

}  // namespace risorius::calibrate
