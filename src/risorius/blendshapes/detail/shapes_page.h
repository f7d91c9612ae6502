// SPDX-License-Identifier: MIT
/// \file
/// The HTML page of a set of blend shapes: pictures, certificate and drive of every shape. It has no scripts and loads nothing
/// from the network.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/blendshapes/bake_shapes.h"
#include "risorius/rig/head.h"

namespace risorius::blendshapes {

/// Picture files of a set of shapes.
struct ShapesPictures {
    static constexpr int kWidth_px = 396, kHeight_px = 440;
    /// One map per shape from the name of a view to its file. Views are "front", "three_quarter" and "moved" (colours show how
    /// far the skin moves).
    std::vector<std::map<std::string, std::string>> shapes;
    std::string sheet;
    std::vector<std::string> files;
};

/// Draws the pictures and writes them below `folder`; file names are relative to it. Throws Interrupted.
ShapesPictures draw_shapes(const ShapesReport& report, const scene::RigFiles& files,
                           const rig::Head& head, const std::filesystem::path& folder,
                           const ProgressMonitor& monitor);

/// Returns the complete page. If `pictures` is null, it has only numbers.
std::string shapes_page(const ShapesReport& report, const ShapesPictures* pictures);

}  // namespace risorius::blendshapes
