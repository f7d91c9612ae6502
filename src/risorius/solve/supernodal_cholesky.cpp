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
    std::vector<int> given;         ///< the order of order_like(); empty without
    std::vector<int> super;         ///< first column of each panel, then n
    std::vector<int> row_begin;     ///< where each panel begins in `row`
    std::vector<long> begin;        ///< where each panel begins in the values, column-major
    std::vector<int> row;      ///< rows of the panels, ascending; a panel's own columns come first
    std::vector<int> owner;    ///< panel of each column
    std::vector<long> target;  ///< index in the values of each entry of A
    std::size_t tallest = 0;
    long orderings = 0;
    // Scratch
    std::vector<int> local, head, next, from, place;

    /// The numbers of the factor, and the work with them.
    template <class Real>
    struct Values {
        std::vector<Real> value, update;
        mutable std::vector<Real> right, gathered;
        bool factorise(Impl& own, const Eigen::SparseMatrix<double>& A);
        bool factorise_panels(Impl& own);
        void subtract(Impl& own, int from_panel, int panel, int used);
        void solve(const Impl& own, const double* b, double* x) const;
    };
    Precision kept = Precision::kDouble;
    Values<double> in_double;
    Values<float> in_single;

    int panels() const { return static_cast<int>(super.size()) - 1; }
    int height(int p) const {
        return row_begin[static_cast<std::size_t>(p) + 1] - row_begin[static_cast<std::size_t>(p)];
    }
    int width(int p) const {
        return super[static_cast<std::size_t>(p) + 1] - super[static_cast<std::size_t>(p)];
    }
    const int* rows(int p) const { return row.data() + row_begin[static_cast<std::size_t>(p)]; }
    bool same_pattern(const Eigen::SparseMatrix<double>& A) const {
        return outer.size() == static_cast<std::size_t>(A.cols()) + 1 &&
               inner.size() == static_cast<std::size_t>(A.nonZeros()) &&
               std::equal(outer.begin(), outer.end(), A.outerIndexPtr()) &&
               std::equal(inner.begin(), inner.end(), A.innerIndexPtr());
    }
    void analyse(const Eigen::SparseMatrix<double>& A, int block);
    void updates_next(int panel);
};

void SupernodalCholesky::Impl::analyse(const Eigen::SparseMatrix<double>& A, int block) {
    const bool ordered = given.size() == static_cast<std::size_t>(A.rows());
    if (!ordered) ++orderings;
    detail::PanelPattern pattern =
        detail::panel_pattern(A, ordered ? given : detail::nested_dissection(A, block));
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
    std::vector<int> position(n);
    for (std::size_t i = 0; i < n; ++i)
        position[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    target.clear();
    target.reserve(static_cast<std::size_t>(A.nonZeros()));
    auto found = row.begin();
    for (int j = 0; j < A.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
            const int a = position[static_cast<std::size_t>(it.row())],
                      b = position[static_cast<std::size_t>(j)];
            const int column = std::min(a, b);
            const auto p = static_cast<std::size_t>(owner[static_cast<std::size_t>(column)]);
            const auto first = row.begin() + row_begin[p], last = row.begin() + row_begin[p + 1];
            // The rows of a node are neighbours
            if (found >= first && found + 1 < last && found[1] == std::max(a, b))
                ++found;
            else
                found = std::lower_bound(first, last, std::max(a, b));
            target.push_back(begin[p] +
                             static_cast<long>(column - super[p]) * height(static_cast<int>(p)) +
                             (found - first));
        }
    outer.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
    inner.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
}

// Puts a panel into the list of the panel that it updates next: the owner of its first row that has not been used.
void SupernodalCholesky::Impl::updates_next(int panel) {
    const auto at = static_cast<std::size_t>(panel);
    if (from[at] == height(panel)) return;
    const auto to =
        static_cast<std::size_t>(owner[static_cast<std::size_t>(rows(panel)[from[at]])]);
    next[at] = head[to];
    head[to] = panel;
}

template <class Real>
bool SupernodalCholesky::Impl::Values<Real>::factorise(Impl& own,
                                                       const Eigen::SparseMatrix<double>& A) {
    value.assign(static_cast<std::size_t>(own.begin.back()) + detail::kReadBeyond, Real(0));
    const double* const a = A.valuePtr();
    for (std::size_t i = 0; i < own.target.size(); ++i)
        value[static_cast<std::size_t>(own.target[i])] += static_cast<Real>(a[i]);
    return factorise_panels(own);
}

// Subtracts from the columns of `panel` what the rows from[by] .. used - 1 of the panel `by` contribute.
template <class Real>
void SupernodalCholesky::Impl::Values<Real>::subtract(Impl& own, int by, int panel, int used) {
    const auto at = static_cast<std::size_t>(panel);
    const int its_height = own.height(by), begun = own.from[static_cast<std::size_t>(by)];
    const int m = its_height - begun, n = used - begun, stride = detail::stored_rows<Real>(m);
    const Real* const source = value.data() + own.begin[static_cast<std::size_t>(by)] + begun;
    update.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(n));
    detail::product(source, its_height, source, its_height, m, n, own.width(by), update.data());

    const int* const its_rows = own.rows(by) + begun;
    for (int i = 0; i < m; ++i)
        own.place[static_cast<std::size_t>(i)] = own.local[static_cast<std::size_t>(its_rows[i])];
    const int* const place = own.place.data();
    const bool joined = place[m - 1] - place[0] == m - 1;
    for (int j = 0; j < n; ++j) {
        Real* const column = value.data() + own.begin[at] +
                             static_cast<long>(its_rows[j] - own.super[at]) * own.height(panel);
        const Real* const change = update.data() + static_cast<long>(j) * stride;
        if (joined)
            for (int i = j; i < m; ++i) column[place[0] + i] -= change[i];
        else
            for (int i = j; i < m; ++i) column[place[i]] -= change[i];
    }
}

template <class Real>
bool SupernodalCholesky::Impl::Values<Real>::factorise_panels(Impl& own) {
    const int count = own.panels();
    own.local.resize(own.owner.size());
    own.place.resize(own.tallest);
    // Lists of the panels that update this one next.
    own.head.assign(static_cast<std::size_t>(count), -1);
    own.next.assign(static_cast<std::size_t>(count), -1);
    own.from.assign(static_cast<std::size_t>(count), 0);  // rows of a panel that have been used
    for (int s = 0; s < count; ++s) {
        const auto at = static_cast<std::size_t>(s);
        const int end = own.super[at + 1], tall = own.height(s);
        const int* const rows = own.rows(s);
        for (int i = 0; i < tall; ++i) own.local[static_cast<std::size_t>(rows[i])] = i;

        for (int d = own.head[at], follower; d >= 0; d = follower) {
            const auto by = static_cast<std::size_t>(d);
            follower = own.next[by];
            int used = own.from[by];
            while (used < own.height(d) && own.rows(d)[used] < end) ++used;
            subtract(own, d, s, used);
            own.from[by] = used;
            own.updates_next(d);
        }
        if (!detail::factorise_panel(value.data() + own.begin[at], tall, own.width(s), update))
            return false;
        own.from[at] = own.width(s);
        own.updates_next(s);
    }
    return true;
}

template <class Real>
void SupernodalCholesky::Impl::Values<Real>::solve(const Impl& own, const double* b,
                                                   double* x) const {
    const std::size_t n = own.order.size();
    right.resize(n);
    gathered.resize(own.tallest + detail::kReadBeyond);
    Real* const w = gathered.data();
    for (std::size_t i = 0; i < n; ++i) right[i] = static_cast<Real>(b[own.order[i]]);
    for (int s = 0; s < own.panels(); ++s) {
        const int tall = own.height(s), width = own.width(s);
        const int* const rows = own.rows(s);
        for (int i = 0; i < width; ++i) w[i] = right[static_cast<std::size_t>(rows[i])];
        std::fill(w + width, w + tall, Real(0));
        detail::eliminate(value.data() + own.begin[static_cast<std::size_t>(s)], tall, width, w);
        for (int i = 0; i < width; ++i) right[static_cast<std::size_t>(rows[i])] = w[i];
        for (int i = width; i < tall; ++i) right[static_cast<std::size_t>(rows[i])] += w[i];
    }
    for (int s = own.panels() - 1; s >= 0; --s) {
        const int tall = own.height(s), width = own.width(s);
        const int* const rows = own.rows(s);
        for (int i = 0; i < tall; ++i) w[i] = right[static_cast<std::size_t>(rows[i])];
        detail::substitute(value.data() + own.begin[static_cast<std::size_t>(s)], tall, width, w);
        for (int i = 0; i < width; ++i) right[static_cast<std::size_t>(rows[i])] = w[i];
    }
    for (std::size_t i = 0; i < n; ++i) x[own.order[i]] = right[i];
}

SupernodalCholesky::SupernodalCholesky() : impl_(std::make_unique<Impl>()) {}
SupernodalCholesky::~SupernodalCholesky() = default;
SupernodalCholesky::SupernodalCholesky(SupernodalCholesky&&) noexcept = default;
SupernodalCholesky& SupernodalCholesky::operator=(SupernodalCholesky&&) noexcept = default;

void SupernodalCholesky::order_like(const Eigen::SparseMatrix<double>& A, int block) {
    impl_->given = detail::nested_dissection(A, block);
    ++impl_->orderings;
    impl_->outer.clear();  // the next matrix is analysed
}

bool SupernodalCholesky::factorise(const Eigen::SparseMatrix<double>& A, int block,
                                   Precision kept) {
    assert(A.rows() == A.cols() && A.isCompressed() && A.rows() % block == 0);
    Impl& own = *impl_;
    if (!own.same_pattern(A)) own.analyse(A, block);
    own.kept = kept;
    return kept == Precision::kSingle ? own.in_single.factorise(own, A)
                                      : own.in_double.factorise(own, A);
}

void SupernodalCholesky::solve(const double* b, double* x) const {
    if (impl_->kept == Precision::kSingle)
        impl_->in_single.solve(*impl_, b, x);
    else
        impl_->in_double.solve(*impl_, b, x);
}

long SupernodalCholesky::nonzeros() const { return impl_->begin.empty() ? 0 : impl_->begin.back(); }
long SupernodalCholesky::orderings() const { return impl_->orderings; }

}  // namespace risorius::solve
