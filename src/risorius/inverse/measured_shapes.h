// SPDX-License-Identifier: MIT
/// \file
/// Measured expressions of a head: displacement fields over the vertices of its mesh, and the rig's drive for each.
///
/// File: {"shape": [S, V, 3], "dtype": "<f4", "layout": "[shape][vertex][xyz]", "names": [...], "file": "x.f32",
/// "units_per_metre": 100, "excitations": {name: {source: value}}, "on_top_of": {name: other}}, beside a file of raw numbers.
/// Vertices are in the order of the mesh file. Without "file", the numbers of x.json are in x.f32; without "units_per_metre",
/// they are in the unit of the mesh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::inverse {

struct MeasuredShape {
    std::string name;
    Points displacement;  ///< V x 3, m, head frame
    track::Drive drive;   ///< from the rig's tables or from the file
    bool sided = false;   ///< whether the shape belongs to one side only
};

/// Options of read_measured_shapes().
struct MeasuredShapesOptions {
    std::vector<std::string> only = {};  ///< names; empty: all
    /// True: left and right shapes stay separate and are not added to one
    bool separate_sides = false;
};

/// Reads a file. Shapes of two sides (smile_L and smile_R, smileLeft and smileRight) are added to one, "smile". A shape measured
/// on top of another ("on_top_of", and ARKit's mouthClose on jawOpen) is added to it, and so are their drives. Throws Error for a
/// file that does not fit the mesh, for numbers that are not finite, and for names that the rig's tables do not know.
std::vector<MeasuredShape> read_measured_shapes(const std::filesystem::path& file,
                                                const MeasuredShapesOptions& options,
                                                const rig::RigDescription& rig,
                                                const rig::Head& head);

}  // namespace risorius::inverse
