// SPDX-License-Identifier: MIT
#include "risorius/geom/weld.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "risorius/core/counter_rng.h"
#include "risorius/geom/surface_topology.h"

namespace risorius::geom {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        // Its bits are mixed: with sums or products, cells at equal distances on a line could all share a bucket.
        CounterRng mixed;
        for (const std::int64_t part : cell) mixed.at(static_cast<std::uint64_t>(part));
        return static_cast<std::size_t>(mixed.bits());
    }
};

/// The vertices kept so far, in cells no smaller than the tolerance. Every vertex within the tolerance lies in the 27 cells
/// around.
class NearVertices {
  public:
    NearVertices(const Points& positions, double tolerance)
        : positions_(positions),
          tolerance_(tolerance),
          // For exact equality a cell only needs to be small, but its integer coordinates must not overflow.
          cell_size_(std::max(tolerance, 1e-9)) {}

    /// The nearest kept vertex within the tolerance; -1 when there is none.
    int find(int vertex) const {
        const Vec3 p = positions_.row(vertex).transpose();
        const Cell centre = cell_of(p);
        int best = -1;
        double best_squared = tolerance_ * tolerance_;
        for (std::int64_t i = -1; i <= 1; ++i)
            for (std::int64_t j = -1; j <= 1; ++j)
                for (std::int64_t k = -1; k <= 1; ++k) {
                    const auto cell = kept_.find({centre[0] + i, centre[1] + j, centre[2] + k});
                    if (cell == kept_.end()) continue;
                    for (const int other : cell->second) {
                        const double squared =
                            (positions_.row(other).transpose() - p).squaredNorm();
                        if (squared < best_squared ||
                            (squared == best_squared && (best < 0 || other < best))) {
                            best = other;
                            best_squared = squared;
                        }
                    }
                }
        return best;
    }

    void keep(int vertex) { kept_[cell_of(positions_.row(vertex).transpose())].push_back(vertex); }

  private:
    Cell cell_of(const Vec3& p) const {
        Cell cell;
        for (int k = 0; k < 3; ++k) {
            const double c = std::floor(p(k) / cell_size_);
            cell[k] = c > -kFarthestCell && c < kFarthestCell ? static_cast<std::int64_t>(c)
                      : c > 0                                 ? kOutermost
                                                              : -kOutermost;
        }
        return cell;
    }

    // Positions beyond share the outermost cells. A head has at most some 1e9 cells along an axis.
    static constexpr double kFarthestCell = 4e18;
    static constexpr std::int64_t kOutermost = 4'000'000'000'000'000'000;

    const Points& positions_;
    double tolerance_, cell_size_;
    std::unordered_map<Cell, std::vector<int>, CellHash> kept_;
};

std::vector<bool> boundary_vertices(const Triangles& triangles, int vertex_count) {
    std::vector<bool> boundary(static_cast<std::size_t>(vertex_count), false);
    const SurfaceEdges edges = surface_edges(triangles);
    for (int e = 0; e < edges.count(); ++e)
        if (edges.triangle_count(e) == 1)
            for (const int v : edges.vertices[e]) boundary[v] = true;
    return boundary;
}

}  // namespace

int WeldedSurface::joined_count() const {
    const auto used = std::count_if(welded_of_vertex.begin(), welded_of_vertex.end(),
                                    [](int w) { return w >= 0; });
    return static_cast<int>(used) - static_cast<int>(first_vertex.size());
}

WeldedSurface weld(const Points& positions, const Triangles& triangles,
                   const WeldOptions& options) {
    assert(options.tolerance_m >= 0);
    const int vertex_count = static_cast<int>(positions.rows());
    std::vector<bool> used(static_cast<std::size_t>(vertex_count), false);
    for (long t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) used[triangles(t, k)] = true;
    const std::vector<bool> may_join =
        options.boundary_only ? boundary_vertices(triangles, vertex_count) : used;

    WeldedSurface out;
    out.welded_of_vertex.assign(static_cast<std::size_t>(vertex_count), -1);
    NearVertices near(positions, options.tolerance_m);
    for (int v = 0; v < vertex_count; ++v) {
        if (!used[v]) continue;
        const int earlier = may_join[v] ? near.find(v) : -1;
        if (earlier >= 0) {
            out.welded_of_vertex[v] = out.welded_of_vertex[earlier];
            continue;
        }
        if (may_join[v]) near.keep(v);
        out.welded_of_vertex[v] = static_cast<int>(out.first_vertex.size());
        out.first_vertex.push_back(v);
    }

    out.positions.resize(static_cast<long>(out.first_vertex.size()), 3);
    for (std::size_t w = 0; w < out.first_vertex.size(); ++w)
        out.positions.row(static_cast<long>(w)) = positions.row(out.first_vertex[w]);
    out.triangles.resize(triangles.rows(), 3);
    for (long t = 0; t < triangles.rows(); ++t) {
        const int a = out.welded_of_vertex[triangles(t, 0)],
                  b = out.welded_of_vertex[triangles(t, 1)],
                  c = out.welded_of_vertex[triangles(t, 2)];
        if (a == b || b == c || c == a) continue;
        out.triangles.row(static_cast<long>(out.source_triangle.size())) << a, b, c;
        out.source_triangle.push_back(static_cast<int>(t));
    }
    out.triangles.conservativeResize(static_cast<long>(out.source_triangle.size()), 3);
    return out;
}

void spread(const WeldedSurface& surface, const Points& welded, Points& out) {
    for (std::size_t v = 0; v < surface.welded_of_vertex.size(); ++v)
        if (const int w = surface.welded_of_vertex[v]; w >= 0)
            out.row(static_cast<long>(v)) = welded.row(w);
}

}  // namespace risorius::geom
