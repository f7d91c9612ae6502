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

/// Depth of the middle layer under the skin / thickness of the tissue.
inline constexpr double kMiddleDepth = 0.42;

inline int node_of(int shell_vertex, Layer layer) { return kLayers * shell_vertex + layer; }

/// The tetrahedral mesh of the tissue at rest. N: vertices of the shell; T: tetrahedra.
struct TissueMesh {
    Points nodes;  ///< 3N x 3, m, at rest
    Tets tets;     ///< T x 4 nodes
    /// T, the outer layer of nodes of each tetrahedron: kMiddle between bone and middle layer, kSkin above.
    std::vector<Layer> tet_layer;
    std::vector<double> thickness_m;  ///< N, of all tissue from bone to skin
    std::vector<Vec3> direction;      ///< N, outward, unit
    std::vector<double> area_m2;      ///< N, area of skin assigned to the vertex
    int dropped_tets = 0;             ///< number of tets that were too thin to be used
};

/// Returns the thickness of the tissue between a point p of the skin and the bone, m: the mean of the samples of the rig, weighted by
/// 1 / distance^4.
double interpolate_thickness(const rig::Head& head,
                             const std::vector<rig::ThicknessSample>& samples, const Vec3& p);

TissueMesh build_tissue_mesh(const rig::Head& head, const rig::RigDescription& rig,
                             const Shell& shell, const std::array<EyeLids, 2>& lids);

/// Removes vertices of the shell's rim that no tetrahedron supports, because all tets under them were too thin. Unsupported vertices are
/// bistable: they could rest on either side of their neighbours.
Shell drop_unsupported_vertices(Shell shell, const rig::Head& head, const rig::RigDescription& rig,
                                const std::array<EyeLids, 2>& lids);

}  // namespace risorius::face
