// SPDX-License-Identifier: MIT
// Symbolic factorisation column by column: the rows of a column are those of A and those of its children in the elimination tree
// (Davis 2006, Direct Methods for Sparse Linear Systems, chapter 4).
#include "risorius/solve/detail/simplicial_panels.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace risorius::solve::detail {

namespace {

/// Columns first .. last, and the rows below them.
struct Columns {
    int first = 0, last = 0;
    std::vector<int> below;
    long used = 0;  ///< entries that are not zero

    long width() const { return last - first + 1; }
    long stored() const {
        return width() * (width() + 1) / 2 + width() * static_cast<long>(below.size());
    }
};

/// The rows below the diagonal of each column of A in the given order.
std::vector<std::vector<int>> ordered_rows(const Eigen::SparseMatrix<double>& A,
                                           const std::vector<int>& order) {
    std::vector<int> position(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        position[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    std::vector<std::vector<int>> rows(order.size());
    for (int j = 0; j < A.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
            const auto [low, high] = std::minmax(position[static_cast<std::size_t>(it.row())],
                                                 position[static_cast<std::size_t>(j)]);
            if (low != high) rows[static_cast<std::size_t>(low)].push_back(high);
        }
    return rows;
}

/// Whether two panels are stored as one: the limits are those of CHOLMOD.
bool worth_joining(const Columns& left, const Columns& right, const Columns& joined) {
    if (left.below.empty() || left.below.front() != right.first) return false;
    const long width = joined.width();
    const double zeros =
        1 - static_cast<double>(joined.used) / static_cast<double>(joined.stored());
    return width <= 4 || zeros == 0 || (width <= 16 && zeros < 0.8) ||
           (width <= 48 && zeros < 0.1) || zeros < 0.05;
}

Columns joined_columns(const Columns& left, const Columns& right) {
    return {left.first, right.last, right.below, left.used + right.used};
}

/// The largest panels that store no zeros.
std::vector<Columns> nested_columns(std::vector<std::vector<int>> rows) {
    std::vector<Columns> panels;
    for (int j = 0; j < static_cast<int>(rows.size()); ++j) {
        std::vector<int>& own = rows[static_cast<std::size_t>(j)];
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        // The parent of a column is its first row below.
        if (own.size() > 1) {
            std::vector<int>& parent = rows[static_cast<std::size_t>(own.front())];
            parent.insert(parent.end(), own.begin() + 1, own.end());
        }
        Columns panel{j, j, std::move(own), 0};
        panel.used = panel.stored();
        if (!panels.empty() && !panels.back().below.empty() && panels.back().below.front() == j &&
            panels.back().below.size() == panel.below.size() + 1)
            panels.back() = joined_columns(panels.back(), panel);
        else
            panels.push_back(std::move(panel));
    }
    return panels;
}

}  // namespace

PanelPattern simplicial_panels(const Eigen::SparseMatrix<double>& A, std::vector<int> order) {
    std::vector<Columns> panels;
    for (Columns& next : nested_columns(ordered_rows(A, order))) {
        Columns panel = std::move(next);
        while (!panels.empty()) {
            Columns both = joined_columns(panels.back(), panel);
            if (!worth_joining(panels.back(), panel, both)) break;
            panel = std::move(both);
            panels.pop_back();
        }
        panels.push_back(std::move(panel));
    }
    PanelPattern out;
    out.super.reserve(panels.size() + 1);
    out.row_begin = {0};
    for (const Columns& panel : panels) {
        out.super.push_back(panel.first);
        for (int j = panel.first; j <= panel.last; ++j) out.row.push_back(j);
        out.row.insert(out.row.end(), panel.below.begin(), panel.below.end());
        out.row_begin.push_back(static_cast<int>(out.row.size()));
    }
    out.super.push_back(static_cast<int>(order.size()));
    out.order = std::move(order);
    return out;
}

}  // namespace risorius::solve::detail
