// SPDX-License-Identifier: MIT
// With the modes a, b, c (linear), d, e, f (bilinear, times 1/sqrt 3) and k (trilinear, times 1/3) of cell_lanes.h, the tangents at the Gauss
// points s = +-1 are
//   t1 = a + s2 d + s3 e + s2 s3 k     t2 = b + s1 d + s3 f + s1 s3 k     t3 = c + s1 e + s2 f + s1 s2 k
// A strain is the coefficient of one product of s in one component of t_i . t_j. The mean square of a component over the cell is the sum of
// the squares of its coefficients.
#include "risorius/tissue/bending_cells.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "risorius/core/cross_matrix.h"
#include "risorius/core/dense_algebra.h"

namespace risorius::tissue {

namespace {

enum Mode { a, b, c, d, e, f, k, kModes };

/// A summand of a strain: weight * one . other
struct Product {
    int one, other;
    double weight;
};
/// How a strain counts in the energy.
enum class Law { kMean, kPlane, kFibre };
struct Strain {
    int i, j;  ///< component, 0..2
    Law law;
    int partner;  ///< for kPlane: the strain of the other normal component of its layer, or -1
    std::array<Product, 4> products;
};

constexpr Product kNone{a, a, 0};
constexpr std::array<Strain, 18> kStrainTable{{
    // The mean
    {0, 0, Law::kMean, -1, {{{a, a, 1}, {d, d, 1}, {e, e, 1}, {k, k, 1}}}},
    {1, 1, Law::kMean, -1, {{{b, b, 1}, {d, d, 1}, {f, f, 1}, {k, k, 1}}}},
    {2, 2, Law::kMean, -1, {{{c, c, 1}, {e, e, 1}, {f, f, 1}, {k, k, 1}}}},
    {0, 1, Law::kMean, -1, {{{a, b, 1}, {e, f, 1}, kNone, kNone}}},
    {0, 2, Law::kMean, -1, {{{a, c, 1}, {d, f, 1}, kNone, kNone}}},
    {1, 2, Law::kMean, -1, {{{b, c, 1}, {d, e, 1}, kNone, kNone}}},
    // s1
    {1, 1, Law::kPlane, 7, {{{b, d, 2}, {f, k, 2}, kNone, kNone}}},
    {2, 2, Law::kPlane, 6, {{{c, e, 2}, {f, k, 2}, kNone, kNone}}},
    {1, 2, Law::kMean, -1, {{{b, e, 1}, {d, c, 1}, kNone, kNone}}},
    // s2
    {0, 0, Law::kPlane, 10, {{{a, d, 2}, {e, k, 2}, kNone, kNone}}},
    {2, 2, Law::kPlane, 9, {{{c, f, 2}, {e, k, 2}, kNone, kNone}}},
    {0, 2, Law::kMean, -1, {{{a, f, 1}, {d, c, 1}, kNone, kNone}}},
    // s3
    {0, 0, Law::kPlane, 13, {{{a, e, 2}, {d, k, 2}, kNone, kNone}}},
    {1, 1, Law::kPlane, 12, {{{b, f, 2}, {d, k, 2}, kNone, kNone}}},
    {0, 1, Law::kMean, -1, {{{a, f, 1}, {e, b, 1}, kNone, kNone}}},
    // s2 s3, s1 s3, s1 s2
    {0, 0, Law::kFibre, -1, {{{a, k, 2}, {d, e, 2}, kNone, kNone}}},
    {1, 1, Law::kFibre, -1, {{{b, k, 2}, {d, f, 2}, kNone, kNone}}},
    {2, 2, Law::kFibre, -1, {{{c, k, 2}, {e, f, 2}, kNone, kNone}}},
}};

/// The volume is the sum of x . (y x z) over these.
constexpr int kVolume[4][3] = {{a, b, c}, {a, d, e}, {b, f, d}, {c, e, f}};

using ModeRows = Eigen::Matrix<double, 7, 3>;
using FromCorners = Eigen::Matrix<double, 7, 8>;

/// The modes from the corners, corner 4 b1 + 2 b2 + b3.
const FromCorners& mode_matrix() {
    static const FromCorners matrix = [] {
        constexpr int kAxes[7][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0},
                                     {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
        FromCorners out;
        for (int mode = 0; mode < 7; ++mode)
            for (int corner = 0; corner < 8; ++corner) {
                double value = 0.25;
                int count = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    if (!kAxes[mode][axis]) continue;
                    value *= corner & (4 >> axis) ? 1 : -1;
                    ++count;
                }
                out(mode, corner) = value * std::pow(3.0, -0.5 * (count - 1));
            }
        return out;
    }();
    return matrix;
}

Vec3 row_of(const ModeRows& modes, int mode) { return modes.row(mode).transpose(); }

/// dV/dmodes, and V.
double volume_of(const ModeRows& modes, ModeRows& gradient) {
    gradient.setZero();
    double volume = 0;
    for (const auto& triple : kVolume) {
        const Vec3 x = row_of(modes, triple[0]), y = row_of(modes, triple[1]),
                   z = row_of(modes, triple[2]);
        volume += x.dot(y.cross(z));
        gradient.row(triple[0]) += y.cross(z).transpose();
        gradient.row(triple[1]) += z.cross(x).transpose();
        gradient.row(triple[2]) += x.cross(y).transpose();
    }
    return volume;
}

/// Gradient of a strain by the modes, without the factor of its component.
ModeRows gradient_of(const Strain& strain, const ModeRows& modes) {
    ModeRows out = ModeRows::Zero();
    for (const Product& product : strain.products) {
        out.row(product.one) += product.weight * modes.row(product.other);
        out.row(product.other) += product.weight * modes.row(product.one);
    }
    return out;
}

double scale_of(const Strain& strain, const Vec3& edges) {
    return 0.5 / (edges[strain.i] * edges[strain.j]);
}

using ModeMatrix = Eigen::Matrix<double, 21, 21>;

/// Adds factor * d2V/dmodes2; entry 3 mode + axis.
void add_volume_curvature(const ModeRows& modes, double factor, ModeMatrix& out) {
    const auto add = [&](int one, int other, const Mat3& block) {
        out.block<3, 3>(3 * one, 3 * other) += factor * block;
        out.block<3, 3>(3 * other, 3 * one) += factor * block.transpose();
    };
    for (const auto& triple : kVolume) {
        add(triple[0], triple[1], -cross_matrix(row_of(modes, triple[2])));
        add(triple[0], triple[2], cross_matrix(row_of(modes, triple[1])));
        add(triple[1], triple[2], -cross_matrix(row_of(modes, triple[0])));
    }
}

}  // namespace

BendingCells::BendingCells(CellBody body) : body_(std::move(body)) {
    if (!body_.mesh.uniform() || body_.moduli.size() != body_.mesh.cells().size())
        throw std::invalid_argument(
            "BendingCells: a uniform mesh and moduli of each cell are needed");
    for (std::size_t n = 0; n < body_.moduli.size(); ++n) {
        const CellModuli& moduli = body_.moduli[n];
        Cell cell{.node = body_.mesh.cells()[n].vertex,
                  .edges = Vec3::Zero(),
                  .mu = 0,
                  .bulk = 0,
                  .plane = 0,
                  .cross = 0,
                  .fibre = 0};
        const Modes modes = modes_of(cell, body_.rest);
        for (int axis = 0; axis < 3; ++axis) cell.edges[axis] = modes.row(axis).norm();
        const double longest = cell.edges.maxCoeff();
        Mat3 axes = modes.topRows<3>();
        const Mat3 box = axes * axes.transpose();
        if (!(axes.determinant() > 0) ||
            (box - Mat3(box.diagonal().asDiagonal())).norm() > 1e-9 * longest * longest ||
            modes.bottomRows<4>().norm() > 1e-9 * longest)
            throw std::invalid_argument("BendingCells: cell " + std::to_string(n) + " is no box");
        if (moduli.viscosity_pa_s != 0 || !(moduli.mu_pa > 0))
            throw std::invalid_argument("BendingCells: moduli without viscosity are needed");
        const double nu = 0.5 * moduli.bulk_pa / (moduli.bulk_pa + moduli.mu_pa);
        cell.mu = moduli.mu_pa * cell.edges.prod();
        cell.bulk = moduli.bulk_pa * cell.edges.prod();
        cell.plane = 1 / (1 - nu);
        cell.cross = nu / (1 - nu);
        cell.fibre = 1 + nu;
        cells_.push_back(cell);
    }
}

BendingCells::Modes BendingCells::modes_of(const Cell& cell, const Points& x) const {
    Eigen::Matrix<double, 8, 3> corners;
    for (int n = 0; n < 8; ++n) corners.row(n) = x.row(cell.node[static_cast<std::size_t>(n)]);
    return mode_matrix() * corners;
}

BendingCells::Strains BendingCells::strains_of(const Cell& cell, const Modes& modes) const {
    Strains out;
    for (int s = 0; s < kStrains; ++s) {
        const Strain& strain = kStrainTable[static_cast<std::size_t>(s)];
        double sum = 0;
        for (const Product& product : strain.products)
            sum += product.weight * modes.row(product.one).dot(modes.row(product.other));
        if (s < 3) sum -= cell.edges[s] * cell.edges[s];
        out[s] = scale_of(strain, cell.edges) * sum;
    }
    return out;
}

BendingCells::Strains BendingCells::stress_of(const Cell& cell, const Strains& strain) const {
    Strains out;
    for (int s = 0; s < kStrains; ++s) {
        const Strain& of = kStrainTable[static_cast<std::size_t>(s)];
        // Shear counts twice, as E_ij and E_ji.
        out[s] = 2 * cell.mu * (of.i == of.j ? 1 : 2) * strain[s];
        if (of.law == Law::kFibre) out[s] *= cell.fibre;
        if (of.law == Law::kPlane)
            out[s] = 2 * cell.mu * (cell.plane * strain[s] + cell.cross * strain[of.partner]);
    }
    return out;
}

double BendingCells::add_potential(const solve::ImplicitStep& /*step*/, const Points& x,
                                   Points& gradient) const {
    double energy = 0;
    for (const Cell& cell : cells_) {
        const Modes modes = modes_of(cell, x);
        const Strains strain = strains_of(cell, modes), stress = stress_of(cell, strain);
        Modes pull;
        const double volume = volume_of(modes, pull), rest = cell.edges.prod();
        const double excess = volume / rest - 1;
        energy += 0.5 * stress.dot(strain) + 0.5 * cell.bulk * excess * excess;
        pull *= cell.bulk * excess / rest;
        for (int s = 0; s < kStrains; ++s) {
            const Strain& of = kStrainTable[static_cast<std::size_t>(s)];
            pull += stress[s] * scale_of(of, cell.edges) * gradient_of(of, modes);
        }
        const Eigen::Matrix<double, 8, 3> corners = mode_matrix().transpose() * pull;
        for (int n = 0; n < 8; ++n)
            gradient.row(cell.node[static_cast<std::size_t>(n)]) += corners.row(n);
    }
    return energy;
}

void BendingCells::add_hessian(const solve::ImplicitStep& /*step*/, const Points& x,
                               solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    for (const Cell& cell : cells_) {
        const Modes modes = modes_of(cell, x);
        const Strains stress = stress_of(cell, strains_of(cell, modes));
        ModeMatrix whole = ModeMatrix::Zero();
        Eigen::Matrix<double, 21, kStrains> slopes;
        for (int s = 0; s < kStrains; ++s) {
            const Strain& of = kStrainTable[static_cast<std::size_t>(s)];
            const double scale = scale_of(of, cell.edges);
            const Modes slope = scale * gradient_of(of, modes);
            for (int mode = 0; mode < kModes; ++mode)
                slopes.block<3, 1>(3 * mode, s) = slope.row(mode).transpose();
            for (const Product& product : of.products) {
                const Mat3 block = scale * stress[s] * product.weight * Mat3::Identity();
                whole.block<3, 3>(3 * product.one, 3 * product.other) += block;
                whole.block<3, 3>(3 * product.other, 3 * product.one) += block;
            }
        }
        for (int s = 0; s < kStrains; ++s) {
            const Strains column = stress_of(cell, Strains::Unit(s));
            whole += slopes * column * slopes.col(s).transpose();
        }
        Modes slope;
        const double rest = cell.edges.prod(), volume = volume_of(modes, slope);
        Eigen::Matrix<double, 21, 1> along;
        for (int mode = 0; mode < kModes; ++mode)
            along.segment<3>(3 * mode) = slope.row(mode).transpose() / rest;
        whole += cell.bulk * along * along.transpose();
        add_volume_curvature(modes, cell.bulk * (volume / rest - 1) / rest, whole);
        if (curvature == solve::Curvature::kPositive) whole = positive_part(whole);

        Eigen::Matrix<double, 21, 24> onto = Eigen::Matrix<double, 21, 24>::Zero();
        for (int mode = 0; mode < kModes; ++mode)
            for (int n = 0; n < 8; ++n)
                onto.block<3, 3>(3 * mode, 3 * n) = mode_matrix()(mode, n) * Mat3::Identity();
        const Eigen::Matrix<double, 24, 24, Eigen::RowMajor> dense =
            onto.transpose() * whole * onto;
        hessian.add_dense(cell.node.data(), 8, dense.data());
    }
}

void BendingCells::add_metric(double /*step_s*/, solve::MetricBuilder& metric) const {
    constexpr int kModesOfTangent[3][4] = {{a, d, e, k}, {b, d, f, k}, {c, e, f, k}};
    for (const Cell& cell : cells_) {
        Eigen::Matrix<double, 8, 8, Eigen::RowMajor> block =
            Eigen::Matrix<double, 8, 8, Eigen::RowMajor>::Zero();
        const double stiffness = 2 * cell.mu * cell.plane + cell.bulk;
        for (int axis = 0; axis < 3; ++axis)
            for (const int mode : kModesOfTangent[axis]) {
                const auto row = mode_matrix().row(mode);
                block += stiffness / (cell.edges[axis] * cell.edges[axis]) * row.transpose() * row;
            }
        metric.add_block(cell.node.data(), block.data(), 8);
    }
}

}  // namespace risorius::tissue
