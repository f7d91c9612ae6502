// SPDX-License-Identifier: MIT
#include "risorius/solve/sparse_cholesky.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "risorius/solve/detail/cholmod_view.h"
#include "risorius/solve/detail/nested_dissection.h"
#include "risorius/solve/lanes.h"

namespace risorius::solve {

// L is copied out of CHOLMOD so that the three right-hand sides are processed together: one point is one group of lanes, and
// each entry of L is read once per sweep instead of three times. Neighbouring columns whose patterns nest are stored as one
// panel, padded with a few zeros, so that a point is fetched once for up to kWidest entries.
namespace {

constexpr int kWidest = 4;
constexpr double kZerosAllowed = 0.2;  ///< as a fraction of a panel's entries

struct Panel {
    std::int32_t first = 0;      ///< column
    std::int32_t width = 0;      ///< columns, 1..kWidest
    std::int32_t row_begin = 0;  ///< rows below the panel's own
    std::int32_t row_end = 0;
    std::int64_t value_begin = 0;  ///< width x width, diagonal inverted, then width values per row
};

/// The numbers of the factor, and both sweeps over them.
template <class Real>
struct Sweeps {
    using Point = typename LanesOf<Real>::Point;
    std::vector<Real> value;
    PaddedRows<Real> y;

    template <int W>
    void forward(const Panel& panel, const std::vector<std::int32_t>& row);
    template <int W>
    void backward(const Panel& panel, const std::vector<std::int32_t>& row);
    void solve(const std::vector<Panel>& panels, const std::vector<std::int32_t>& row,
               const std::vector<std::int32_t>& order, const Points& B, Points& X);
};

}  // namespace

struct SparseCholesky::Impl {
    int n = 0;
    long nonzeros = 0;
    std::vector<std::int32_t> order;  // row of the factor -> row of A
    std::vector<Panel> panels;
    std::vector<std::int32_t> row;
    Precision kept = Precision::kDouble;
    mutable Sweeps<double> in_double;
    mutable Sweeps<float> in_single;  // one of the two is empty

    void factorise(const Eigen::SparseMatrix<double>& A);
    void copy_panels(const std::vector<std::int32_t>& begin, const std::vector<std::int32_t>& rows,
                     const std::vector<double>& values);
};

namespace {

struct Cholmod {
    cholmod_common common;
    cholmod_factor* factor = nullptr;

    Cholmod() {
        cholmod_start(&common);
        // No BLAS: its bits depend on the installed library.
        common.supernodal = CHOLMOD_SIMPLICIAL;
        common.final_ll = 1;
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_NESDIS;
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

    cholmod_sparse view = detail::view_of(lower);

    Cholmod cholmod;
    cholmod.factor = detail::analyse(view, cholmod.common);
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
    std::vector<std::int32_t> packed_begin{0}, packed_rows;
    std::vector<double> packed_values;
    for (int j = 0; j < n; ++j) {
        for (int k = begin[j]; k < begin[j] + count[j]; ++k) {
            packed_rows.push_back(rows[k]);
            packed_values.push_back(values[k]);
        }
        packed_begin.push_back(static_cast<std::int32_t>(packed_rows.size()));
    }
    nonzeros = static_cast<long>(packed_rows.size());
    copy_panels(packed_begin, packed_rows, packed_values);
}

// Columns are [begin[j], begin[j + 1]). Each starts with its diagonal; rows ascend.
void SparseCholesky::Impl::copy_panels(const std::vector<std::int32_t>& begin,
                                       const std::vector<std::int32_t>& rows,
                                       const std::vector<double>& values) {
    const auto entries = [&](int j) {
        return begin[static_cast<std::size_t>(j) + 1] - begin[static_cast<std::size_t>(j)];
    };
    std::vector<std::int32_t> place(static_cast<std::size_t>(n), 0);  // of a row within its panel
    std::vector<double>& value = in_double.value;
    for (int first = 0; first < n;) {
        // If the first row below column j is j + 1, the rest of its pattern is part of the pattern of column j + 1.
        int last = first;
        long used = entries(first);
        while (last + 1 < n && last + 1 - first < kWidest && entries(last) > 1 &&
               rows[static_cast<std::size_t>(begin[static_cast<std::size_t>(last)]) + 1] ==
                   last + 1) {
            const long width = last + 2 - first;
            const long below = entries(last + 1) - 1;
            const long size = width * (width + 1) / 2 + width * below;
            if (size - used - entries(last + 1) > kZerosAllowed * static_cast<double>(size)) break;
            used += entries(++last);
        }

        Panel panel;
        panel.first = first;
        panel.width = last + 1 - first;
        panel.row_begin = static_cast<std::int32_t>(row.size());
        panel.value_begin = static_cast<std::int64_t>(value.size());
        for (std::int32_t k = begin[static_cast<std::size_t>(last)] + 1;
             k < begin[static_cast<std::size_t>(last) + 1]; ++k) {
            place[static_cast<std::size_t>(rows[static_cast<std::size_t>(k)])] =
                static_cast<std::int32_t>(row.size()) - panel.row_begin + panel.width;
            row.push_back(rows[static_cast<std::size_t>(k)]);
        }
        panel.row_end = static_cast<std::int32_t>(row.size());
        for (int k = first; k <= last; ++k) place[static_cast<std::size_t>(k)] = k - first;

        const int height = panel.width + panel.row_end - panel.row_begin;
        value.resize(value.size() + static_cast<std::size_t>(height * panel.width), 0.0);
        double* const to = value.data() + panel.value_begin;
        for (int j = first; j <= last; ++j) {
            for (std::int32_t k = begin[static_cast<std::size_t>(j)];
                 k < begin[static_cast<std::size_t>(j) + 1]; ++k) {
                const std::int32_t r = rows[static_cast<std::size_t>(k)];
                const double v = values[static_cast<std::size_t>(k)];
                to[place[static_cast<std::size_t>(r)] * panel.width + (j - first)] =
                    r == j ? 1.0 / v : v;
            }
        }
        panels.push_back(panel);
        first = last + 1;
    }
}

template <class Real>
template <int W>
void Sweeps<Real>::forward(const Panel& panel, const std::vector<std::int32_t>& row) {
    const Real* v = value.data() + panel.value_begin;
    Point z[W];
    for (int k = 0; k < W; ++k) {
        Point s = y[panel.first + k];
        for (int m = 0; m < k; ++m) s -= v[k * W + m] * z[m];
        z[k] = s * v[k * W + k];
        y[panel.first + k] = z[k];
    }
    v += W * W;
    const std::int32_t* const end = row.data() + panel.row_end;
    for (const std::int32_t* r = row.data() + panel.row_begin; r < end; ++r, v += W) {
        Point s = v[0] * z[0];
        for (int k = 1; k < W; ++k) s += v[k] * z[k];
        y[*r] -= s;
    }
}

template <class Real>
template <int W>
void Sweeps<Real>::backward(const Panel& panel, const std::vector<std::int32_t>& row) {
    const Real* const block = value.data() + panel.value_begin;
    const Real* v = block + W * W;
    // Two partial sums per column hide the latency of additions.
    Point even[W], odd[W];
    for (int k = 0; k < W; ++k) {
        even[k] = y[panel.first + k];
        odd[k] = Point{};
    }
    const std::int32_t* r = row.data() + panel.row_begin;
    const std::int32_t* const end = row.data() + panel.row_end;
    for (; r + 1 < end; r += 2, v += 2 * W) {
        const Point y0 = y[r[0]], y1 = y[r[1]];
        for (int k = 0; k < W; ++k) {
            even[k] -= v[k] * y0;
            odd[k] -= v[W + k] * y1;
        }
    }
    if (r < end) {
        const Point y0 = y[*r];
        for (int k = 0; k < W; ++k) even[k] -= v[k] * y0;
    }
    for (int k = W - 1; k >= 0; --k) {
        Point s = even[k] + odd[k];
        for (int m = k + 1; m < W; ++m) s -= block[m * W + k] * even[m];
        even[k] = s * block[k * W + k];
        y[panel.first + k] = even[k];
    }
}

template <class Real>
void Sweeps<Real>::solve(const std::vector<Panel>& panels, const std::vector<std::int32_t>& row,
                         const std::vector<std::int32_t>& order, const Points& B, Points& X) {
    const auto n = static_cast<int>(order.size());
    y.set_zero(n);
    for (int i = 0; i < n; ++i) {
        const double* b = B.data() + 3L * order[static_cast<std::size_t>(i)];
        y[i] = Point{static_cast<Real>(b[0]), static_cast<Real>(b[1]), static_cast<Real>(b[2]),
                     Real(0)};
    }
    // L z = b
    for (const Panel& panel : panels) {
        switch (panel.width) {
            case 1:
                forward<1>(panel, row);
                break;
            case 2:
                forward<2>(panel, row);
                break;
            case 3:
                forward<3>(panel, row);
                break;
            default:
                forward<kWidest>(panel, row);
                break;
        }
    }
    // L^T x = z
    for (auto panel = panels.rbegin(); panel != panels.rend(); ++panel) {
        switch (panel->width) {
            case 1:
                backward<1>(*panel, row);
                break;
            case 2:
                backward<2>(*panel, row);
                break;
            case 3:
                backward<3>(*panel, row);
                break;
            default:
                backward<kWidest>(*panel, row);
                break;
        }
    }

    X.resize(n, 3);
    for (int i = 0; i < n; ++i) {
        double* x = X.data() + 3L * order[static_cast<std::size_t>(i)];
        x[0] = y[i][0];
        x[1] = y[i][1];
        x[2] = y[i][2];
    }
}

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& A, Precision kept)
    : impl_(std::make_unique<Impl>()) {
    impl_->kept = kept;
    impl_->factorise(A);
    if (kept == Precision::kDouble) return;
    impl_->in_single.value.assign(impl_->in_double.value.begin(), impl_->in_double.value.end());
    impl_->in_double.value = {};
}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::solve(const Points& B, Points& X) const {
    const Impl& self = *impl_;
    if (self.kept == Precision::kSingle)
        self.in_single.solve(self.panels, self.row, self.order, B, X);
    else
        self.in_double.solve(self.panels, self.row, self.order, B, X);
}
int SparseCholesky::size() const { return impl_->n; }
long SparseCholesky::nonzeros() const { return impl_->nonzeros; }

}  // namespace risorius::solve
