// The nearest point of a triangle surface, what a ray meets first, and points bound to a surface so that they follow it.
//
// Answers do not depend on how the search tree is cut: of equally near triangles the one with the lowest index wins.
// Closest point on a triangle by regions of Voronoi: Ericson 2005, Real-Time Collision Detection, 5.1.5.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

struct TrianglePoint {
    Vec3 point = Vec3::Zero();
    Vec3 barycentric = Vec3::Zero();  ///< weights of the three corners, each >= 0, sum 1
    double squared_distance = 0.0;
};
/// Also right for triangles collapsed to a segment or a point.
TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

struct SurfacePoint : TrianglePoint {
    int triangle = -1;
};

struct RayHit {
    int triangle = -1;
    double distance = 0.0;  ///< along the ray, in lengths of `direction`
    Vec3 barycentric = Vec3::Zero();
    Vec3 point = Vec3::Zero();
};

/// Search tree over the triangles of a surface; keeps its own copy of their corners. Queries may run in parallel.
class SurfaceTree {
  public:
    SurfaceTree() = default;
    SurfaceTree(const Points& positions, const Triangles& triangles);

    /// Same triangles, moved: keeps the tree and only grows its boxes. Cheaper than building, slower to search after
    /// large deformation.
    void refit(const Points& positions);

    /// Nothing within `max_distance`, or no triangles: empty.
    std::optional<SurfacePoint> closest(
        const Vec3& p, double max_distance = std::numeric_limits<double>::infinity()) const;

    /// First triangle met in [0, max_distance], from either face.
    std::optional<RayHit> cast(const Vec3& origin, const Vec3& direction,
                               double max_distance = std::numeric_limits<double>::infinity()) const;

    int triangle_count() const { return static_cast<int>(triangles_.rows()); }

  private:
    struct Node {
        Vec3 low, high;
        int first = 0;  ///< leaf: first place in order_; else left child, the right one follows
        int count = 0;  ///< triangles of a leaf, 0 for an inner node
    };

    void build(int node, int first, int count, const std::vector<Vec3>& centres);
    void fit(Node& node) const;

    Triangles triangles_;
    std::vector<int> order_;                    ///< triangles, leaf after leaf
    std::vector<std::array<Vec3, 3>> corners_;  ///< in that order
    std::vector<Node> nodes_;
};

/// A point held by a triangle: foot on the triangle plus an offset in the triangle's own frame.
struct SurfaceBinding {
    int triangle = -1;
    Vec3 barycentric = Vec3::Zero();
    Vec3 offset = Vec3::Zero();  ///< m, in triangle_frame()
};

/// Columns: along side 0, across it in the plane, normal. The identity for a triangle without area.
Mat3 triangle_frame(const Vec3& a, const Vec3& b, const Vec3& c);

SurfaceBinding bind_to_surface(const Vec3& p, const SurfacePoint& foot, const Points& positions,
                               const Triangles& triangles);
/// To the nearest triangle each; `tree` is of the same surface and must not be empty.
std::vector<SurfaceBinding> bind_to_surface(const Points& points, const SurfaceTree& tree,
                                            const Points& positions, const Triangles& triangles);

/// Where the bound point is now; `positions` may be moved.
Vec3 bound_point(const SurfaceBinding& binding, const Points& positions,
                 const Triangles& triangles);

}  // namespace risorius::geom
