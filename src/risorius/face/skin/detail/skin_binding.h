// SPDX-License-Identifier: MIT
/// \file
/// Transfers the motion of the simulated shell to every vertex of the skin of the mesh.
///
///   u_v = sum_i w_vi u_i + (T - I) sum_j m_vj X_j
///
///   u_v  displacement of mesh vertex v         u_i  displacement of shell vertex i       w, m  weights
///   T    motion of the mandible from rest      X_j  rest position of a vertex that is fixed to the mandible
///
/// On the shell, the weights are barycentric in the coarse triangles and smoothed over the mesh, so that no facets show. Off the shell
/// (inner lips, nostrils, mouth lining) they are the harmonic extension. The back of the mouth is fixed to skull and mandible; everything
/// outside the face stays at rest.
#pragma once

#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// The weights of one head.
class SkinBinding {
  public:
    SkinBinding(const rig::Head& head, const Jaw& jaw, const Shell& shell);

    /// Adds the displacement of every vertex to `vertices` (V x 3, m). `shell_displacement` is N x 3, m.
    void apply(const Points& shell_displacement, const Rigid& mandible, Points& vertices) const;

    /// Applies the transpose: converts a gradient by the vertices (V x 3) to the gradient by the shell vertices (`shell_vertices` x 3).
    Points pull_back(const Points& by_vertex, long shell_vertices) const;

    /// Returns the shell vertices that move a vertex, with their weights. Empty when the tissue does not move it.
    std::vector<std::pair<int, double>> row(int vertex) const;

    /// Makes apply() move a vertex of another part (a lash) like the skin vertex `like`.
    void follow(int vertex, int like);
    /// Returns the pairs given to follow(): vertex, skin vertex.
    const std::vector<std::pair<int, int>>& followers() const { return followers_; }

    /// Returns V flags: whether the shell or the harmonic extension moves the vertex.
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
