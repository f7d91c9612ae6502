// SPDX-License-Identifier: MIT
// Brings the skin onto the landmarks: a smooth, local displacement that moves the nearest vertices onto them.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <set>

#include "risorius/headmodel/detail/skin.h"

namespace risorius::headmodel {
namespace {

constexpr double kReach = 15.0;  ///< mm; where the displacement of one landmark ends

/// Wendland's C2 function of compact support: the matrix of a set of points is positive definite.
double kernel(double d) {
    const double t = d / kReach;
    return t >= 1 ? 0 : std::pow(1 - t, 4) * (4 * t + 1);
}

}  // namespace

void fit_landmarks(Skin& skin, const DesignTables& tables) {
    HalfMesh& mesh = skin.mesh;
    std::set<int> fixed(skin.fixed.begin(), skin.fixed.end());
    std::set<int> candidates;
    for (std::size_t f = 0; f < mesh.face.size(); ++f)
        for (const int v : mesh.face[f])
            if (!fixed.count(v)) candidates.insert(v);
    struct Pull {
        int vertex;
        Vec3 at, by;
    };
    const std::vector<Vec3> normal = mesh.normals();
    std::vector<Pull> pulls;
    for (const auto& [id, p] : tables.landmarks) {
        if (p.x() < 0 || skin.landmark.count(id)) continue;
        const bool middle = p.x() == 0;
        int best = -1;
        for (const int v : candidates) {
            const auto i = static_cast<std::size_t>(v);
            if (middle != mesh.midline[i]) continue;
            if (best < 0 || (mesh.point[i] - p).squaredNorm() <
                                (mesh.point[static_cast<std::size_t>(best)] - p).squaredNorm())
                best = v;
        }
        const Vec3 at = mesh.point[static_cast<std::size_t>(best)];
        Vec3 by = p - at;
        if (by.norm() > 4) continue;  // a free margin: named by construction
        candidates.erase(best);
        skin.landmark[id] = best;
        // Wing of the nose and fold of the lid keep the form of their loops, which were placed by these points.
        if (id == "al_l" || id == "ac_l" || id == "sbal_l" || id == "c" || id == "ucr_l") continue;
        // Along the skin fully; across it only half, because depth table and landmark differ by their rounding.
        const Vec3& n = normal[static_cast<std::size_t>(best)];
        by -= 0.5 * n * n.dot(by);
        pulls.push_back({best, at, by});
    }
    // The mirrored pulls take part, so that the displacement is symmetric.
    const auto mirrored_point = [](Vec3 p) {
        p.x() = -p.x();
        return p;
    };
    const auto influence = [&](const Vec3& where, const Pull& pull) -> std::pair<double, double> {
        return {kernel((where - pull.at).norm()), kernel((where - mirrored_point(pull.at)).norm())};
    };
    const int n = static_cast<int>(pulls.size());
    std::vector<Eigen::Triplet<double>> even,
        odd;  // for y and z, and for x, which changes sign across the midline
    Eigen::MatrixXd right(n, 3);
    for (int i = 0; i < n; ++i) {
        const auto& row = pulls[static_cast<std::size_t>(i)];
        for (int j = 0; j < n; ++j) {
            const auto [here, there] = influence(row.at, pulls[static_cast<std::size_t>(j)]);
            if (here + there > 0) even.emplace_back(i, j, here + there);
            const bool middle = row.at.x() == 0;  // where x stays 0 whatever the weight
            if (here - there != 0 || (i == j && middle))
                odd.emplace_back(i, j, i == j && middle ? 1.0 : here - there);
        }
        right.row(i) = row.by.transpose();
    }
    const auto solve = [&](const std::vector<Eigen::Triplet<double>>& entries,
                           int axis) -> Eigen::VectorXd {
        Eigen::SparseMatrix<double> matrix(n, n);
        matrix.setFromTriplets(entries.begin(), entries.end());
        return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right.col(axis));
    };
    const Eigen::VectorXd x = solve(odd, 0), y = solve(even, 1), z = solve(even, 2);
    for (std::size_t v = 0; v < mesh.point.size(); ++v) {
        if (fixed.count(static_cast<int>(v))) continue;
        Vec3 by = Vec3::Zero();
        for (int j = 0; j < n; ++j) {
            const auto [here, there] = influence(mesh.point[v], pulls[static_cast<std::size_t>(j)]);
            by += Vec3((here - there) * x[j], (here + there) * y[j], (here + there) * z[j]);
        }
        if (mesh.midline[v]) by.x() = 0;
        mesh.point[v] += by;
    }
}

}  // namespace risorius::headmodel
