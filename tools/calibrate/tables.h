// SPDX-License-Identifier: MIT
/// \file
/// Writes what calibration found into the standard tables, keeping their form: one landmark, one band, one shape per line.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "risorius/scene/landmark_displacements.h"
#include "tools/calibrate/calibration.h"

namespace risorius::calibrate {

/// attachments.json and muscle_bands.json of `folder` get the numbers of `rig`; each muscle of the bands the length it shortened to.
void write_tables(const rig::RigDescription& rig, const std::map<std::string, double>& stretch,
                  const std::filesystem::path& folder);

/// facs.json: the ARKit shapes among `shapes`, or the unit that one of them is, get the activations found. Sources under `least` are left out.
void write_shapes(const std::vector<inverse::MeasuredShape>& shapes, const Result& result,
                  const rig::RigDescription& rig, double min, const std::filesystem::path& folder);

/// landmark_ways.json.
void write_ways(const scene::DisplacementTable& ways, const std::filesystem::path& folder);

}  // namespace risorius::calibrate
