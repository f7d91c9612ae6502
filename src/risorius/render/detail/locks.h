// SPDX-License-Identifier: MIT
/// \file
/// The hair of a style as opaque triangles: locks over a cap. A lock is a strip of three points across, with the section of a roof,
/// that tapers to its tip. It is planned for any head from its landmarks, at rest, and each lock is bound to a place of the skin.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/lock_style.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/detail/strands.h"
#include "risorius/render/scene.h"

namespace risorius::render {

struct HairVertex {
    std::size_t root = 0;  ///< number of the place of the skin that it follows
    Vec3 offset;           ///< from the root at rest, m
    Vec3 along, out;       ///< unit vectors at rest: along the hair, and away from the head
    Vec2 strand;           ///< texture coordinates: across the hairs and along them
    double lit = 1;        ///< share of the light that reaches it between the locks
    double tone = 1;       ///< factor of the hair's tone
    double grey = 0;       ///< added share of white hairs
    double across = 0;     ///< place across the lock, -1..1; its sides are single hairs
    double open = 0;       ///< 0..1, how thin the hair is along the lock or the cap; 1: none
};

/// A lock or the cap: a range of triangles and of vertices.
struct HairPiece {
    std::size_t first_index = 0, indices = 0, first_vertex = 0, vertices = 0;
    std::size_t columns = 0;  ///< vertices across a lock; 0: the cap
    std::size_t rows = 0;     ///< of so many vertices; those of its ends come after them
    bool turns_away = true;   ///< may be left out where it faces away from the camera
    bool casts = true;        ///< counts for the shadow
};

struct Hair {
    std::vector<SkinPlace> roots;
    std::vector<HairVertex> vertices;
    std::vector<unsigned> triangles;  ///< three vertices each
    std::vector<HairPiece> pieces;
    std::vector<unsigned> casters;  ///< fewer triangles, for the shadow
    /// Per vertex of the scene: 1 for skin well below the cap, which is never seen; empty without a cap
    std::vector<std::uint8_t> covered;
    bool empty() const { return triangles.empty(); }
};

/// Returns the hair of the scene's appearance; none for the style "shaven", for skin with a texture of its own, and for a head
/// without the landmarks of a hairline.
Hair plan_hair(const Scene& scene, const SkinPlan& plan, const Vec3& paint_centre);
/// The same with the plan of the scene's skin.
Hair plan_hair(const Scene& scene);

/// Returns the triangles, counter-clockwise as seen from where their normals point.
Triangles triangles_from_outside(const Hair& hair, const Points& rest);

/// Where the hair is in a pose, m, world, one row per vertex, and how the head is turned from its rest.
struct PosedHair {
    Points positions;
    Mat3 turned = Mat3::Identity();
    Vec3 moved = Vec3::Zero();  ///< where the origin of the head frame is, m, world
    Vec3 in_head(const Vec3& at) const { return moved + turned * at; }
};
PosedHair pose_hair(const Hair& hair, const Points& rest, const Points& positions);

}  // namespace risorius::render
