// SPDX-License-Identifier: MIT
// L D L^T by CHOLMOD's simplicial code, which accepts negative pivots and needs no BLAS.
#include "risorius/solve/symmetric_factor.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "risorius/solve/detail/cholmod_view.h"
#include "risorius/solve/detail/nested_dissection.h"

namespace risorius::solve {

struct SymmetricFactor::Impl {
    cholmod_common common;
    cholmod_factor* factor = nullptr;
    std::vector<int> outer, inner;  ///< pattern of the ordered matrix
    long orderings = 0;
    // Scratch of solves
    cholmod_dense *solution = nullptr, *work1 = nullptr, *work2 = nullptr;
    std::vector<double> columns;

    Impl() {
        cholmod_start(&common);
        // No BLAS: its bits depend on the installed library.
        common.supernodal = CHOLMOD_SIMPLICIAL;
        common.final_ll = 0;
        common.nmethods = 1;
        common.postorder = 1;
        common.print = 0;
    }
    ~Impl() {
        cholmod_free_dense(&solution, &common);
        cholmod_free_dense(&work1, &common);
        cholmod_free_dense(&work2, &common);
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    bool same_pattern(const Eigen::SparseMatrix<double>& A) const {
        return factor != nullptr && outer.size() == static_cast<std::size_t>(A.cols()) + 1 &&
               inner.size() == static_cast<std::size_t>(A.nonZeros()) &&
               std::equal(outer.begin(), outer.end(), A.outerIndexPtr()) &&
               std::equal(inner.begin(), inner.end(), A.innerIndexPtr());
    }
    void order(const Eigen::SparseMatrix<double>& A, int block);
};

// Orders the nodes by nested dissection and keeps the coordinates of a node together.
void SymmetricFactor::Impl::order(const Eigen::SparseMatrix<double>& A, int block) {
    cholmod_free_factor(&factor, &common);
    std::vector<int> order = detail::nested_dissection(A, block);
    cholmod_sparse view = detail::view_of(A);
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 0;  // the nodes are in post-order already
    factor = cholmod_analyze_p(&view, order.data(), nullptr, 0, &common);
    common.postorder = 1;
    if (factor == nullptr) throw std::invalid_argument("SymmetricFactor: no ordering found");
    outer.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
    inner.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    ++orderings;
}

SymmetricFactor::SymmetricFactor() : impl_(std::make_unique<Impl>()) {}
SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

Definiteness SymmetricFactor::factorise(const Eigen::SparseMatrix<double>& A, int block) {
    assert(A.rows() == A.cols() && A.isCompressed() && A.rows() % block == 0);
    Impl& own = *impl_;
    if (!own.same_pattern(A)) own.order(A, block);
    cholmod_sparse view = detail::view_of(A);
    cholmod_factorize(&view, own.factor, &own.common);
    const cholmod_factor& L = *own.factor;
    if (own.common.status < CHOLMOD_OK || L.minor < L.n) return Definiteness::kSingular;

    // The entry of D is the first one of each column.
    const auto* begin = static_cast<const int*>(L.p);
    const auto* value = static_cast<const double*>(L.x);
    Definiteness found = Definiteness::kPositive;
    for (std::size_t j = 0; j < L.n; ++j) {
        const double d = value[begin[j]];
        if (!std::isfinite(d) || d == 0) return Definiteness::kSingular;
        if (d < 0) found = Definiteness::kIndefinite;
    }
    return found;
}

void SymmetricFactor::solve(const double* b, double* x, int columns) const {
    Impl& own = *impl_;
    assert(own.factor != nullptr);
    const std::size_t n = own.factor->n;
    const auto count = static_cast<std::size_t>(columns);
    own.columns.resize(n * count);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < count; ++c) own.columns[c * n + i] = b[i * count + c];
    cholmod_dense right{};
    right.nrow = right.d = n;
    right.ncol = count;
    right.nzmax = n * count;
    right.x = own.columns.data();
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, own.factor, &right, nullptr, &own.solution, nullptr, &own.work1,
                   &own.work2, &own.common);
    const auto* found = static_cast<const double*>(own.solution->x);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < count; ++c) x[i * count + c] = found[c * n + i];
}

long SymmetricFactor::nonzeros() const {
    long sum = 0;
    if (impl_->factor == nullptr) return sum;
    const auto* count = static_cast<const int*>(impl_->factor->nz);
    for (std::size_t j = 0; count != nullptr && j < impl_->factor->n; ++j) sum += count[j];
    return sum;
}

long SymmetricFactor::orderings() const { return impl_->orderings; }

}  // namespace risorius::solve
