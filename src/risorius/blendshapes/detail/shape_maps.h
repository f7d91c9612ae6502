// SPDX-License-Identifier: MIT
/// \file
/// Maps of blend shapes on the texture of the skin, for materials that follow the weights: where a shape compresses the skin, where it
/// stretches it, and the wrinkles that are finer than the mesh.
///
///   compression, stretch   -least and greatest principal strain of the skin, kFull at white
///   normal                 height h = sum_k A_k H(f_k) of the folds over the smooth skin (docs/theory/wrinkles.md); tangent space, x along
///                          the texture coordinate u, y along v (up), as glTF has it
///
/// All of them are what the shape changes: the values of the skin at rest are subtracted, and of a shape on top of another those of the
/// other. So maps may be multiplied by weights and added.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/make_shapes.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/parallel.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// The files of a shape, relative to the folder; empty where the shape changes nothing that would be seen.
struct ShapeMaps {
    std::string name, compression, stretch, normal;
    double deepest_m = 0;  ///< largest change of the depth of a wrinkle in `normal`
};

struct MapsReport {
    int side_px = 0;
    std::string neutral_normal;  ///< lines that stay at rest; empty: none
    std::vector<ShapeMaps> shapes;

    std::vector<std::string> files() const;
    Json json() const;
};

/// Writes folder/maps/NAME_compression.png, NAME_stretch.png and NAME_normal.png. Throws Error for a skin without texture coordinates,
/// and Interrupted.
MapsReport write_shape_maps(const scene::RigFiles& files, const face::Face& face,
                            const MadeShapes& shapes, int side_px,
                            const std::filesystem::path& folder, const ThreadLimit& threads,
                            const ProgressMonitor& monitor);

}  // namespace risorius::blendshapes
