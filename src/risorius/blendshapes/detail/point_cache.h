// SPDX-License-Identifier: MIT
/// \file
/// Positions of all vertices in every frame, in two formats that Blender (modifier Mesh Cache), Maya and 3ds Max read.
///
/// Sources: PC2 as in 3ds Max's PointCache2, little-endian; MDD as in LightWave's Motion Designer, big-endian.
#pragma once

#include <string>
#include <vector>

namespace risorius::blendshapes {

/// Positions as [frame][vertex][xyz].
struct PointCache {
    long vertices = 0, frames = 0;
    double fps = 60;
    std::vector<float> positions;
};

/// Samples are one frame apart, from frame 0.
std::string pc2_bytes(const PointCache& cache);
/// Frames have their times in seconds.
std::string mdd_bytes(const PointCache& cache);

}  // namespace risorius::blendshapes
