#include "tissue/tet_solid.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <string>

namespace risorius::tissue {

using solve::Lanes;

namespace {

Mat3 edges(const Points& x, const Tets& tets, int tet) {
    Mat3 d;
    for (int k = 0; k < 3; ++k)
        d.col(k) = (x.row(tets(tet, k + 1)) - x.row(tets(tet, 0))).transpose();
    return d;
}

}  // namespace

TetSolid::TetSolid(const Tets& tets, const Points& rest, const Eigen::VectorXd& mu_pa,
                   const Eigen::VectorXd& bulk_pa)
    : tets_(tets), rest_(rest), rest_volume_(tets.rows()), mu_(mu_pa), bulk_(bulk_pa) {
    assert(mu_pa.size() == tets.rows() && bulk_pa.size() == tets.rows());
    for (int tet = 0; tet < size(); ++tet) {
        rest_volume_[tet] = edges(rest_, tets_, tet).determinant() / 6.0;
        if (!(rest_volume_[tet] > 0))
            throw std::invalid_argument("TetSolid: tet " + std::to_string(tet) +
                                        " has no positive volume at rest");
    }
    fill(double_);
    fill(single_);
}

template <class Real>
void TetSolid::fill(Work<Real>& work) const {
    constexpr int kWidth = Group<Real>::kWidth;
    const int count = size();
    work.groups.resize(static_cast<std::size_t>((count + kWidth - 1) / kWidth));
    for (int slot = 0; slot < kWidth * static_cast<int>(work.groups.size()); ++slot) {
        // The last group is filled up with copies of the last tet that have no stiffness.
        const int tet = std::min(slot, count - 1);
        const Mat3 b = edges(rest_, tets_, tet).inverse();
        const double weight = slot < count ? rest_volume_[tet] : 0.0;
        Group<Real>& group = work.groups[static_cast<std::size_t>(slot / kWidth)];
        const int lane = slot % kWidth;
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) group.b[3 * k + j][lane] = static_cast<Real>(b(k, j));
        group.shear[lane] = static_cast<Real>(weight * mu_[tet]);
        group.bulk[lane] = static_cast<Real>(weight * bulk_[tet]);
        for (int k = 0; k < 4; ++k) group.node[k][lane] = tets_(tet, k);
    }
}

double TetSolid::add_energy(const Points& x, Points& gradient, solve::Precision precision) const {
    assert(gradient.rows() == x.rows());
    return precision == solve::Precision::kSingle ? add_energy_in(single_, x, gradient)
                                                  : add_energy_in(double_, x, gradient);
}

template <class Real>
double TetSolid::add_energy_in(Work<Real>& work, const Points& x, Points& gradient) const {
    using Lane = typename solve::LanesOf<Real>::Lane;
    using Point = typename solve::LanesOf<Real>::Point;
    constexpr int kWidth = Group<Real>::kWidth;
    constexpr Real kHalf = Real(0.5), kQuarter = Real(0.25);
    constexpr Real kSpare = Real(1 - kCrushed), kMore = Real(kHardens);
    solve::PaddedRows<Real>& u = work.displacement;
    solve::PaddedRows<Real>& out = work.gradient;
    u.copy_difference(x, rest_);
    out.set_zero(rest_.rows());
    Lanes energy{};

    for (const Group<Real>& g : work.groups) {
        // Differences d[i][k] of displacement: coordinate i along edge k
        Lane d[3][3];
        {
            Point r[3][kWidth];
            for (int lane = 0; lane < kWidth; ++lane) {
                const Point p0 = u[g.node[0][lane]];
                for (int k = 0; k < 3; ++k) r[k][lane] = u[g.node[k + 1][lane]] - p0;
            }
            for (int k = 0; k < 3; ++k) solve::rows_to_lanes(r[k], d[0][k], d[1][k], d[2][k]);
        }
        const Lane* const b = g.b;

        // H = D B, F = I + H, C = F^T F - I = H + H^T + H^T H
        Lane h[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                h[i][j] = d[i][0] * b[j] + d[i][1] * b[3 + j] + d[i][2] * b[6 + j];
        Lane c[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j)
                c[i][j] = c[j][i] =
                    h[i][j] + h[j][i] + h[0][i] * h[0][j] + h[1][i] * h[1][j] + h[2][i] * h[2][j];

        // J - 1 in invariants of H, exact near rest; dJ/dF = cof F
        Lane f[3][3], cof[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) f[i][j] = i == j ? h[i][j] + Real(1) : h[i][j];
        for (int i = 0; i < 3; ++i) {
            const int p = (i + 1) % 3, q = (i + 2) % 3;
            for (int j = 0; j < 3; ++j) {
                const int m = (j + 1) % 3, n = (j + 2) % 3;
                cof[i][j] = f[p][m] * f[q][n] - f[p][n] * f[q][m];
            }
        }
        const Lane minors = h[0][0] * h[1][1] - h[0][1] * h[1][0] + h[1][1] * h[2][2] -
                            h[1][2] * h[2][1] + h[0][0] * h[2][2] - h[0][2] * h[2][0];
        const Lane det = h[0][0] * (h[1][1] * h[2][2] - h[1][2] * h[2][1]) +
                         h[0][1] * (h[1][2] * h[2][0] - h[1][0] * h[2][2]) +
                         h[0][2] * (h[1][0] * h[2][1] - h[1][1] * h[2][0]);
        const Lane j_minus_1 = h[0][0] + h[1][1] + h[2][2] + minors + det;

        const Lane spare = j_minus_1 + kSpare;
        const Lane crushed = spare < Real(0) ? spare : Lane{};

        const Lane cross = c[0][1] * c[0][1] + c[0][2] * c[0][2] + c[1][2] * c[1][2];
        solve::add_lanes(
            energy,
            g.shear * kQuarter *
                    (c[0][0] * c[0][0] + c[1][1] * c[1][1] + c[2][2] * c[2][2] + cross + cross) +
                g.bulk * kHalf * (j_minus_1 * j_minus_1 + kMore * crushed * crushed));

        // dE/dF = V mu F C + V K (J - 1 + c min(0, J - J_c)) cof F, and times B^T a column per edge
        const Lane pressure = g.bulk * (j_minus_1 + kMore * crushed);
        Lane along[3][3];
        for (int i = 0; i < 3; ++i) {
            Lane p[3];
            for (int j = 0; j < 3; ++j)
                p[j] = g.shear * (f[i][0] * c[0][j] + f[i][1] * c[1][j] + f[i][2] * c[2][j]) +
                       pressure * cof[i][j];
            for (int k = 0; k < 3; ++k)
                along[i][k] = p[0] * b[3 * k] + p[1] * b[3 * k + 1] + p[2] * b[3 * k + 2];
        }

        Point r[3][kWidth];
        for (int k = 0; k < 3; ++k)
            solve::lanes_to_rows(along[0][k], along[1][k], along[2][k], r[k]);
        for (int lane = 0; lane < kWidth; ++lane) {
            out[g.node[0][lane]] -= r[0][lane] + r[1][lane] + r[2][lane];
            for (int k = 0; k < 3; ++k) out[g.node[k + 1][lane]] += r[k][lane];
        }
    }
    out.add_to(gradient);
    return solve::sum_lanes(energy);
}

void TetSolid::add_gradients(solve::MetricBuilder& builder, const Eigen::VectorXd& weight) const {
    for (int tet = 0; tet < size(); ++tet) {
        const Group<double>& group = double_.groups[static_cast<std::size_t>(tet / 4)];
        // Row v of G is the gradient of the shape function of corner v.
        Eigen::Matrix<double, 4, 3> g;
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) g(k + 1, j) = group.b[3 * k + j][tet % 4];
        g.row(0) = -(g.row(1) + g.row(2) + g.row(3));
        const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block =
            weight[tet] * (g * g.transpose());
        builder.add_block(&tets_(tet, 0), block.data(), 4);
    }
}

void TetSolid::add_metric(solve::MetricBuilder& builder) const {
    add_gradients(builder, rest_volume_.cwiseProduct(2.0 * mu_ + bulk_));
}

void TetSolid::add_laplacian(solve::MetricBuilder& builder, double scale) const {
    add_gradients(builder, scale * rest_volume_.cwiseProduct(mu_));
}

double TetSolid::signed_volume(const Points& x, int tet) const {
    return edges(x, tets_, tet).determinant() / 6.0;
}

int TetSolid::inverted_count(const Points& x) const {
    int count = 0;
    for (int tet = 0; tet < size(); ++tet)
        if (!(signed_volume(x, tet) > 0)) ++count;
    return count;
}

double TetSolid::volume(const Points& x) const {
    double sum = 0;
    for (int tet = 0; tet < size(); ++tet) sum += signed_volume(x, tet);
    return sum;
}

double TetSolid::min_relative_volume(const Points& x) const {
    double least = size() == 0 ? 1.0 : signed_volume(x, 0) / rest_volume_[0];
    for (int tet = 1; tet < size(); ++tet)
        least = std::min(least, signed_volume(x, tet) / rest_volume_[tet]);
    return least;
}

Eigen::VectorXd TetSolid::lumped_mass(double density_kg_per_m3, int nodes) const {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(nodes);
    for (int tet = 0; tet < size(); ++tet)
        for (int k = 0; k < 4; ++k)
            mass[tets_(tet, k)] += 0.25 * density_kg_per_m3 * rest_volume_[tet];
    return mass;
}

}  // namespace risorius::tissue
