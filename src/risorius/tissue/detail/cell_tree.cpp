// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/cell_tree.h"

#include <stdexcept>
#include <utility>

namespace risorius::tissue {

namespace {

/// Steps -1, 0, 1 along each axis. `code` runs from 0 to 26; 13 is the cell itself.
std::array<int, 3> step_of(int code) { return {code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1}; }

CellPlace neighbour_of(CellPlace cell, const std::array<int, 3>& step) {
    for (std::size_t axis = 0; axis < 3; ++axis) cell.at[axis] += step[axis];
    return cell;
}

/// True when the child at `corner` of a neighbour in direction `step` touches the cell.
bool touches(const std::array<int, 3>& step, int corner) {
    const std::array<int, 3> high = {corner >> 2 & 1, corner >> 1 & 1, corner & 1};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (step[axis] != 0 && high[axis] != (step[axis] < 0)) return false;
    return true;
}

}  // namespace

CellPlace parent_of(CellPlace cell) {
    --cell.level;
    for (int& at : cell.at) at /= 2;
    return cell;
}

CellPlace child_of(const CellPlace& cell, int corner) {
    return {cell.level + 1,
            {2 * cell.at[0] + (corner >> 2 & 1), 2 * cell.at[1] + (corner >> 1 & 1),
             2 * cell.at[2] + (corner & 1)}};
}

bool CellTree::inside(const CellPlace& cell) const {
    if (cell.level < 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const int at = cell.at[static_cast<std::size_t>(axis)];
        if (at < 0 || at >= (root_.along(axis) - 1) << cell.level) return false;
    }
    return true;
}

bool CellTree::exists(const CellPlace& cell) const {
    return inside(cell) && (cell.level == 0 || is_split(parent_of(cell)));
}

void CellTree::split(const CellPlace& cell) {
    if (!inside(cell)) throw std::invalid_argument("CellTree: a cell lies outside its grid");
    if (is_split(cell)) return;
    // Its children may not meet cells larger than itself. So the cell and all its neighbours must exist first.
    if (cell.level > 0)
        for (int code = 0; code < 27; ++code) {
            const CellPlace neighbour = neighbour_of(cell, step_of(code));
            if (inside(neighbour)) split(parent_of(neighbour));
        }
    split_.insert(cell);
}

bool CellTree::merge(const CellPlace& cell) {
    if (!is_split(cell)) return false;
    for (int code = 0; code < 27; ++code)
        for (int corner = 0; corner < 8; ++corner)
            if (touches(step_of(code), corner) &&
                is_split(child_of(neighbour_of(cell, step_of(code)), corner)))
                return false;
    split_.erase(cell);
    return true;
}

CellMesh CellTree::mesh() const {
    std::vector<CellPlace> leaves, open;
    for (int i = 0; i + 1 < root_.m; ++i)
        for (int j = 0; j + 1 < root_.n; ++j)
            for (int k = 0; k + 1 < root_.o; ++k) open.push_back({0, {i, j, k}});
    while (!open.empty()) {
        const CellPlace cell = open.back();
        open.pop_back();
        if (!is_split(cell)) {
            leaves.push_back(cell);
            continue;
        }
        for (int corner = 0; corner < 8; ++corner) open.push_back(child_of(cell, corner));
    }
    return {root_, std::move(leaves)};
}

}  // namespace risorius::tissue
