// SPDX-License-Identifier: MIT
/// \file
/// Topology of a triangle surface: edges, neighbours, boundary loops, pieces, hinges and vertex normals.
///
/// Corner k of a triangle is its k-th vertex; side k runs from corner k to corner k + 1 (mod 3). Results are sorted by index,
/// so the same triangles always give the same lists.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::geom {

/// Undirected edges, sorted by their vertices, and the triangles at each edge.
struct SurfaceEdges {
    std::vector<std::array<int, 2>> vertices;  ///< E, smaller index first
    /// E + 1; the triangles at edge e are [triangle_begin[e], triangle_begin[e+1])
    std::vector<int> triangle_begin{0};
    std::vector<int> triangle;  ///< ascending at each edge
    /// For each entry of `triangle`, the side of that triangle that the edge is
    std::vector<int> side;

    int count() const { return static_cast<int>(vertices.size()); }
    int triangle_count(int edge) const { return triangle_begin[edge + 1] - triangle_begin[edge]; }
};
SurfaceEdges surface_edges(const Triangles& triangles);

/// Returns F x 3: column k is the triangle across side k; -1 at a boundary and where more than two triangles meet.
Triangles triangle_neighbours(const SurfaceEdges& edges, int triangle_count);

/// Returns the boundary loops, closed chains of vertices on boundary edges. They run in the direction of their triangles, with
/// the surface to the left. Each starts at its smallest vertex, and loops are sorted by that vertex. Where several boundaries
/// touch in one vertex, the chain is cut there, so that no loop visits a vertex twice.
std::vector<std::vector<int>> boundary_loops(const Triangles& triangles, const SurfaceEdges& edges);

/// The connected pieces of a surface, in the order of their first triangles. Triangles with a common vertex belong to the same
/// piece.
struct SurfacePieces {
    std::vector<int> of_triangle;     ///< F
    std::vector<int> of_vertex;       ///< V; -1 for a vertex that no triangle uses
    std::vector<int> triangle_count;  ///< per piece

    int count() const { return static_cast<int>(triangle_count.size()); }
};
SurfacePieces surface_pieces(const Triangles& triangles, int vertex_count);

/// The neighbours of every vertex (those one edge away) in ascending order. Those of v are vertex[i] for i in [begin[v], begin[v
/// + 1]).
struct VertexNeighbours {
    std::vector<int> begin{0};
    std::vector<int> vertex;
};
VertexNeighbours vertex_neighbours(const SurfaceEdges& edges, int vertex_count);

/// Two triangles with a common edge, at which the surface bends. `edge`: the vertices of the edge. `wing`: the third vertex of
/// each triangle. (edge[0], edge[1], wing[0]) is wound like the surface.
struct Hinge {
    std::array<int, 2> edge;
    std::array<int, 2> wing;
    std::array<int, 2> triangle;
};
/// Returns one hinge for each edge with exactly two triangles of consistent winding, in the order of the edges.
std::vector<Hinge> surface_hinges(const Triangles& triangles, const SurfaceEdges& edges);

/// Returns unit normals, V x 3: the area-weighted mean of the normals of the triangles of a vertex; zero where they have no area.
/// The sum is made in the order of the triangles.
Points vertex_normals(const Points& positions, const Triangles& triangles);
void vertex_normals(const Points& positions, const Triangles& triangles,
                    Points& normals);  ///< allocates nothing when `normals` has the right size

}  // namespace risorius::geom
