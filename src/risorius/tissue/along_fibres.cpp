// SPDX-License-Identifier: MIT
#include "risorius/tissue/along_fibres.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "risorius/core/dense_algebra.h"

namespace risorius::tissue {

namespace {

Mat3 gradient_at(const StrainPoint& point, const Points& x) {
    Mat3 f = Mat3::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
        f += x.row(point.node[k]).transpose() * point.gradient[k].transpose();
    return f;
}

/// dW/d(a . C a) of the stretch, and its derivative, for a . C a = `squared`.
std::array<double, 2> slopes_of_stretch(double stretch_pa, double squared) {
    if (!(squared > 1)) return {0, 0};
    const double stretch = std::sqrt(squared);
    return {0.5 * stretch_pa * (1 - 1 / stretch), 0.25 * stretch_pa / (squared * stretch)};
}

/// dW/dC, symmetric, for b = C a.
Mat3 slope_by_metric(const AlongFibres::Moduli& moduli, const Vec3& a, const Vec3& b) {
    const double squared = a.dot(b);
    const Mat3 n = a * a.transpose();
    return 0.5 * moduli.shear_pa * (a * b.transpose() + b * a.transpose() - 2 * squared * n) +
           slopes_of_stretch(moduli.stretch_pa, squared)[0] * n;
}

double density_of(const AlongFibres::Moduli& moduli, const Vec3& a, const Vec3& b) {
    const double squared = a.dot(b), longer = std::max(std::sqrt(squared) - 1, 0.0);
    return 0.5 * moduli.shear_pa * (b.squaredNorm() - squared * squared) +
           0.5 * moduli.stretch_pa * longer * longer;
}

using Stiffness9 = Eigen::Matrix<double, 9, 9>;

/// d2W/dF2; entry (3 k + i, 3 l + j) is for F_ik and F_jl.
Stiffness9 stiffness_at(const AlongFibres::Moduli& moduli, const Mat3& f, const Vec3& a) {
    const Vec3 b = f.transpose() * (f * a);
    const Mat3 slope = slope_by_metric(moduli, a, b), n = a * a.transpose();
    const double stiffness_pa = slopes_of_stretch(moduli.stretch_pa, a.dot(b))[1];
    Stiffness9 out;
    for (int column = 0; column < 9; ++column) {
        Mat3 change = Mat3::Zero();
        change(column % 3, column / 3) = 1;
        const Mat3 metric = change.transpose() * f + f.transpose() * change;
        const Vec3 moved = metric * a;
        const double squared = a.dot(moved);
        const Mat3 turn = 0.5 * moduli.shear_pa *
                              (a * moved.transpose() + moved * a.transpose() - 2 * squared * n) +
                          stiffness_pa * squared * n;
        const Mat3 stress = 2 * change * slope + 2 * f * turn;
        out.col(column) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(stress.data());
    }
    return out;
}

/// Adds one point to the stiffness of its nodes, 3 x 3 blocks.
void add_point(const StrainPoint& point, const Stiffness9& stiffness, Mat3 (&blocks)[8][8]) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(point.count); ++a) {
        Eigen::Matrix<double, 3, 9> row = Eigen::Matrix<double, 3, 9>::Zero();
        for (int p = 0; p < 3; ++p) row += point.gradient[a][p] * stiffness.block<3, 9>(3 * p, 0);
        for (std::size_t b = 0; b <= a; ++b)
            for (int q = 0; q < 3; ++q)
                blocks[a][b] += point.volume_m3 * point.gradient[b][q] * row.block<3, 3>(0, 3 * q);
    }
}

}  // namespace

std::vector<StrainPoint> strain_points(const CellMesh& mesh, const Points& rest) {
    if (!mesh.hanging().empty())
        throw std::invalid_argument("strain_points: a mesh with hanging vertices");
    std::vector<StrainPoint> out;
    for (const CellMesh::Cell& cell : mesh.cells()) {
        const double s[3] = {0.5, 0.5, 0.5};
        StrainPoint point{.count = 8, .node = cell.vertex};
        Mat3 tangents = Mat3::Zero();
        std::array<Vec3, 8> slopes;
        for (std::size_t c = 0; c < 8; ++c) {
            const double f[3] = {c & 4 ? s[0] : 1 - s[0], c & 2 ? s[1] : 1 - s[1],
                                 c & 1 ? s[2] : 1 - s[2]};
            slopes[c] = {(c & 4 ? 1 : -1) * f[1] * f[2], (c & 2 ? 1 : -1) * f[0] * f[2],
                         (c & 1 ? 1 : -1) * f[0] * f[1]};
            tangents += rest.row(cell.vertex[c]).transpose() * slopes[c].transpose();
        }
        point.volume_m3 = tangents.determinant();
        if (!(point.volume_m3 > 0)) throw std::invalid_argument("strain_points: a folded cell");
        const Mat3 inverse = tangents.inverse().transpose();
        for (std::size_t c = 0; c < 8; ++c) point.gradient[c] = inverse * slopes[c];
        point.along = tangents.col(0).normalized();
        out.push_back(point);
    }
    return out;
}

std::vector<StrainPoint> strain_points(const Tets& tets, const Points& rest, const Points& fibres) {
    std::vector<StrainPoint> out;
    for (Eigen::Index t = 0; t < tets.rows(); ++t) {
        StrainPoint point{.count = 4};
        Mat3 edges;
        for (int k = 0; k < 3; ++k)
            edges.col(k) = (rest.row(tets(t, k + 1)) - rest.row(tets(t, 0))).transpose();
        point.volume_m3 = edges.determinant() / 6;
        if (!(point.volume_m3 > 0))
            throw std::invalid_argument("strain_points: a tetrahedron without volume");
        const Mat3 inverse = edges.inverse();
        point.gradient[0] = -inverse.colwise().sum().transpose();
        for (int k = 0; k < 4; ++k) {
            point.node[static_cast<std::size_t>(k)] = tets(t, k);
            if (k > 0) point.gradient[static_cast<std::size_t>(k)] = inverse.row(k - 1).transpose();
        }
        point.along = fibres.row(t).transpose();
        out.push_back(point);
    }
    return out;
}

AlongFibres::AlongFibres(std::vector<StrainPoint> points, const Moduli& moduli)
    : points_(std::move(points)), moduli_(moduli) {
    if (!(moduli.shear_pa >= 0) || !(moduli.stretch_pa >= 0))
        throw std::invalid_argument("AlongFibres: a modulus below 0");
}

double AlongFibres::add_potential(const solve::ImplicitStep& /*step*/, const Points& x,
                                  Points& gradient) const {
    double energy = 0;
    for (const StrainPoint& point : points_) {
        const Mat3 f = gradient_at(point, x);
        const Vec3 b = f.transpose() * (f * point.along);
        energy += point.volume_m3 * density_of(moduli_, point.along, b);
        const Mat3 stress = 2 * point.volume_m3 * f * slope_by_metric(moduli_, point.along, b);
        for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
            gradient.row(point.node[k]) += (stress * point.gradient[k]).transpose();
    }
    return energy;
}

void AlongFibres::add_hessian(const solve::ImplicitStep& /*step*/, const Points& x,
                              solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    for (const StrainPoint& point : points_) {
        Stiffness9 stiffness = stiffness_at(moduli_, gradient_at(point, x), point.along);
        if (curvature == solve::Curvature::kPositive) stiffness = positive_part(stiffness);
        Mat3 blocks[8][8];
        for (auto& row : blocks)
            for (Mat3& block : row) block.setZero();
        add_point(point, stiffness, blocks);
        for (std::size_t a = 0; a < static_cast<std::size_t>(point.count); ++a)
            for (std::size_t b = 0; b <= a; ++b)
                hessian.add(point.node[a], point.node[b], blocks[a][b]);
    }
}

void AlongFibres::add_metric(double /*step_s*/, solve::MetricBuilder& metric) const {
    for (const StrainPoint& point : points_) {
        const auto count = static_cast<std::size_t>(point.count);
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> used(point.count,
                                                                                    point.count);
        for (std::size_t a = 0; a < count; ++a)
            for (std::size_t b = 0; b < count; ++b)
                used(static_cast<int>(a), static_cast<int>(b)) =
                    point.volume_m3 * (moduli_.shear_pa + moduli_.stretch_pa) *
                    point.gradient[a].dot(point.gradient[b]);
        metric.add_block(point.node.data(), used.data(), point.count);
    }
}

Mat3 AlongFibres::cauchy_stress_pa(const Moduli& moduli, const Mat3& f, const Vec3& along) {
    const Vec3 b = f.transpose() * (f * along);
    return 2 / f.determinant() * f * slope_by_metric(moduli, along, b) * f.transpose();
}

}  // namespace risorius::tissue
