// SPDX-License-Identifier: MIT
/// \file
/// Soft tissue between the skin shell and the bone. It has three layers of nodes: deep (on the bone), middle and skin. Each prism of a
/// column is cut into tetrahedra.
///
/// Node of shell vertex v in layer l: 3 v + l.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

enum Layer { kDeep = 0, kMiddle = 1, kSkin = 2, kLayers = 3 };

inline constexpr double kMiddleDepth = 0.42;  ///< of the thickness, from the skin

inline int node_of(int shell_vertex, Layer layer) { return kLayers * shell_vertex + layer; }

struct TissueMesh {
    Points nodes;  ///< 3N x 3, rest
    Tets tets;
    std::vector<Layer>
        tet_layer;  ///< outer layer of the slab that the tet lies in: kMiddle (deep slab) or kSkin
    std::vector<double> thickness_m;  ///< N
    std::vector<Vec3> direction;      ///< N, outward, unit
    std::vector<double> area_m2;      ///< N, area of skin assigned to the vertex
    int dropped_tets = 0;             ///< number of tets that were too thin to be used
};

/// Thickness of the tissue over bone below a point of the skin, m: the samples of the rig, weighted by 1 / distance^4.
double interpolate_thickness(const rig::Head& head,
                             const std::vector<rig::ThicknessSample>& samples, const Vec3& p);

TissueMesh build_tissue_mesh(const rig::Head& head, const rig::RigDescription& rig,
                             const Shell& shell, const std::array<EyeLids, 2>& lids);

/// Removes vertices of the shell's rim that no tetrahedron supports, because all tets under them were too thin. Unsupported vertices are
/// bistable: they could rest on either side of their neighbours.
Shell drop_unsupported_vertices(Shell shell, const rig::Head& head, const rig::RigDescription& rig,
                                const std::array<EyeLids, 2>& lids);

}  // namespace risorius::face
