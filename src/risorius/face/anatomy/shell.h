// SPDX-License-Identifier: MIT
/// \file
/// The simulated part of the skin: an open shell of outward-facing triangles, coarsened to a size field.
///
/// Region: the face from hairline to throat and back to the front of the ears. Two kinds of triangles are left out: those that turn away
/// from the smooth outward direction (inner lips, lid margins), since prisms under them would be inverted, and walls of nostrils. These
/// parts follow by harmonic extension (docs/theory/skin.md). The shell of a symmetric head is symmetric too, in every edge.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// Options of build_shell().
struct ShellOptions {
    int vertices = 800;  ///< wanted number of skin nodes
};

/// The shell. V: vertices of the head's mesh; N: vertices of the shell.
struct Shell {
    Triangles fine;    ///< the shell before coarsening: triangles of the mesh, mesh vertex indices
    Points direction;  ///< V x 3, smooth outward direction, unit; zero outside the region
    std::vector<int> vertex;  ///< N, mesh vertex of each shell vertex
    Triangles triangles;      ///< of the shell, indices 0..N-1
    /// V, the shell vertex that stands for each mesh vertex; -1 off the shell.
    std::vector<int> collapsed_to;
    std::vector<char> fixed;        ///< N, on the border to the rest of the head
    std::vector<double> spacing_m;  ///< V, wanted edge length
    /// N, signed height over the line where the lips meet and, behind it, over the occlusal plane.
    std::vector<double> over_bite_m;
    /// N, the shell vertex that is the mirror image of each; on the midline, the vertex itself. Empty when the head is not symmetric.
    std::vector<int> mirrored;
};

Shell build_shell(const rig::Head& head, const Jaw& jaw, const std::array<EyeLids, 2>& lids,
                  const ShellOptions& options);

/// Returns the shell without the vertices flagged in `gone` (N flags) and their triangles. Mesh vertices that had collapsed to a removed
/// vertex are assigned to its nearest remaining neighbour. A vertex that loses its last triangle is removed too.
Shell without_vertices(const Shell& shell, const rig::Head& head, const std::vector<char>& gone);

/// Returns the line between the lips from corner to corner, through landmarks: five points, head frame, m.
std::vector<Vec3> lip_line(const rig::Head& head);

}  // namespace risorius::face
