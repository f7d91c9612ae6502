// SPDX-License-Identifier: MIT
/// \file
/// Trilinear cells over material coordinates a in [0,1]^3: a grid of root cells, each perhaps split into eight, those
/// again, and so on. Neighbours differ by one level at most, across faces, edges and corners alike.
///
///   vertex   a corner of a cell. The first node_count() vertices are nodes; the others hang:
///   hanging  in the middle of a bigger neighbour's edge or face, hence the mean of 2 or 4 nodes, so that the body has no gap
///   x_full = P x,  gradient = P^T gradient_full,  P = identity on nodes, 1/2 or 1/4 on hanging vertices
///
/// A closed grid's cells go round along a1: its last cells lie between the last nodes and the first.
///
/// Hanging vertices as constraints: Babuska & Rheinboldt 1978; Bangerth, Hartmann & Kanschat 2007, ACM TOMS 33(4).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// Place of a cell: the root grid halved `level` times is numbered from 0 along each axis.
struct CellPlace {
    int level = 0;
    std::array<int, 3> at = {0, 0, 0};

    auto operator<=>(const CellPlace&) const = default;
};

class CellMesh {
  public:
    struct Cell {
        CellPlace place;
        Vec3 low = Vec3::Zero();   ///< material coordinates of its lowest corner
        Vec3 size = Vec3::Zero();  ///< h1, h2, h3
        std::array<int, 8>
            vertex{};  ///< corner 4 b1 + 2 b2 + b3, b = 1 on the high side of that axis
    };
    struct Hanging {
        int count = 0;  ///< 2 or 4
        std::array<int, 4> node{};
    };
    /// What of a cell's corners depends on its nodes: corner c is sum of weight(c, k) node[k].
    struct Support {
        std::vector<int> node;                                             ///< distinct, K of them
        Eigen::Matrix<double, 8, Eigen::Dynamic, Eigen::RowMajor> weight;  ///< 8 x K
        bool plain = true;  ///< the corners are the nodes, in order
    };

    /// Nodes of a uniform mesh are numbered as those of the grid. Throws std::invalid_argument unless the cells fill the
    /// cube without overlap and neighbours differ by one level at most.
    CellMesh(const GridShape& root, std::vector<CellPlace> cells);

    const GridShape& root() const { return root_; }
    const std::vector<Cell>& cells() const { return cells_; }
    const std::vector<Hanging>& hanging() const { return hanging_; }  ///< vertex node_count() + k
    int node_count() const { return node_count_; }
    int vertex_count() const { return static_cast<int>(material_.rows()); }
    const Points& material_coordinates() const { return material_; }  ///< of vertices, V x 3
    int deepest_level() const { return deepest_; }
    bool uniform() const { return uniform_; }  ///< all cells of one level

    Support support(const Cell& cell) const;

    /// Writes the hanging rows of `vertices` (V rows, nodes first).
    void spread(Points& vertices) const;
    void spread(solve::PaddedPoints& vertices) const;
    /// Adds the hanging rows to those of their nodes: the transpose of spread().
    void gather(solve::PaddedPoints& vertices) const;

    /// Index of the cell that holds material coordinates `a` (clamped to the cube); on a border, the higher cell.
    int cell_at(const Vec3& a) const;
    /// Value at `a` of a field over vertices, trilinear within the cell.
    Vec3 interpolate(const Points& vertices, const Vec3& a) const;

  private:
    void add_cells(std::vector<CellPlace> places);
    GridShape root_;
    std::vector<Cell>
        cells_;  ///< ascending by lowest corner, so that neighbours are near in memory
    std::vector<Hanging> hanging_;
    Points material_;
    int node_count_ = 0;
    int deepest_ = 0;
    bool uniform_ = true;
    std::vector<std::pair<CellPlace, int>> by_place_;  ///< sorted
};

/// One cell per grid cell.
CellMesh uniform_cells(const GridShape& grid);

/// Trilinear weights of the eight corners at `s` in [0,1]^3 of a cell.
std::array<double, 8> trilinear_weights(const Vec3& s);

}  // namespace risorius::tissue
