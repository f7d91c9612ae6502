// SPDX-License-Identifier: MIT
// Left-looking supernodal factorisation (Ng & Peyton 1993; Chen, Davis, Hager & Rajamanickam 2008). Ordering and symbolic
// analysis come from CHOLMOD.
#include "risorius/solve/supernodal_cholesky.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "risorius/solve/detail/dense_panels.h"
#include "risorius/solve/detail/nested_dissection.h"

namespace risorius::solve {

struct SupernodalCholesky::Impl {
    std::vector<int> outer, inner;  ///< pattern of the ordered matrix
    std::vector<int> order;         ///< row of A at each position
    std::vector<int> super;         ///< first column of each panel, then n
    std::vector<int> row_begin;     ///< where each panel begins in `row`
    std::vector<long> begin;        ///< where each panel begins in `value`, column-major
    std::vector<int> row;      ///< rows of the panels, ascending; a panel's own columns come first
    std::vector<int> owner;    ///< panel of each column
    std::vector<long> target;  ///< index in `value` of each entry of A
    std::vector<double> value;
    std::size_t tallest = 0;
    long orderings = 0;
    // Scratch
    std::vector<double> update;
    std::vector<int> local, head, next, from;
    mutable std::vector<double> right, gathered;

    int panels() const { return static_cast<int>(super.size()) - 1; }
    int height(int p) const {
        return row_begin[static_cast<std::size_t>(p) + 1] - row_begin[static_cast<std::size_t>(p)];
    }
    bool same_pattern(const Eigen::SparseMatrix<double>& A) const {
        return outer.size() == static_cast<std::size_t>(A.cols()) + 1 &&
               inner.size() == static_cast<std::size_t>(A.nonZeros()) &&
               std::equal(outer.begin(), outer.end(), A.outerIndexPtr()) &&
               std::equal(inner.begin(), inner.end(), A.innerIndexPtr());
    }
    void analyse(const Eigen::SparseMatrix<double>& A, int block);
    bool factorise_panels();
};

void SupernodalCholesky::Impl::analyse(const Eigen::SparseMatrix<double>& A, int block) {
    detail::PanelPattern pattern = detail::panel_pattern(A, block);
    order = std::move(pattern.order);
    super = std::move(pattern.super);
    row_begin = std::move(pattern.row_begin);
    row = std::move(pattern.row);
    const auto n = static_cast<std::size_t>(A.rows());
    begin.assign(1, 0);
    owner.resize(n);
    tallest = 0;
    for (int p = 0; p < panels(); ++p) {
        const auto at = static_cast<std::size_t>(p);
        for (int c = super[at]; c < super[at + 1]; ++c) owner[static_cast<std::size_t>(c)] = p;
        begin.push_back(begin.back() + static_cast<long>(height(p)) * (super[at + 1] - super[at]));
        tallest = std::max(tallest, static_cast<std::size_t>(height(p)));
    }
    std::vector<int> place(n);
    for (std::size_t i = 0; i < n; ++i)
        place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    target.clear();
    for (int j = 0; j < A.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
            const int a = place[static_cast<std::size_t>(it.row())],
                      b = place[static_cast<std::size_t>(j)];
            const int column = std::min(a, b);
            const auto p = static_cast<std::size_t>(owner[static_cast<std::size_t>(column)]);
            const auto first = row.begin() + row_begin[p], last = row.begin() + row_begin[p + 1];
            const auto found = std::lower_bound(first, last, std::max(a, b));
            target.push_back(begin[p] +
                             static_cast<long>(column - super[p]) * height(static_cast<int>(p)) +
                             (found - first));
        }
    outer.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
    inner.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    ++orderings;
}

bool SupernodalCholesky::Impl::factorise_panels() {
    const int count = panels();
    local.resize(owner.size());
    // Lists of the panels that update this one next.
    head.assign(static_cast<std::size_t>(count), -1);
    next.assign(static_cast<std::size_t>(count), -1);
    from.assign(static_cast<std::size_t>(count), 0);  // rows of a panel that have been used
    for (int s = 0; s < count; ++s) {
        const auto at = static_cast<std::size_t>(s);
        const int first = super[at], end = super[at + 1], width = end - first, tall = height(s);
        const int* const rows = row.data() + row_begin[at];
        double* const panel = value.data() + begin[at];
        for (int i = 0; i < tall; ++i) local[static_cast<std::size_t>(rows[i])] = i;

        for (int d = head[at], follower; d >= 0; d = follower) {
            const auto by = static_cast<std::size_t>(d);
            follower = next[by];
            const int* const its_rows = row.data() + row_begin[by];
            const int its_height = height(d), its_width = super[by + 1] - super[by];
            const int begun = from[by];
            int used = begun;
            while (used < its_height && its_rows[used] < end) ++used;
            const int m = its_height - begun, n = used - begun;
            const double* const source = value.data() + begin[by] + begun;
            update.resize(static_cast<std::size_t>(m) * static_cast<std::size_t>(n));
            detail::product(source, its_height, source, its_height, m, n, its_width, update.data());
            for (int j = 0; j < n; ++j) {
                double* const column =
                    panel + static_cast<long>(its_rows[begun + j] - first) * tall;
                const double* const change = update.data() + static_cast<long>(j) * m;
                for (int i = j; i < m; ++i)
                    column[local[static_cast<std::size_t>(its_rows[begun + i])]] -= change[i];
            }
            from[by] = used;
            if (used < its_height) {
                const auto to =
                    static_cast<std::size_t>(owner[static_cast<std::size_t>(its_rows[used])]);
                next[by] = head[to];
                head[to] = d;
            }
        }
        if (!detail::factorise_panel(panel, tall, width, update)) return false;
        if (width < tall) {
            from[at] = width;
            const auto to = static_cast<std::size_t>(owner[static_cast<std::size_t>(rows[width])]);
            next[at] = head[to];
            head[to] = s;
        }
    }
    return true;
}

SupernodalCholesky::SupernodalCholesky() : impl_(std::make_unique<Impl>()) {}
SupernodalCholesky::~SupernodalCholesky() = default;
SupernodalCholesky::SupernodalCholesky(SupernodalCholesky&&) noexcept = default;
SupernodalCholesky& SupernodalCholesky::operator=(SupernodalCholesky&&) noexcept = default;

bool SupernodalCholesky::factorise(const Eigen::SparseMatrix<double>& A, int block) {
    assert(A.rows() == A.cols() && A.isCompressed() && A.rows() % block == 0);
    Impl& own = *impl_;
    if (!own.same_pattern(A)) own.analyse(A, block);
    own.value.assign(static_cast<std::size_t>(own.begin.back()), 0.0);
    const double* const a = A.valuePtr();
    for (std::size_t i = 0; i < own.target.size(); ++i)
        own.value[static_cast<std::size_t>(own.target[i])] += a[i];
    return own.factorise_panels();
}

void SupernodalCholesky::solve(const double* b, double* x) const {
    const Impl& own = *impl_;
    const std::size_t n = own.order.size();
    own.right.resize(n);
    own.gathered.resize(own.tallest);
    double* const w = own.gathered.data();
    for (std::size_t i = 0; i < n; ++i) own.right[i] = b[own.order[i]];
    for (int s = 0; s < own.panels(); ++s) {
        const auto at = static_cast<std::size_t>(s);
        const int tall = own.height(s), width = own.super[at + 1] - own.super[at];
        const int* const rows = own.row.data() + own.row_begin[at];
        for (int i = 0; i < width; ++i) w[i] = own.right[static_cast<std::size_t>(rows[i])];
        std::fill(w + width, w + tall, 0.0);
        detail::eliminate(own.value.data() + own.begin[at], tall, width, w);
        for (int i = 0; i < width; ++i) own.right[static_cast<std::size_t>(rows[i])] = w[i];
        for (int i = width; i < tall; ++i) own.right[static_cast<std::size_t>(rows[i])] += w[i];
    }
    for (int s = own.panels() - 1; s >= 0; --s) {
        const auto at = static_cast<std::size_t>(s);
        const int tall = own.height(s), width = own.super[at + 1] - own.super[at];
        const int* const rows = own.row.data() + own.row_begin[at];
        for (int i = 0; i < tall; ++i) w[i] = own.right[static_cast<std::size_t>(rows[i])];
        detail::substitute(own.value.data() + own.begin[at], tall, width, w);
        for (int i = 0; i < width; ++i) own.right[static_cast<std::size_t>(rows[i])] = w[i];
    }
    for (std::size_t i = 0; i < n; ++i) x[own.order[i]] = own.right[i];
}

long SupernodalCholesky::nonzeros() const { return static_cast<long>(impl_->value.size()); }
long SupernodalCholesky::orderings() const { return impl_->orderings; }

}  // namespace risorius::solve
