// The part of the skin that is simulated: an open shell of triangles facing outwards, coarsened to a size field.
//
// Region: the face from hairline to throat and back to the front of the ears. Triangles that turn away from the smooth outward direction
// (inner lips, lid margins) are left out: under them prisms would invert; so are the walls of nostrils. They follow by harmonic extension
// (skin_binding.h). On a head that is its own mirror image so is the shell, to the last diagonal. Source: measured face formulation, geometry pipeline.
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

/// The shell without the vertices that are flagged, N, and their faces. What had collapsed to one of them belongs to its nearest
/// neighbour that stays; a vertex that loses its last face goes too.
Shell without_vertices(const Shell& shell, const rig::Head& head, const std::vector<char>& gone);

/// The line between the lips, corner to corner, from landmarks.
std::vector<Vec3> lip_line(const rig::Head& head);

}  // namespace risorius::face
