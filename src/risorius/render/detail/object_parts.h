// SPDX-License-Identifier: MIT
/// \file
/// Triangles, wires and balls of an object as one list of triangles, sorted from far to near and ready to be blended in that
/// order.
///
/// Each part is sorted by the depth of its centre (painter's algorithm, Newell, Newell and Sancha 1972), which is right for the
/// even meshes of grids. Wires are moved half a cell nearer, so that they lie on their own surface.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/object_camera.h"
#include "risorius/render/object_view.h"

namespace risorius::render {

/// How the fragment shader draws a triangle; all its vertices have the same kind.
enum class PartKind : std::uint8_t { kSurface = 0, kWire = 1, kBall = 2 };

struct PartVertex {
    float position[3];  ///< m, world
    float normal[3];    ///< in camera axes; for surfaces
    float colour[3];    ///< linear
    float place[2];     ///< position on the square that shows a ball, -1..1 in x and y
    float kind;
};

/// Throws Error for vertex indices out of range and positions that are not finite; the message begins with `place`.
void check_object(const Object& object, const std::string& place);

std::vector<PartVertex> object_parts(const Object& object, const ObjectRow& row,
                                     const ObjectCamera& camera);

}  // namespace risorius::render
