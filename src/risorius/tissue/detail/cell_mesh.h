// SPDX-License-Identifier: MIT
/// \file
/// Trilinear cells over material coordinates a in [0,1]^3: a grid of root cells, each of which may be split into eight,
/// recursively. Neighbours across faces, edges and corners differ by one level at most.
///
///   vertex   a corner of a cell. The first node_count() vertices are nodes, the others are hanging vertices
///   hanging  a vertex in the middle of an edge or face of a larger neighbour: the mean of 2 or 4 nodes (no gaps)
///   x_full = P x,  gradient = P^T gradient_full;  full: all vertices;  P = identity on nodes, 1/2 or 1/4 on hanging vertices
///
/// In a closed grid the last cells along a1 connect the last nodes with the first.
///
/// Sources for constraints at hanging vertices: Babuska & Rheinboldt 1978; Bangerth, Hartmann & Kanschat 2007, ACM TOMS 33(4).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// Address of a cell: its level, and its index along each axis in the root grid whose cells were halved `level` times.
struct CellPlace {
    int level = 0;
    std::array<int, 3> at = {0, 0, 0};

    auto operator<=>(const CellPlace&) const = default;
};

/// A mesh of cells with its nodes and hanging vertices.
class CellMesh {
  public:
    struct Cell {
        CellPlace place;
        Vec3 low = Vec3::Zero();   ///< material coordinates of its lowest corner
        Vec3 size = Vec3::Zero();  ///< h1, h2, h3
        /// Corner 4 b1 + 2 b2 + b3; b = 1 on the high side of the axis.
        std::array<int, 8> vertex{};
    };
    struct Hanging {
        int count = 0;  ///< 2 or 4
        std::array<int, 4> node{};
    };
    /// The nodes that a cell's corners depend on: corner c is at sum_k weight(c, k) x[node[k]].
    struct Support {
        std::vector<int> node;                                             ///< distinct, K of them
        Eigen::Matrix<double, 8, Eigen::Dynamic, Eigen::RowMajor> weight;  ///< 8 x K
        bool plain = true;  ///< true when the corners are the nodes, in order
    };

    /// In a uniform mesh, nodes are numbered as in the grid. Throws std::invalid_argument unless the cells fill the cube
    /// without overlap and neighbours differ by one level at most, or when the mesh is too fine.
    CellMesh(const GridShape& root, std::vector<CellPlace> cells);

    const GridShape& root() const { return root_; }
    const std::vector<Cell>& cells() const { return cells_; }
    const std::vector<Hanging>& hanging() const { return hanging_; }  ///< vertex node_count() + k
    int node_count() const { return node_count_; }
    int vertex_count() const { return static_cast<int>(material_.rows()); }
    const Points& material_coordinates() const { return material_; }  ///< of vertices, V x 3
    int deepest_level() const { return deepest_; }
    bool uniform() const { return uniform_; }  ///< all cells have the same level

    Support support(const Cell& cell) const;

    /// Computes the hanging rows of `vertices` (V rows, nodes first) from the rows of the nodes.
    void spread(Points& vertices) const;
    void spread(solve::PaddedPoints& vertices) const;
    /// Adds the hanging rows to the rows of their nodes: the transpose of spread().
    void gather(solve::PaddedPoints& vertices) const;

    /// Index of the cell that contains material coordinates `a`, clamped to the cube. On the border between two cells it is the
    /// one with the larger coordinates.
    int cell_at(const Vec3& a) const;
    /// Value at `a` of a field over the vertices, V x 3, trilinear within the cell.
    Vec3 interpolate(const Points& vertices, const Vec3& a) const;

  private:
    void add_cells(std::vector<CellPlace> places);
    GridShape root_;
    std::vector<Cell> cells_;  ///< sorted by lowest corner, so that neighbours are near in memory
    std::vector<Hanging> hanging_;
    Points material_;
    int node_count_ = 0;
    int deepest_ = 0;
    bool uniform_ = true;
    std::vector<std::pair<CellPlace, int>> by_place_;  ///< sorted
};

/// One cell per grid cell.
CellMesh uniform_cells(const GridShape& grid);

/// Trilinear weights of the eight corners at the point `s` of a cell, s in [0,1]^3.
std::array<double, 8> trilinear_weights(const Vec3& s);

}  // namespace risorius::tissue
