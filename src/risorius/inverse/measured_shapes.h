// SPDX-License-Identifier: MIT
/// \file
/// Measured expressions of a head: displacement fields over the vertices of its mesh, and the drive of the rig for each.
///
/// File: {"shape": [S, V, 3], "dtype": "<f4", "layout": "[shape][vertex][xyz]", "names": [...], "file": "x.f32",
/// "units_per_metre": 100, "excitations": {name: {source: value}}, "on_top_of": {name: other}} beside the raw numbers; vertices in
/// the order of the mesh file. Without "file" the numbers are in x.f32 beside x.json, without "units_per_metre" in the unit of the mesh.
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
    track::Drive drive;   ///< the drive for this expression, from the rig's tables or the file
    bool sided = false;   ///< the shape is of one side only
};

struct MeasuredShapesOptions {
    std::vector<std::string> only = {};  ///< names; empty: all
    bool separate_sides =
        false;  ///< left and right shapes are kept separate instead of added to one
};

/// Shapes of two sides (smile_L and smile_R, smileLeft and smileRight) are added to one, "smile". A shape measured on top of another
/// ("on_top_of", and ARKit's mouthClose on jawOpen) is added to it, and so are their drives. Throws Error on a file that does not fit the
/// mesh, on numbers that are not finite, and on names that the rig's tables do not know.
std::vector<MeasuredShape> read_measured_shapes(const std::filesystem::path& file,
                                                const MeasuredShapesOptions& options,
                                                const rig::RigDescription& rig,
                                                const rig::Head& head);

}  // namespace risorius::inverse
