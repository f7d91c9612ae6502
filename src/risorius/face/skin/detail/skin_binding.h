// SPDX-License-Identifier: MIT
/// \file
/// Transfers the motion of the simulated shell to every vertex of the imported skin.
///
///   u_v = sum_i w_vi u_i + (T - I) sum_j m_vj X_j        u_i  skin node displacements, T  motion of the mandible
///
/// On the shell, the weights are barycentric in the coarse triangles and smoothed over the mesh, so that no facets show. Off the shell
/// (inner lips, nostrils, mouth lining) they are the harmonic extension. The back of the mouth is fixed to skull and mandible; everything
/// outside of the face is fixed at rest.
#pragma once

#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/rig/head.h"

namespace risorius::face {

class SkinBinding {
  public:
    SkinBinding(const rig::Head& head, const Jaw& jaw, const Shell& shell);

    /// Adds the displacement of every vertex to `vertices` (V x 3, m). `shell_displacement` is N x 3, m.
    void apply(const Points& shell_displacement, const Rigid& mandible, Points& vertices) const;

    /// The transpose: converts a gradient with respect to the vertices (V x 3) to one with respect to the shell (`shell_vertices` x 3).
    Points pull_back(const Points& by_vertex, long shell_vertices) const;

    /// Moves a vertex of another part (a lash) like the skin vertex `like`.
    void follow(int vertex, int like);
    /// Pairs given to follow(): vertex, skin vertex.
    const std::vector<std::pair<int, int>>& followers() const { return followers_; }

    /// Vertices that the shell or the harmonic extension moves.
    std::vector<char> moving() const;

  private:
    struct Row {
        int begin = 0, end = 0;
        double jaw = 0.0;
        Vec3 jaw_point = Vec3::Zero();
    };
    std::vector<Row> rows_;  // V
    std::vector<int> column_;
    std::vector<double> weight_;
    std::vector<std::pair<int, int>> followers_;
};

}  // namespace risorius::face
