// SPDX-License-Identifier: MIT
/// \file
/// Places the mesh of a volume muscle in a head: from the coordinates of the mesh of the rig to the head frame, with its ends and the
/// directions of its fibres.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// Nodes are in order from origin to insertion.
struct PlacedMesh {
    enum class End : char { kNone, kOrigin, kInsertion };

    Points nodes;  ///< head frame, m
    Tets tets;
    Points fibres;  ///< T x 3, unit vectors
    /// How densely they lie in each tetrahedron: |grad p| of muscle/fibre_flow.h between the ends, over its mean by flow, so that the same
    /// number of fibres goes through each section
    std::vector<double> density;
    Points normals;             ///< of the surface at each node, outwards, unit vectors; 0 within
    std::vector<double> along;  ///< of each node, 0..1 on the line from origin to insertion
    std::vector<End> end;       ///< of each node
    double length_m = 0;        ///< of the mesh along that line
};

/// `paths`: points of the paths of the muscle on this side, from origin to insertion, m. `place`: of the mesh in messages. Throws Error for
/// a mesh that is not near the path, for an end without nodes, and where a tetrahedron has no direction of fibres.
PlacedMesh place_mesh(const rig::Head& head, const rig::SolidMesh& mesh, Side side,
                      const std::vector<std::vector<Vec3>>& paths, const std::string& place);

}  // namespace risorius::face
