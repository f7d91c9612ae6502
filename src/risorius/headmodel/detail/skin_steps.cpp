// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/skin_steps.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "risorius/headmodel/detail/eyes.h"

namespace risorius::headmodel {
namespace {

/// Change of the displacement along the skin, mm per mm: gentle below the first, a step from the second on
constexpr double kGentleSlope = 0.28, kStepSlope = 0.60;
constexpr double kWidest_mm = 14, kNarrowest_mm = 0.05;

double ramp(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Of the average head, mm, left side or midline.
struct Feature {
    Vec3 centre, radii;
};

/// 0 on lids, nose, lips and ears, 1 from half of their size away from them.
double freedom(Vec3 p) {
    static const std::vector<Feature> kFeatures{{Globe().centre, {26, 22, 26}},
                                                {{0, -8, 100}, {23, 36, 34}},
                                                {{0, -52, 92}, {33, 17, 34}},
                                                {{72, 4, -8}, {22, 40, 30}}};
    p.x() = std::abs(p.x());
    double least = 1;
    for (const Feature& one : kFeatures)
        least = std::min(least, ramp(1, 1.5, (p - one.centre).cwiseQuotient(one.radii).norm()));
    return least;
}

struct SkinGraph {
    std::vector<std::pair<int, int>> edges;  ///< of mesh vertices, each once
    std::vector<double> area;                ///< V, mm2; 0: not of the skin
};

SkinGraph graph_of_skin(const geom::PolygonMesh& mesh) {
    SkinGraph graph;
    graph.area.assign(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
    const int skin = mesh.group_index("skin");
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_group[static_cast<std::size_t>(f)] != skin) continue;
        const int begin = mesh.face_begin[static_cast<std::size_t>(f)],
                  corners = mesh.corner_count(f);
        const auto vertex = [&](int k) {
            return mesh.corner_vertex[static_cast<std::size_t>(begin + k % corners)];
        };
        const Vec3 first = mesh.positions.row(vertex(0)).transpose();
        Vec3 normal = Vec3::Zero();
        for (int k = 0; k < corners; ++k) {
            const Vec3 a = mesh.positions.row(vertex(k)).transpose() - first,
                       b = mesh.positions.row(vertex(k + 1)).transpose() - first;
            normal += a.cross(b);
            graph.edges.emplace_back(std::minmax(vertex(k), vertex(k + 1)));
        }
        for (int k = 0; k < corners; ++k)
            graph.area[static_cast<std::size_t>(vertex(k))] += 0.5 * normal.norm() / corners;
    }
    std::sort(graph.edges.begin(), graph.edges.end());
    graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
    return graph;
}

/// V: how far the displacement of each vertex is spread, mm.
std::vector<double> widths(const geom::PolygonMesh& usual, const SkinGraph& graph,
                           const Points& displacement) {
    constexpr int kRings = 4;  // around a step that are spread with it
    constexpr double kKept = 0.8;
    const std::size_t count = graph.area.size();
    std::vector<double> free(count), steep(count, 0.0);
    for (std::size_t v = 0; v < count; ++v)
        free[v] = freedom(usual.positions.row(static_cast<Eigen::Index>(v)).transpose());
    for (const auto& [a, b] : graph.edges) {
        const double length = (usual.positions.row(a) - usual.positions.row(b)).norm(),
                     change = (displacement.row(a) - displacement.row(b)).norm();
        const double step = ramp(kGentleSlope, kStepSlope, change / std::max(length, 0.5));
        for (const int v : {a, b}) {
            double& there = steep[static_cast<std::size_t>(v)];
            there = std::max(there, step);
        }
    }
    for (int ring = 0; ring < kRings; ++ring) {
        std::vector<double> wider = steep;
        for (const auto& [a, b] : graph.edges) {
            const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
            wider[i] = std::max(wider[i], kKept * steep[j]);
            wider[j] = std::max(wider[j], kKept * steep[i]);
        }
        steep = std::move(wider);
    }
    for (std::size_t v = 0; v < count; ++v)
        steep[v] = std::max(kWidest_mm * free[v] * steep[v], kNarrowest_mm);
    return steep;
}

}  // namespace

void ease_steps(const geom::PolygonMesh& usual, geom::PolygonMesh& mesh) {
    const SkinGraph graph = graph_of_skin(usual);
    const Points displacement = mesh.positions - usual.positions;
    const std::vector<double> width = widths(usual, graph, displacement);
    std::vector<int> row(graph.area.size(), -1);
    int rows = 0;
    for (std::size_t v = 0; v < row.size(); ++v)
        if (graph.area[v] > 0) row[v] = rows++;
    if (rows == 0) return;
    std::vector<Eigen::Triplet<double>> entries;
    Points right = Points::Zero(rows, 3);
    for (std::size_t v = 0; v < row.size(); ++v) {
        if (row[v] < 0) continue;
        const double hold = graph.area[v] / (width[v] * width[v]);
        entries.emplace_back(row[v], row[v], hold);
        right.row(row[v]) = hold * displacement.row(static_cast<Eigen::Index>(v));
    }
    for (const auto& [a, b] : graph.edges) {
        const int i = row[static_cast<std::size_t>(a)], j = row[static_cast<std::size_t>(b)];
        entries.emplace_back(i, i, 1.0);
        entries.emplace_back(j, j, 1.0);
        entries.emplace_back(i, j, -1.0);
        entries.emplace_back(j, i, -1.0);
    }
    Eigen::SparseMatrix<double> matrix(rows, rows);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    Points spread(rows, 3);
    for (int k = 0; k < 3; ++k) spread.col(k) = solver.solve(right.col(k));
    for (std::size_t v = 0; v < row.size(); ++v)
        if (row[v] >= 0)
            mesh.positions.row(static_cast<Eigen::Index>(v)) =
                usual.positions.row(static_cast<Eigen::Index>(v)) + spread.row(row[v]);
}

}  // namespace risorius::headmodel
