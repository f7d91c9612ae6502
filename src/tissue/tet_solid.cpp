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
    : tets_(tets), rest_volume_(tets.rows()), mu_(mu_pa), bulk_(bulk_pa) {
    assert(mu_pa.size() == tets.rows() && bulk_pa.size() == tets.rows());
    const int count = size();
    groups_.resize(static_cast<std::size_t>((count + 3) / 4));
    for (int slot = 0; slot < 4 * static_cast<int>(groups_.size()); ++slot) {
        // The last group is filled up with copies of the last tet that have no stiffness.
        const int tet = std::min(slot, count - 1);
        const Mat3 d = edges(rest, tets_, tet);
        const double volume = d.determinant() / 6.0;
        if (!(volume > 0))
            throw std::invalid_argument("TetSolid: tet " + std::to_string(tet) +
                                        " has no positive volume at rest");
        rest_volume_[tet] = volume;
        const Mat3 b = d.inverse();
        const double weight = slot < count ? volume : 0.0;
        Group& group = groups_[static_cast<std::size_t>(slot / 4)];
        const int lane = slot % 4;
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) group.b[3 * k + j][lane] = b(k, j);
        group.shear[lane] = weight * mu_[tet];
        group.bulk[lane] = weight * bulk_[tet];
        group.inverse_6v[lane] = 1.0 / (6.0 * volume);
        for (int k = 0; k < 4; ++k) group.node[k][lane] = tets_(tet, k);
    }
}

double TetSolid::add_energy(const Points& x, Points& gradient) const {
    assert(gradient.rows() == x.rows());
    x_.copy(x);
    gradient_.set_zero(x.rows());
    const Lanes one = solve::all_lanes(1.0);
    Lanes energy{};

    for (const Group& g : groups_) {
        // Edges e[i][k]: coordinate i of edge k
        Lanes e[3][3];
        {
            Lanes r[3][4];
            for (int lane = 0; lane < 4; ++lane) {
                const Lanes p0 = x_[g.node[0][lane]];
                for (int k = 0; k < 3; ++k) r[k][lane] = x_[g.node[k + 1][lane]] - p0;
            }
            for (int k = 0; k < 3; ++k)
                solve::rows_to_lanes(r[k][0], r[k][1], r[k][2], r[k][3], e[0][k], e[1][k], e[2][k]);
        }
        const Lanes* const b = g.b;

        // F = E B, C = F^T F - I
        Lanes f[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                f[i][j] = e[i][0] * b[j] + e[i][1] * b[3 + j] + e[i][2] * b[6 + j];
        const Lanes c00 = f[0][0] * f[0][0] + f[1][0] * f[1][0] + f[2][0] * f[2][0] - one;
        const Lanes c11 = f[0][1] * f[0][1] + f[1][1] * f[1][1] + f[2][1] * f[2][1] - one;
        const Lanes c22 = f[0][2] * f[0][2] + f[1][2] * f[1][2] + f[2][2] * f[2][2] - one;
        const Lanes c01 = f[0][0] * f[0][1] + f[1][0] * f[1][1] + f[2][0] * f[2][1];
        const Lanes c02 = f[0][0] * f[0][2] + f[1][0] * f[1][2] + f[2][0] * f[2][2];
        const Lanes c12 = f[0][1] * f[0][2] + f[1][1] * f[1][2] + f[2][1] * f[2][2];

        // J and its gradient with respect to the edges: 6V J = e_0 . (e_1 x e_2)
        Lanes cof[3][3];
        for (int i = 0; i < 3; ++i) {
            const int p = (i + 1) % 3, q = (i + 2) % 3;
            cof[i][0] = e[p][1] * e[q][2] - e[q][1] * e[p][2];
            cof[i][1] = e[p][2] * e[q][0] - e[q][2] * e[p][0];
            cof[i][2] = e[p][0] * e[q][1] - e[q][0] * e[p][1];
        }
        const Lanes j_minus_1 =
            (e[0][0] * cof[0][0] + e[1][0] * cof[1][0] + e[2][0] * cof[2][0]) * g.inverse_6v - one;

        const Lanes cross = c01 * c01 + c02 * c02 + c12 * c12;
        energy += g.shear * 0.25 * (c00 * c00 + c11 * c11 + c22 * c22 + cross + cross) +
                  g.bulk * 0.5 * j_minus_1 * j_minus_1;

        // dE/dE = V mu F C B^T + V K (J - 1) dJ/dE, a column per edge
        const Lanes pressure = g.bulk * j_minus_1 * g.inverse_6v;
        Lanes h[3][3];
        for (int i = 0; i < 3; ++i) {
            const Lanes p0 = g.shear * (f[i][0] * c00 + f[i][1] * c01 + f[i][2] * c02);
            const Lanes p1 = g.shear * (f[i][0] * c01 + f[i][1] * c11 + f[i][2] * c12);
            const Lanes p2 = g.shear * (f[i][0] * c02 + f[i][1] * c12 + f[i][2] * c22);
            for (int k = 0; k < 3; ++k)
                h[i][k] =
                    p0 * b[3 * k] + p1 * b[3 * k + 1] + p2 * b[3 * k + 2] + pressure * cof[i][k];
        }

        Lanes r[3][4];
        for (int k = 0; k < 3; ++k)
            solve::lanes_to_rows(h[0][k], h[1][k], h[2][k], r[k][0], r[k][1], r[k][2], r[k][3]);
        for (int lane = 0; lane < 4; ++lane) {
            gradient_[g.node[0][lane]] -= r[0][lane] + r[1][lane] + r[2][lane];
            for (int k = 0; k < 3; ++k) gradient_[g.node[k + 1][lane]] += r[k][lane];
        }
    }
    gradient_.add_to(gradient);
    return solve::sum_lanes(energy);
}

void TetSolid::add_gradients(solve::MetricBuilder& builder, const Eigen::VectorXd& weight) const {
    for (int tet = 0; tet < size(); ++tet) {
        const Group& group = groups_[static_cast<std::size_t>(tet / 4)];
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
