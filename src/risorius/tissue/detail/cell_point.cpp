// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/cell_point.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace risorius::tissue::detail {

namespace {

using Derivatives = Eigen::Matrix<double, 3, 8>;

/// Tangent and stress at one Gauss point: s = D : dG. Everything is multiplied by the weight of the point.
struct PointLaw {
    bool physical;
    Mat3 elastic, damping;  ///< lambda, omega; or C twice, with its factors in mu and eta
    double mu = 0, eta = 0;

    PointLaw(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest, int g)
        : physical(law.physical) {
        const double weight = size.prod() / 8;
        if (!physical) {
            elastic = weight * law.parameters.elastic_n_per_m3;
            damping = weight * law.parameters.damping_ns_per_m3;
            return;
        }
        const Mat3 r = tangents_at(rest, size, g);
        elastic = damping = (r.transpose() * r).inverse();
        const double volume = weight * r.determinant();
        mu = law.moduli.mu_pa * volume;
        eta = law.moduli.viscosity_pa_s * volume;
    }

    Mat3 elastic_stress(const Mat3& strain) const {
        return physical ? Mat3(mu * elastic * strain * elastic) : elastic.cwiseProduct(strain);
    }
    Mat3 viscous_stress(const Mat3& rate) const {
        return physical ? Mat3(eta * damping * rate * damping) : damping.cwiseProduct(rate);
    }

    /// d(s_ik r_k)/dr_j without the term of s itself: the effect of the change of G.
    Mat3 block(int i, int j, const Mat3& r, double rate_hz) const {
        if (physical) {
            const Mat3 rc = r * elastic;
            return (mu + eta * rate_hz) *
                   (elastic(i, j) * (rc * r.transpose()) + rc.col(j) * rc.col(i).transpose());
        }
        const Mat3 d = elastic + rate_hz * damping;
        Mat3 sum = d(i, j) * r.col(j) * r.col(i).transpose();
        if (i == j)
            for (int k = 0; k < 3; ++k) sum += d(i, k) * r.col(k) * r.col(k).transpose();
        return sum;
    }
};

Mat3 skew(const Vec3& v) {
    Mat3 m;
    m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return m;
}

Mat3 cofactor_columns(const Mat3& r) {
    Mat3 c;
    c << r.col(1).cross(r.col(2)), r.col(2).cross(r.col(0)), r.col(0).cross(r.col(1));
    return c;
}

struct CellVolume {
    double volume = 0;
    Eigen::Matrix<double, 3, 8> gradient = Eigen::Matrix<double, 3, 8>::Zero();

    CellVolume(const CellCorners& corners, const Vec3& size) {
        const double weight = size.prod() / 8;
        for (int g = 0; g < 8; ++g) {
            const Derivatives dn = shape_derivatives(size, g);
            const Mat3 r = corners.x * dn.transpose();
            volume += weight * r.determinant();
            gradient += weight * cofactor_columns(r) * dn;
        }
    }
};

}  // namespace

Derivatives shape_derivatives(const Vec3& size, int g) {
    constexpr double kXi = 0.57735026918962576451;  // 1 / sqrt 3
    Derivatives dn;
    for (int c = 0; c < 8; ++c) {
        double near[3], sign[3];
        for (int axis = 0; axis < 3; ++axis) {
            const int bit = 4 >> axis;
            sign[axis] = (c & bit) ? 1 : -1;
            near[axis] = 1 + ((c & bit) == (g & bit) ? kXi : -kXi);
        }
        for (int i = 0; i < 3; ++i)
            dn(i, c) = sign[i] * near[(i + 1) % 3] * near[(i + 2) % 3] / (4 * size[i]);
    }
    return dn;
}

Mat3 tangents_at(const CellCorners& corners, const Vec3& size, int g) {
    return corners.x * shape_derivatives(size, g).transpose();
}

Mat3 metric_at(const CellCorners& corners, const Vec3& size, int g) {
    const Mat3 r = tangents_at(corners, size, g);
    return r.transpose() * r;
}

double volume_stiffness(const CellMaterialLaw& law, const Vec3& size, double rest_volume) {
    return law.physical ? law.moduli.bulk_pa / (2 * rest_volume)
                        : law.parameters.incompressibility_n_per_m5 / size.prod();
}

void cell_stiffness(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                    const CellCorners& now, const RateReference* rate, solve::Curvature curvature,
                    CellStiffness& stiffness) {
    stiffness.setZero();
    const double rate_hz = rate ? rate->rate_hz : 0;
    const double rest_volume = CellVolume(rest, size).volume;
    const CellVolume volume(now, size);
    const double psi = volume_stiffness(law, size, rest_volume);
    const double weight = size.prod() / 8;
    const bool positive = curvature == solve::Curvature::kPositive;
    const double pressure = positive ? 0.0 : 2 * psi * (volume.volume - rest_volume) * weight;

    for (int g = 0; g < 8; ++g) {
        const Derivatives dn = shape_derivatives(size, g);
        const Mat3 r = now.x * dn.transpose();
        const PointLaw point(law, size, rest, g);
        const Mat3 metric = r.transpose() * r;
        Mat3 stress = point.elastic_stress(metric - metric_at(rest, size, g));
        if (rate)
            stress += rate_hz * point.viscous_stress(metric - metric_at(rate->start, size, g));
        if (positive) {
            const Eigen::SelfAdjointEigenSolver<Mat3> eigen(0.5 * (stress + stress.transpose()));
            stress = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                     eigen.eigenvectors().transpose();
        }
        Mat3 block[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                block[i][j] = point.block(i, j, r, rate_hz);
                block[i][j].diagonal().array() += stress(i, j);
                if (i != j) {
                    // det = r_i . (r_j x r_k) for cyclic i, j, k
                    const int k = 3 - i - j;
                    const double turn = (i + 1) % 3 == j ? -pressure : pressure;
                    block[i][j] += turn * skew(r.col(k));
                }
            }
        for (int v = 0; v < 8; ++v) {
            Mat3 row[3];
            for (int j = 0; j < 3; ++j)
                row[j] = dn(0, v) * block[0][j] + dn(1, v) * block[1][j] + dn(2, v) * block[2][j];
            for (int w = 0; w < 8; ++w)
                stiffness.block<3, 3>(3 * v, 3 * w) +=
                    dn(0, w) * row[0] + dn(1, w) * row[1] + dn(2, w) * row[2];
        }
    }
    const Eigen::Map<const Eigen::Matrix<double, 24, 1>> g(volume.gradient.data());
    stiffness += 2 * psi * g * g.transpose();
}

CellScalarMatrix cell_metric(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                             double rate_hz) {
    CellScalarMatrix matrix = CellScalarMatrix::Zero();
    for (int g = 0; g < 8; ++g) {
        const Derivatives dn = shape_derivatives(size, g);
        const PointLaw point(law, size, rest, g);
        if (point.physical) {
            matrix += 2 * (point.mu + rate_hz * point.eta) * dn.transpose() * point.elastic * dn;
            continue;
        }
        // For one coordinate u of the displacement along a tangent: lambda_ik G_kk (du/da_i)^2, twice where i = k.
        const Mat3 metric = metric_at(rest, size, g);
        const Mat3 d = point.elastic + rate_hz * point.damping;
        for (int i = 0; i < 3; ++i) {
            double max = 0;
            for (int k = 0; k < 3; ++k)
                max = std::max(max, d(i, k) * metric(k, k) * (i == k ? 2 : 1));
            matrix += max * dn.row(i).transpose() * dn.row(i);
        }
    }
    const CellVolume volume(rest, size);
    matrix += 2 * volume_stiffness(law, size, volume.volume) * volume.gradient.transpose() *
              volume.gradient;
    return matrix;
}

CellSecant cell_secant(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                       const CellCorners& now, const CellCorners& speed, bool lag_rate) {
    CellSecant secant{CellScalarMatrix::Zero(), Eigen::Matrix<double, 8, 3>::Zero()};
    for (int g = 0; g < 8; ++g) {
        const Derivatives dn = shape_derivatives(size, g);
        const PointLaw point(law, size, rest, g);
        const Mat3 r = now.x * dn.transpose(), rate = speed.x * dn.transpose();
        Mat3 stress = point.elastic_stress(r.transpose() * r - metric_at(rest, size, g));
        const Mat3 viscous = point.viscous_stress(rate.transpose() * r + r.transpose() * rate);
        if (lag_rate)
            stress += viscous;
        else
            secant.force -= (r * viscous * dn).transpose();
        secant.matrix += dn.transpose() * stress * dn;
    }
    const double rest_volume = CellVolume(rest, size).volume;
    const CellVolume volume(now, size);
    secant.force -= 2 * volume_stiffness(law, size, rest_volume) * (volume.volume - rest_volume) *
                    volume.gradient.transpose();
    return secant;
}

}  // namespace risorius::tissue::detail
