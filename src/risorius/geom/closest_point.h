// SPDX-License-Identifier: MIT
/// \file
/// Closest points on a triangle surface, first hits of rays, and points that are bound to a surface and move with it.
///
/// Results do not depend on the search tree: of equally near triangles, the one with the lowest index is taken.
///
/// Source: Ericson 2005, Real-Time Collision Detection, 5.1.5, for the closest point on a triangle by Voronoi regions.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// The point of a triangle that is closest to a given point.
struct TrianglePoint {
    Vec3 point = Vec3::Zero();
    Vec3 barycentric = Vec3::Zero();  ///< weights of the three corners, each >= 0, sum 1
    double squared_distance = 0.0;
};
/// Also correct for triangles that are degenerate to a segment or a point.
TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The closest point of a surface, and its triangle.
struct SurfacePoint : TrianglePoint {
    int triangle = -1;
};

/// Where a ray hits a surface.
struct RayHit {
    int triangle = -1;
    double distance = 0.0;  ///< distance along the ray as a multiple of the length of `direction`
    Vec3 barycentric = Vec3::Zero();
    Vec3 point = Vec3::Zero();
};

/// Search tree over the triangles of a surface. It keeps a copy of their corners. Queries may run in parallel.
class SurfaceTree {
  public:
    SurfaceTree() = default;
    SurfaceTree(const Points& positions, const Triangles& triangles);

    /// Moves the triangles to new positions and updates the boxes of the tree. This is faster than building a new tree, but
    /// queries are slower after a large deformation.
    void refit(const Points& positions);

    /// Returns the closest point of the surface; nothing when no triangle lies within `max_distance`.
    std::optional<SurfacePoint> closest(
        const Vec3& p, double max_distance = std::numeric_limits<double>::infinity()) const;

    /// Returns the first hit of the ray on either side of a triangle, with RayHit::distance in [0, max_distance]; nothing when
    /// there is none.
    std::optional<RayHit> cast(const Vec3& origin, const Vec3& direction,
                               double max_distance = std::numeric_limits<double>::infinity()) const;

    int triangle_count() const { return static_cast<int>(triangles_.rows()); }

  private:
    struct Node {
        Vec3 low, high;
        /// Leaf: first index in order_; inner node: index of the left child, which the right child follows
        int first = 0;
        int count = 0;  ///< triangles of a leaf; 0 for an inner node
    };

    void build(int node, int first, int count, const std::vector<Vec3>& centres);
    void fit(Node& node) const;

    Triangles triangles_;
    std::vector<int> order_;                    ///< triangles, leaf after leaf
    std::vector<std::array<Vec3, 3>> corners_;  ///< in the order of order_
    std::vector<Node> nodes_;
};

/// A point bound to a triangle: a foot point on the triangle plus an offset in the triangle's own frame.
struct SurfaceBinding {
    int triangle = -1;
    Vec3 barycentric = Vec3::Zero();
    Vec3 offset = Vec3::Zero();  ///< m, in triangle_frame()
};

/// Returns the axes of a triangle as columns: along its side a b, perpendicular to it in the plane, and normal. It is the
/// identity for a triangle without area.
Mat3 triangle_frame(const Vec3& a, const Vec3& b, const Vec3& c);

/// Binds p to the surface at the foot point `foot`, a point of the surface.
SurfaceBinding bind_to_surface(const Vec3& p, const SurfacePoint& foot, const Points& positions,
                               const Triangles& triangles);
/// Binds each point to the nearest triangle. `tree` must be of the same surface and must not be empty.
std::vector<SurfaceBinding> bind_to_surface(const Points& points, const SurfaceTree& tree,
                                            const Points& positions, const Triangles& triangles);

/// Returns the position of the bound point, m, when the surface has the given positions.
Vec3 bound_point(const SurfaceBinding& binding, const Points& positions,
                 const Triangles& triangles);

}  // namespace risorius::geom
