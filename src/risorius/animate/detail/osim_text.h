// SPDX-License-Identifier: MIT
/// \file
/// Muscles as a model of OpenSim, and activations as its tables over time. Sources: OpenSim 4 documentation, "OpenSim Models" and "Storage
/// (.sto) Files"; Seth et al. 2018, PLoS Comput. Biol. 14(7), e1006223.
#pragma once

#include <string>
#include <vector>

#include "risorius/face/muscle_lines.h"

namespace risorius::animate {

/// "masseter_superficial_l", "frontalis_2_r": the name of a line in both files. Bundles are counted where a side has several.
std::vector<std::string> osim_names(const std::vector<face::MuscleLine>& lines);

/// The model: a skull that is the ground, mandible on a hinge, hyoid, and a muscle for each line. Axes are those of OpenSim: x forward, y
/// up, z to the right.
std::string osim_text(const std::string& name, const std::vector<face::MuscleLine>& lines,
                      const face::JawHinge& hinge);

/// A table: one column for each of `names`, one row for each time.
std::string storage_text(const std::string& name, const std::vector<std::string>& names,
                         const std::vector<double>& times_s,
                         const std::vector<std::vector<double>>& rows);

}  // namespace risorius::animate
