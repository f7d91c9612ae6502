// SPDX-License-Identifier: MIT
/// \file
/// Triangles, wires and balls of an object as one list of triangles from far to near, ready to be blended in that order.
///
/// Each keeps its depth by its middle (the painter's order, Newell, Newell and Sancha 1972), which is right for the even
/// meshes of grids; wires count as half a cell nearer, so that they lie on the surface they belong to.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/object_camera.h"
#include "risorius/render/object_view.h"

namespace risorius::render {

/// What the fragment shader does with a vertex.
enum class PartKind : std::uint8_t { kSurface = 0, kWire = 1, kBall = 2 };

struct PartVertex {
    float position[3];  ///< m, world
    float normal[3];    ///< camera axes; of surfaces
    float colour[3];    ///< linear
    float place[2];     ///< across a ball, -1..1
    float kind;
};

/// Throws Error naming `place` for indices that name no vertex and positions that are not finite.
void check_object(const Object& object, const std::string& place);

std::vector<PartVertex> object_parts(const Object& object, const ObjectRow& row,
                                     const ObjectCamera& camera);

}  // namespace risorius::render
