// SPDX-License-Identifier: MIT
/// \file
/// Exact signed distances to a closed triangle surface, which may be deformed. They are negative inside.
///
/// The sign comes from the distance along the angle-weighted normal of the nearest triangle, edge or vertex. It is correct at
/// edges and vertices too (Baerentzen & Aanaes 2005, IEEE Trans. Vis. Comput. Graph. 11(3)).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/geom/closest_point.h"

namespace risorius::contact {

/// The point of the surface that is nearest to a point p.
struct Nearest : geom::SurfacePoint {
    double gap_m = 0;             ///< signed distance of p, negative inside
    Vec3 normal = Vec3::UnitZ();  ///< angle-weighted normal out of the surface, length 1
};

/// A closed surface that answers queries for the nearest point.
class ClosedSurface {
  public:
    /// Throws Error unless every edge joins exactly two triangles that run along it in opposite directions, the volume is
    /// positive, and all positions are finite.
    ClosedSurface(const Points& positions, const Triangles& triangles,
                  const std::string& place = "mesh");

    /// Moves the surface. The triangles stay the same.
    void refit(const Points& positions);

    /// Returns the nearest point, or nothing when the surface is farther than `max_distance_m`. Several threads may call it.
    std::optional<Nearest> nearest(
        const Vec3& p, double max_distance_m = std::numeric_limits<double>::infinity()) const;

    const geom::SurfaceTree& tree() const { return tree_; }
    const Triangles& triangles() const { return triangles_; }
    Vec3 face_normal(int triangle) const { return face_normals_.row(triangle).transpose(); }
    Vec3 vertex_normal(int vertex) const { return vertex_normals_.row(vertex).transpose(); }

  private:
    Triangles triangles_;
    Triangles edge_of_side_;
    int edge_count_ = 0;
    geom::SurfaceTree tree_;
    Points face_normals_, edge_normals_, vertex_normals_;  // length 1; 0 where there is no area
};

/// Volume inside the surface, m^3; negative when its triangles face inwards.
double enclosed_volume(const Points& positions, const Triangles& triangles);

}  // namespace risorius::contact
