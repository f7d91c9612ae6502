#include "solve/sparse_cholesky.h"

#include <suitesparse/cholmod.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "solve/lanes.h"

namespace risorius::solve {

// L is copied out of CHOLMOD so that the three right-hand sides can be swept together: one point is
// one group of lanes, and each entry of L is read once per sweep instead of three times.
struct SparseCholesky::Impl {
    int n = 0;
    std::vector<std::int32_t> order;         // row of the factor -> row of A
    std::vector<std::int32_t> column_begin;  // n + 1
    std::vector<std::int32_t> row;           // below the diagonal
    std::vector<double> value;
    std::vector<double> inverse_diagonal;
    mutable PaddedPoints y;

    void factorise(const Eigen::SparseMatrix<double>& A);
    void solve(const Points& B, Points& X) const;
};

namespace {

struct Cholmod {
    cholmod_common common;
    cholmod_factor* factor = nullptr;

    Cholmod() {
        cholmod_start(&common);
        common.supernodal =
            CHOLMOD_SIMPLICIAL;  // no BLAS: its bits depend on the library installed
        common.final_ll = 1;
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_AMD;
        common.postorder = 1;
        common.print = 0;
    }
    ~Cholmod() {
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;
};

}  // namespace

void SparseCholesky::Impl::factorise(const Eigen::SparseMatrix<double>& A) {
    if (A.rows() != A.cols())
        throw std::invalid_argument("SparseCholesky: the matrix is not square");
    n = static_cast<int>(A.rows());
    Eigen::SparseMatrix<double> lower = A.triangularView<Eigen::Lower>();
    lower.makeCompressed();

    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(n);
    view.nzmax = static_cast<std::size_t>(lower.nonZeros());
    view.p = lower.outerIndexPtr();
    view.i = lower.innerIndexPtr();
    view.x = lower.valuePtr();
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;

    Cholmod cholmod;
    cholmod.factor = cholmod_analyze(&view, &cholmod.common);
    if (cholmod.factor == nullptr) throw std::invalid_argument("SparseCholesky: no ordering found");
    cholmod_factorize(&view, cholmod.factor, &cholmod.common);
    const cholmod_factor& L = *cholmod.factor;
    if (cholmod.common.status != CHOLMOD_OK || L.minor < L.n)
        throw std::invalid_argument("SparseCholesky: the matrix is not positive definite");

    const auto* perm = static_cast<const int*>(L.Perm);
    const auto* begin = static_cast<const int*>(L.p);
    const auto* count = static_cast<const int*>(L.nz);
    const auto* rows = static_cast<const int*>(L.i);
    const auto* values = static_cast<const double*>(L.x);
    order.assign(perm, perm + n);
    inverse_diagonal.resize(static_cast<std::size_t>(n));
    column_begin.assign(1, 0);
    for (int j = 0; j < n; ++j) {
        inverse_diagonal[static_cast<std::size_t>(j)] = 1.0 / values[begin[j]];
        for (int k = begin[j] + 1; k < begin[j] + count[j]; ++k) {
            row.push_back(rows[k]);
            value.push_back(values[k]);
        }
        column_begin.push_back(static_cast<std::int32_t>(row.size()));
    }
}

void SparseCholesky::Impl::solve(const Points& B, Points& X) const {
    y.set_zero(n);
    for (int i = 0; i < n; ++i) {
        const double* b = B.data() + 3L * order[static_cast<std::size_t>(i)];
        y[i] = Lanes{b[0], b[1], b[2], 0.0};
    }
    const std::int32_t* const r = row.data();
    const double* const v = value.data();
    const std::int32_t* const begin = column_begin.data();

    // L z = b, column by column
    for (int j = 0; j < n; ++j) {
        const Lanes z = y[j] * inverse_diagonal[static_cast<std::size_t>(j)];
        y[j] = z;
        for (std::int32_t k = begin[j]; k < begin[j + 1]; ++k) y[r[k]] -= v[k] * z;
    }
    // L^T x = z; four partial sums hide the latency of the additions
    for (int j = n - 1; j >= 0; --j) {
        Lanes s0 = y[j], s1{}, s2{}, s3{};
        std::int32_t k = begin[j];
        for (; k + 3 < begin[j + 1]; k += 4) {
            s0 -= v[k] * y[r[k]];
            s1 -= v[k + 1] * y[r[k + 1]];
            s2 -= v[k + 2] * y[r[k + 2]];
            s3 -= v[k + 3] * y[r[k + 3]];
        }
        for (; k < begin[j + 1]; ++k) s0 -= v[k] * y[r[k]];
        y[j] = ((s0 + s1) + (s2 + s3)) * inverse_diagonal[static_cast<std::size_t>(j)];
    }

    X.resize(n, 3);
    for (int i = 0; i < n; ++i) {
        double* x = X.data() + 3L * order[static_cast<std::size_t>(i)];
        x[0] = y[i][0];
        x[1] = y[i][1];
        x[2] = y[i][2];
    }
}

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& A)
    : impl_(std::make_unique<Impl>()) {
    impl_->factorise(A);
}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::solve(const Points& B, Points& X) const { impl_->solve(B, X); }
int SparseCholesky::size() const { return impl_->n; }
long SparseCholesky::nonzeros() const {
    return static_cast<long>(impl_->value.size()) + static_cast<long>(impl_->n);
}

}  // namespace risorius::solve
