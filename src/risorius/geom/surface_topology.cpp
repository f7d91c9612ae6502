// SPDX-License-Identifier: MIT
#include "risorius/geom/surface_topology.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace risorius::geom {

SurfaceEdges surface_edges(const Triangles& triangles) {
    struct Side {
        std::array<int, 2> vertices;
        int triangle, side;
    };
    std::vector<Side> sides;
    sides.reserve(static_cast<std::size_t>(triangles.rows()) * 3);
    for (int t = 0; t < static_cast<int>(triangles.rows()); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax({triangles(t, k), triangles(t, (k + 1) % 3)});
            sides.push_back({{low, high}, t, k});
        }
    // Stable, so that triangles at an edge stay in ascending order.
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& a, const Side& b) { return a.vertices < b.vertices; });

    SurfaceEdges edges;
    edges.triangle.reserve(sides.size());
    edges.side.reserve(sides.size());
    for (const Side& side : sides) {
        if (edges.vertices.empty() || edges.vertices.back() != side.vertices) {
            edges.vertices.push_back(side.vertices);
            edges.triangle_begin.push_back(edges.triangle_begin.back());
        }
        ++edges.triangle_begin.back();
        edges.triangle.push_back(side.triangle);
        edges.side.push_back(side.side);
    }
    return edges;
}

Triangles triangle_neighbours(const SurfaceEdges& edges, int triangle_count) {
    Triangles neighbours = Triangles::Constant(triangle_count, 3, -1);
    for (int e = 0; e < edges.count(); ++e) {
        if (edges.triangle_count(e) != 2) continue;
        const int i = edges.triangle_begin[e], j = i + 1;
        neighbours(edges.triangle[i], edges.side[i]) = edges.triangle[j];
        neighbours(edges.triangle[j], edges.side[j]) = edges.triangle[i];
    }
    return neighbours;
}

std::vector<std::vector<int>> boundary_loops(const Triangles& triangles,
                                             const SurfaceEdges& edges) {
    // Directed boundary edges by their start. The lowest end is taken first.
    std::map<int, std::vector<int>> ends;
    for (int e = 0; e < edges.count(); ++e) {
        if (edges.triangle_count(e) != 1) continue;
        const int i = edges.triangle_begin[e];
        const int t = edges.triangle[i], k = edges.side[i];
        ends[triangles(t, k)].push_back(triangles(t, (k + 1) % 3));
    }
    for (auto& [start, list] : ends) std::sort(list.rbegin(), list.rend());

    std::vector<std::vector<int>> loops;
    // Where a vertex stands in the chain, -1: not in it. A boundary can be as long as the mesh has vertices.
    std::vector<int> place(triangles.rows() > 0 ? triangles.maxCoeff() + 1 : 0, -1);
    for (auto& [start, list] : ends) {
        while (!list.empty()) {
            // Walks until the chain meets itself, cuts that loop off, and continues with the rest of the chain.
            std::vector<int> chain{start};
            place[start] = 0;
            while (!chain.empty()) {
                const auto out = ends.find(chain.back());
                if (out == ends.end() || out->second.empty()) {
                    // An open chain; it occurs only where winding is inconsistent.
                    place[chain.back()] = -1;
                    chain.pop_back();
                    continue;
                }
                const int next = out->second.back();
                out->second.pop_back();
                if (place[next] < 0) {
                    place[next] = static_cast<int>(chain.size());
                    chain.push_back(next);
                    continue;
                }
                const auto met = chain.begin() + place[next];
                std::vector<int> loop(met, chain.end());
                for (auto cut = met + 1; cut != chain.end(); ++cut) place[*cut] = -1;
                chain.erase(met + 1, chain.end());
                std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
                loops.push_back(std::move(loop));
                if (chain.size() == 1) break;
            }
            place[start] = -1;
        }
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

SurfacePieces surface_pieces(const Triangles& triangles, int vertex_count) {
    std::vector<int> parent(static_cast<std::size_t>(vertex_count));
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (long t = 0; t < triangles.rows(); ++t)
        for (int k = 1; k < 3; ++k) {
            const auto [low, high] = std::minmax({root(triangles(t, 0)), root(triangles(t, k))});
            parent[high] = low;
        }

    SurfacePieces pieces;
    pieces.of_vertex.assign(static_cast<std::size_t>(vertex_count), -1);
    std::vector<int> piece_of_root(static_cast<std::size_t>(vertex_count), -1);
    for (long t = 0; t < triangles.rows(); ++t) {
        int& piece = piece_of_root[root(triangles(t, 0))];
        if (piece < 0) {
            piece = pieces.count();
            pieces.triangle_count.push_back(0);
        }
        ++pieces.triangle_count[piece];
        pieces.of_triangle.push_back(piece);
        for (int k = 0; k < 3; ++k) pieces.of_vertex[triangles(t, k)] = piece;
    }
    return pieces;
}

VertexNeighbours vertex_neighbours(const SurfaceEdges& edges, int vertex_count) {
    VertexNeighbours out;
    out.begin.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
    for (const auto& [a, b] : edges.vertices) {
        ++out.begin[a + 1];
        ++out.begin[b + 1];
    }
    std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
    out.vertex.resize(static_cast<std::size_t>(out.begin.back()));
    std::vector<int> next(out.begin.begin(), out.begin.end() - 1);
    for (const auto& [a, b] : edges.vertices) {
        out.vertex[next[a]++] = b;
        out.vertex[next[b]++] = a;
    }
    for (int v = 0; v < vertex_count; ++v)
        std::sort(out.vertex.begin() + out.begin[v], out.vertex.begin() + out.begin[v + 1]);
    return out;
}

std::vector<Hinge> surface_hinges(const Triangles& triangles, const SurfaceEdges& edges) {
    std::vector<Hinge> hinges;
    for (int e = 0; e < edges.count(); ++e) {
        if (edges.triangle_count(e) != 2) continue;
        const int i = edges.triangle_begin[e];
        const int t0 = edges.triangle[i], t1 = edges.triangle[i + 1];
        const int k0 = edges.side[i], k1 = edges.side[i + 1];
        // Both run in the same direction: one is flipped.
        if (triangles(t0, k0) == triangles(t1, k1)) continue;
        hinges.push_back({{triangles(t0, k0), triangles(t0, (k0 + 1) % 3)},
                          {triangles(t0, (k0 + 2) % 3), triangles(t1, (k1 + 2) % 3)},
                          {t0, t1}});
    }
    return hinges;
}

void vertex_normals(const Points& positions, const Triangles& triangles, Points& normals) {
    normals.setZero(positions.rows(), 3);
    for (long t = 0; t < triangles.rows(); ++t) {
        const int a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
        const Vec3 pa = positions.row(a), pb = positions.row(b), pc = positions.row(c);
        const Vec3 doubled_area = (pb - pa).cross(pc - pa);
        for (const int v : {a, b, c}) normals.row(v) += doubled_area.transpose();
    }
    for (long v = 0; v < normals.rows(); ++v) {
        const double length = normals.row(v).norm();
        if (length > 0) normals.row(v) /= length;
    }
}

Points vertex_normals(const Points& positions, const Triangles& triangles) {
    Points normals;
    vertex_normals(positions, triangles, normals);
    return normals;
}

}  // namespace risorius::geom
