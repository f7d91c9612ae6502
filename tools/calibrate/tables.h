// SPDX-License-Identifier: MIT
/// \file
/// Writes the results of calibration to the standard tables and keeps their layout: one landmark, one band, one shape per line.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "risorius/scene/landmark_displacements.h"
#include "tools/calibrate/calibration.h"

namespace risorius::calibrate {

/// Writes the values of `rig` to attachments.json and muscle_bands.json of `folder`, and to each band the mean fibre length
/// `stretch` of its muscle.
void write_tables(const rig::RigDescription& rig, const std::map<std::string, double>& stretch,
                  const std::filesystem::path& folder);

/// Writes the activations found to facs.json: to the ARKit shapes among `shapes`, or to the unit that a shape consists of.
/// Activations below `min` are left out.
void write_shapes(const std::vector<inverse::MeasuredShape>& shapes, const Result& result,
                  const rig::RigDescription& rig, double min, const std::filesystem::path& folder);

/// Writes landmark_ways.json.
void write_ways(const scene::DisplacementTable& ways, const std::filesystem::path& folder);

}  // namespace risorius::calibrate
