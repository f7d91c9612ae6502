// SPDX-License-Identifier: MIT
/// \file
/// The simulated part of the skin: an open shell of outward-facing triangles, coarsened to a size field.
///
/// Region: the face from hairline to throat and back to the front of the ears. Two kinds of triangles are left out: those that turn away
/// from the smooth outward direction (inner lips, lid margins), since prisms under them would be inverted, and walls of nostrils. These
/// parts follow by harmonic extension (skin_binding.h). The shell of a head that is its own mirror image is symmetric in every edge.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/rig/head.h"

namespace risorius::face {

struct ShellOptions {
    int vertices = 800;  ///< wanted number of skin nodes
};

struct Shell {
    Triangles fine;           ///< the shell at the mesh's own resolution, mesh vertex indices
    Points direction;         ///< V x 3, smooth outward direction, unit; zero outside the region
    std::vector<int> vertex;  ///< N, mesh vertex of each shell vertex
    Triangles triangles;      ///< over 0..N-1
    std::vector<int> collapsed_to;    ///< V -> 0..N-1, -1 off the shell
    std::vector<char> fixed;          ///< N, on the border to the rest of the head
    std::vector<double> spacing_m;    ///< V, wanted edge length
    std::vector<double> over_bite_m;  ///< N, height over the bite, see bite_heights()
    std::vector<int>
        mirrored;  ///< N, the vertex on the other side, itself on the midline; empty when the head is not symmetric
};

Shell build_shell(const rig::Head& head, const Jaw& jaw, const std::array<EyeLids, 2>& lids,
                  const ShellOptions& options);

/// The shell without the flagged vertices (N flags) and their faces. Mesh vertices that had collapsed to a removed vertex are assigned to
/// its nearest remaining neighbour. A vertex that loses its last face is removed too.
Shell without_vertices(const Shell& shell, const rig::Head& head, const std::vector<char>& gone);

/// The line between the lips from corner to corner, through landmarks: five points, head frame, m.
std::vector<Vec3> lip_line(const rig::Head& head);

}  // namespace risorius::face
