// SPDX-License-Identifier: MIT
/// \file
/// The HTML page of a set of blend shapes: every shape in pictures, its certificate and its drive. It has no scripts and loads nothing from
/// the network.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/blendshapes/bake_shapes.h"
#include "risorius/rig/head.h"

namespace risorius::blendshapes {

struct ShapesPictures {
    static constexpr int kWidth_px = 396, kHeight_px = 440;
    /// Per shape: "front", "three_quarter" and "moved" (how far the skin moves, as colour) -> file.
    std::vector<std::map<std::string, std::string>> shapes;
    std::string sheet;
    std::vector<std::string> files;
};

/// Written below `folder`; names of files are relative to it.
ShapesPictures draw_shapes(const ShapesReport& report, const scene::RigFiles& files,
                           const rig::Head& head, const std::filesystem::path& folder,
                           const ProgressMonitor& monitor);

/// `pictures` null: only numbers.
std::string shapes_page(const ShapesReport& report, const ShapesPictures* pictures);

}  // namespace risorius::blendshapes
