// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/cell_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace risorius::tissue {

namespace {

/// A vertex, by its coordinates in units of half the finest cell. In these units, midpoints of edges and faces have integer
/// coordinates too.
using Key = std::uint64_t;
Key key_of(const std::array<std::int64_t, 3>& at) {
    return (static_cast<Key>(at[0]) << 42) | (static_cast<Key>(at[1]) << 21) |
           static_cast<Key>(at[2]);
}

std::array<std::int64_t, 3> corner_of(const CellPlace& place, int deepest,
                                      const std::array<int, 3>& halves) {
    std::array<std::int64_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i)
        at[i] = (2 * static_cast<std::int64_t>(place.at[i]) + halves[i]) << (deepest - place.level);
    return at;
}

}  // namespace

CellMesh::CellMesh(const GridShape& root, std::vector<CellPlace> places) : root_(root) {
    if (root.m < 2 || root.n < 2 || root.o < 2 || places.empty())
        throw std::invalid_argument("CellMesh: a grid of at least 2 nodes per axis is needed");
    if (root.closed && root.m < 3)
        throw std::invalid_argument("CellMesh: a closed grid needs at least 3 nodes along a1");
    for (const CellPlace& place : places) {
        deepest_ = std::max(deepest_, place.level);
        uniform_ = uniform_ && place.level == places.front().level;
    }
    // A coordinate in units of half the finest cell must fit in 21 bits.
    for (int axis = 0; axis < 3; ++axis)
        if (static_cast<std::int64_t>(root.along(axis)) << (deepest_ + 1) >= (1 << 21))
            throw std::invalid_argument("CellMesh: too fine");

    add_cells(std::move(places));

    const auto corner_key = [&](const CellPlace& place, const std::array<int, 3>& halves) {
        std::array<std::int64_t, 3> at = corner_of(place, deepest_, halves);
        if (root_.closed) at[0] %= static_cast<std::int64_t>(root_.cells(0)) << (deepest_ + 1);
        return key_of(at);
    };
    // Vertices are sorted by their coordinates. In a uniform mesh this is the order of the grid.
    std::vector<Key> vertices;
    vertices.reserve(8 * cells_.size());
    for (const Cell& cell : cells_)
        for (int c = 0; c < 8; ++c)
            vertices.push_back(
                corner_key(cell.place, {2 * (c >> 2 & 1), 2 * (c >> 1 & 1), 2 * (c & 1)}));
    const std::vector<Key> corner = vertices;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto find = [&](Key key) {
        const auto at = std::lower_bound(vertices.begin(), vertices.end(), key);
        return at != vertices.end() && *at == key ? static_cast<int>(at - vertices.begin()) : -1;
    };

    // A vertex in the middle of a cell's edge or face depends on the corners of that edge or face.
    std::vector<Hanging> hangs(vertices.size());
    if (!uniform_) {
        for (std::size_t cell = 0; cell < cells_.size(); ++cell)
            for (int code = 0; code < 27; ++code) {
                const std::array<int, 3> halves = {code / 9, code / 3 % 3, code % 3};
                const int middles = (halves[0] == 1) + (halves[1] == 1) + (halves[2] == 1);
                if (middles == 0) continue;
                const int middle = find(corner_key(cells_[cell].place, halves));
                if (middle < 0) continue;
                if (middles == 3) throw std::invalid_argument("CellMesh: cells overlap");
                Hanging hanging;
                for (int c = 0; c < 8; ++c) {
                    const std::array<int, 3> bit = {c >> 2 & 1, c >> 1 & 1, c & 1};
                    bool part = true;
                    for (std::size_t i = 0; i < 3; ++i)
                        part = part && (halves[i] == 1 || halves[i] == 2 * bit[i]);
                    if (part)
                        hanging.node[static_cast<std::size_t>(hanging.count++)] =
                            find(corner[8 * cell + static_cast<std::size_t>(c)]);
                }
                hangs[static_cast<std::size_t>(middle)] = hanging;
            }
    }

    // Nodes come first, then hanging vertices.
    std::vector<int> number(vertices.size(), -1);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        if (hangs[v].count == 0) number[v] = node_count_++;
    int next = node_count_;
    for (std::size_t v = 0; v < vertices.size(); ++v)
        if (hangs[v].count > 0) number[v] = next++;
    hanging_.resize(vertices.size() - static_cast<std::size_t>(node_count_));
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (hangs[v].count == 0) continue;
        Hanging hanging = hangs[v];
        for (int k = 0; k < hanging.count; ++k) {
            int& node = hanging.node[static_cast<std::size_t>(k)];
            node = number[static_cast<std::size_t>(node)];
            if (node >= node_count_)
                throw std::invalid_argument("CellMesh: neighbours differ by more than one level");
        }
        hanging_[static_cast<std::size_t>(number[v] - node_count_)] = hanging;
    }
    for (std::size_t k = 0; k < corner.size(); ++k)
        cells_[k / 8].vertex[k % 8] = number[static_cast<std::size_t>(find(corner[k]))];

    material_.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (int axis = 0; axis < 3; ++axis) {
            const auto units = static_cast<double>(vertices[v] >> (21 * (2 - axis)) & 0x1fffff);
            material_(number[v], axis) =
                units /
                static_cast<double>(static_cast<std::int64_t>(root.cells(axis)) << (deepest_ + 1));
        }
}

// Sorts the cells by their lowest corners.
void CellMesh::add_cells(std::vector<CellPlace> places) {
    const auto lowest = [&](const CellPlace& place) {
        return key_of(corner_of(place, deepest_, {0, 0, 0}));
    };
    std::sort(places.begin(), places.end(),
              [&](const CellPlace& a, const CellPlace& b) { return lowest(a) < lowest(b); });
    double filled = 0;
    for (const CellPlace& place : places) {
        Cell cell;
        cell.place = place;
        for (int axis = 0; axis < 3; ++axis) {
            const int along = root_.cells(axis) << place.level;
            const auto i = static_cast<std::size_t>(axis);
            if (place.at[i] < 0 || place.at[i] >= along)
                throw std::invalid_argument("CellMesh: a cell lies outside its grid");
            cell.size[axis] = 1.0 / along;
            cell.low[axis] = static_cast<double>(place.at[i]) / along;
        }
        filled += cell.size.prod();
        by_place_.emplace_back(place, static_cast<int>(cells_.size()));
        cells_.push_back(cell);
    }
    std::sort(by_place_.begin(), by_place_.end());
    if (std::abs(filled - 1) > 1e-9)
        throw std::invalid_argument("CellMesh: the cells do not fill the cube");
}

CellMesh::Support CellMesh::support(const Cell& cell) const {
    Support support;
    std::vector<std::array<double, 8>> columns;
    const auto add = [&](int corner, int node, double weight) {
        const auto at = std::find(support.node.begin(), support.node.end(), node);
        const auto k = static_cast<std::size_t>(at - support.node.begin());
        if (at == support.node.end()) {
            support.node.push_back(node);
            columns.push_back({});
        }
        columns[k][static_cast<std::size_t>(corner)] += weight;
    };
    for (int c = 0; c < 8; ++c) {
        const int vertex = cell.vertex[static_cast<std::size_t>(c)];
        if (vertex < node_count_) {
            add(c, vertex, 1.0);
            continue;
        }
        support.plain = false;
        const Hanging& hanging = hanging_[static_cast<std::size_t>(vertex - node_count_)];
        for (int k = 0; k < hanging.count; ++k)
            add(c, hanging.node[static_cast<std::size_t>(k)], 1.0 / hanging.count);
    }
    support.weight.resize(8, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
        for (std::size_t c = 0; c < 8; ++c)
            support.weight(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) =
                columns[k][c];
    return support;
}

void CellMesh::spread(Points& vertices) const {
    assert(vertices.rows() == vertex_count());
    for (std::size_t h = 0; h < hanging_.size(); ++h) {
        const Hanging& hanging = hanging_[h];
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (int k = 0; k < hanging.count; ++k)
            sum += vertices.row(hanging.node[static_cast<std::size_t>(k)]);
        vertices.row(node_count_ + static_cast<Eigen::Index>(h)) = sum / hanging.count;
    }
}

void CellMesh::spread(solve::PaddedPoints& vertices) const {
    for (std::size_t h = 0; h < hanging_.size(); ++h) {
        const Hanging& hanging = hanging_[h];
        solve::Lanes sum{};
        for (int k = 0; k < hanging.count; ++k)
            sum += vertices[hanging.node[static_cast<std::size_t>(k)]];
        vertices[node_count_ + static_cast<int>(h)] = sum * (1.0 / hanging.count);
    }
}

void CellMesh::gather(solve::PaddedPoints& vertices) const {
    for (std::size_t h = 0; h < hanging_.size(); ++h) {
        const Hanging& hanging = hanging_[h];
        const solve::Lanes fraction =
            vertices[node_count_ + static_cast<int>(h)] * (1.0 / hanging.count);
        for (int k = 0; k < hanging.count; ++k)
            vertices[hanging.node[static_cast<std::size_t>(k)]] += fraction;
    }
}

int CellMesh::cell_at(const Vec3& a) const {
    for (int level = 0; level <= deepest_; ++level) {
        CellPlace place{level, {}};
        for (int axis = 0; axis < 3; ++axis) {
            const int along = root_.cells(axis) << level;
            place.at[static_cast<std::size_t>(axis)] =
                std::clamp(static_cast<int>(std::floor(a[axis] * along)), 0, along - 1);
        }
        const auto found =
            std::lower_bound(by_place_.begin(), by_place_.end(), std::make_pair(place, 0));
        if (found != by_place_.end() && found->first == place) return found->second;
    }
    assert(!"the cells fill the cube");
    return -1;
}

Vec3 CellMesh::interpolate(const Points& vertices, const Vec3& a) const {
    const Cell& cell = cells_[static_cast<std::size_t>(cell_at(a))];
    const auto weight =
        trilinear_weights((a - cell.low).cwiseQuotient(cell.size).cwiseMax(0.0).cwiseMin(1.0));
    Vec3 sum = Vec3::Zero();
    for (std::size_t c = 0; c < 8; ++c) sum += weight[c] * vertices.row(cell.vertex[c]).transpose();
    return sum;
}

CellMesh uniform_cells(const GridShape& grid) {
    std::vector<CellPlace> cells;
    for (int i = 0; i < grid.cells(0); ++i)
        for (int j = 0; j + 1 < grid.n; ++j)
            for (int k = 0; k + 1 < grid.o; ++k) cells.push_back({0, {i, j, k}});
    return {grid, std::move(cells)};
}

std::array<double, 8> trilinear_weights(const Vec3& s) {
    std::array<double, 8> weight{};
    for (std::size_t c = 0; c < 8; ++c)
        weight[c] = ((c >> 2 & 1) ? s[0] : 1 - s[0]) * ((c >> 1 & 1) ? s[1] : 1 - s[1]) *
                    ((c & 1) ? s[2] : 1 - s[2]);
    return weight;
}

}  // namespace risorius::tissue
