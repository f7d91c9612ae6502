// Carries the motion of the simulated shell to every vertex of the imported skin.
//
//   u_v = sum_i w_vi u_i + (T - I) sum_j m_vj X_j        u_i  skin node displacements, T  motion of the mandible
//
// On the shell the weights are barycentric in the coarse triangles and smoothed over the mesh, so that no facet shows.
// Off the shell (inner lips, nostrils, mouth lining) they are the harmonic extension, with the back of the mouth on
// skull and mandible and everything outside the face at rest.
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

    /// Adds the displacement of every skin vertex to `vertices` (V x 3). `shell_displacement` is N x 3.
    void apply(const Points& shell_displacement, const Rigid& mandible, Points& vertices) const;

    /// The transpose: from a slope by the vertices to that by the shell's displacement, `shell_vertices` x 3.
    Points pull_back(const Points& by_vertex, long shell_vertices) const;

    /// Binds another vertex (a lash) as the skin vertex `like`.
    void follow(int vertex, int like);
    /// What was bound so: vertex, like.
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
