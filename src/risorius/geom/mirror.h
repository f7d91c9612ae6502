// SPDX-License-Identifier: MIT
/// \file
/// Left and right of a symmetric surface: the mirror partner of each vertex, one half, and coarsening in pairs.
///
/// A surface is symmetric when its vertices come in pairs, with a line of vertices (the seam) between the halves. Its triangles
/// need not be symmetric, because polygons are cut arbitrarily: one half and its mirror image represent both.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/decimate.h"

namespace risorius::geom {

/// The mirror plane of a surface and the partner of each vertex.
struct MirrorPairs {
    /// V; the mirror partner of each vertex: the vertex itself on the seam, -1 for a vertex without partner.
    std::vector<int> partner;
    /// Unit normal of the mirror plane normal.p = offset. It points to the first half.
    Vec3 normal = Vec3::UnitX();
    double offset = 0.0;

    bool found() const { return !partner.empty(); }
    Vec3 reflect(const Vec3& direction) const {
        return direction - 2.0 * normal.dot(direction) * normal;
    }
    /// Returns the half of a vertex: 0 on the seam, 1 in the first half, -1 in the other half.
    int side(int v, const Points& points) const {
        if (partner[static_cast<std::size_t>(v)] == v) return 0;
        return points.row(v).dot(normal) > offset ? 1 : -1;
    }
};

/// Finds the mirror plane near the plane normal.p = offset. The mirror image of a vertex may be at most `tolerance` times its
/// shortest edge away from the partner. The result is not found() when any vertex has no partner or a triangle crosses the seam.
MirrorPairs find_mirror_pairs(const Triangles& triangles, const Points& points, Vec3 normal,
                              double offset, double tolerance = 0.25);

/// Returns the triangles in the first half.
Triangles first_half(const Triangles& whole, const Points& points, const MirrorPairs& mirror);
/// Returns the triangles in the first half whose mirror image is also a triangle of the surface.
Triangles paired_half(const Triangles& whole, const Points& points, const MirrorPairs& mirror);
/// Returns the triangles of the half, followed by their mirror images.
Triangles with_mirror_image(const Triangles& half, const MirrorPairs& mirror);

/// Coarsens the first half by decimate() and gives the other half the mirror image of the result. Vertices of the seam collapse
/// only along the seam.
Decimated decimate_mirrored(const Triangles& half, const Points& points,
                            const std::vector<double>& length, const MirrorPairs& mirror,
                            const DecimateOptions& options = {});

}  // namespace risorius::geom
