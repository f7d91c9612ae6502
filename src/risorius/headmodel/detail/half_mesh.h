// SPDX-License-Identifier: MIT
/// \file
/// The left half of the skin during construction: vertices, quads, and relaxation over the head surface. Both halves share the midline;
/// mirroring at the end makes the whole exactly symmetric.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::headmodel {

enum class Hold {
    kOnHead,  ///< slides on the head surface while relaxing
    kSmooth,  ///< follows its neighbours in space (crown, nostril, ear: lofted parts)
    kPinned,  ///< does not move
};

/// Regions of the skin, and the lining of the mouth.
enum class Region {
    kScalp,
    kForehead,
    kTemple,
    kBrow,
    kOrbit,
    kLid,
    kNose,
    kWing,
    kNostril,
    kCheek,
    kMouthSkin,
    kLips,
    kChin,
    kJaw,
    kEar,
    kNape,
    kNeck,
    kShoulder,
    kLining
};
/// The names "scalp", "forehead" ..., in the order of the regions.
const std::vector<std::string>& region_names();

struct HalfMesh {
    std::vector<Vec3> point;
    std::vector<Hold> hold;
    std::vector<bool> midline;
    std::vector<std::array<int, 4>> face;
    std::vector<int> group;          ///< of each face: 0 skin, 1 mouth
    std::vector<Region> region;      ///< of each face
    Region adding = Region::kCheek;  ///< region of faces to come

    int add(const Vec3& p, Hold how, bool on_midline = false);
    void quad(int a, int b, int c, int d, int in_group = 0);

    /// Adds faces between two loops of equal length, counter-clockwise from outside; `closed` joins last to first.
    void bridge(const std::vector<int>& outer, const std::vector<int>& inner, bool closed,
                int in_group = 0);

    /// Fills the rectangle bounded by `loop` with quads (left side down `rows`, bottom right `columns`, right side up, top back).
    void fill(const std::vector<int>& loop, int rows, int columns, Hold how, int in_group = 0);

    /// Returns the neighbours of each vertex along edges. A vertex of the midline has neighbours in both halves.
    std::vector<std::vector<int>> neighbours() const;

    /// Returns the outward unit normals at the vertices; their x is 0 on the midline.
    std::vector<Vec3> normals() const;

    /// Removes ripples without shrinking (Taubin 1995). The second argument is the weight of each vertex, 0..1.
    void smooth(int iterations, const std::vector<double>& fraction);

    /// Moves vertices towards the mean of their neighbours; `project` puts vertices on the head back onto it.
    void relax(int iterations, double rate, const std::function<Vec3(const Vec3&)>& project,
               Hold which);
};

/// Returns points of a curve through `places`: one for each vertex 0..count-1 of a closed curve, or 0..count of an open one.
std::vector<Vec3> curve_points(const std::vector<std::pair<double, Vec3>>& through, int count,
                               bool closed);

/// Returns the mesh of both halves: first the vertices of the left one in their order, then the mirrored ones; the faces
/// likewise. The groups are "skin" and "mouth".
geom::PolygonMesh mirrored(const HalfMesh& half);

/// Returns, for each vertex of the half, the index of its mirror image in the mesh of mirrored(); a vertex of the midline is its
/// own one.
std::vector<int> mirror_map(const HalfMesh& half);

}  // namespace risorius::headmodel
