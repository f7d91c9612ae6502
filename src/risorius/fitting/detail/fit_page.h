// SPDX-License-Identifier: MIT
/// \file
/// The report of a fit as a folder: a page with pictures, and results.json for programs.
#pragma once

#include <filesystem>

#include "risorius/fitting/fit_rig.h"

namespace risorius::fitting {

inline constexpr const char* kFitPicture = "fit.png";

/// Writes the page and results.json to a folder that already has the picture. Throws RunError when a file cannot be written.
void write_fit_report(const FitReport& report, const rig::RigDescription& rig,
                      const std::filesystem::path& folder);

}  // namespace risorius::fitting
