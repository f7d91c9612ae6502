// SPDX-License-Identifier: MIT
#include "risorius/tissue/hyperelastic.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "risorius/tissue/detail/principal_stretches.h"

namespace risorius::tissue {

namespace {

/// Stretches that differ by less than this share of their sum count as equal.
constexpr double kEqual = 1e-6;

/// An isotropic energy as a function of the three stretches of F, with its derivatives.
struct StretchEnergy {
    double value = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();

    /// Adds c (J^-p g(s) - rest), with the derivatives of g.
    void add(double c, double p, double g, const Vec3& dg, const Mat3& ddg, const Vec3& s,
             double rest) {
        const double scale = c * std::pow(s.prod(), -p);
        const Vec3 inverse = s.cwiseInverse();
        value += scale * g - c * rest;
        first += scale * (dg - p * g * inverse);
        second += scale * (ddg - p * (dg * inverse.transpose() + inverse * dg.transpose()) +
                           p * p * g * inverse * inverse.transpose());
        second.diagonal() += scale * p * g * inverse.cwiseAbs2();
    }
};

StretchEnergy stretch_energy(const Hyperelastic& material, const Vec3& s) {
    StretchEnergy out;
    if (material.c10_pa != 0)
        out.add(material.c10_pa, 2.0 / 3, s.squaredNorm(), 2 * s, 2 * Mat3::Identity(), s, 3);
    if (material.c01_pa != 0) {
        const Vec3 q = s.cwiseAbs2();
        const Vec3 others = Vec3::Constant(q.sum()) - q;
        Mat3 second = 4 * s * s.transpose();
        second.diagonal() = 2 * others;
        out.add(material.c01_pa, 4.0 / 3, q[0] * q[1] + q[1] * q[2] + q[2] * q[0],
                2 * s.cwiseProduct(others), second, s, 3);
    }
    for (const OgdenTerm& term : material.ogden) {
        const double a = term.exponent;
        const Vec3 power = s.array().pow(a);
        const Vec3 first = a * power.cwiseQuotient(s);
        const Mat3 second = ((a - 1) * first.cwiseQuotient(s)).asDiagonal();
        out.add(term.modulus_pa / a, a / 3, power.sum(), first, second, s, 3);
    }
    const double volume = s.prod(), b = material.bulk_pa;
    const Vec3 gradient = volume * s.cwiseInverse();
    out.value += 0.5 * b * (volume - 1) * (volume - 1);
    out.first += b * (volume - 1) * gradient;
    out.second += b * gradient * gradient.transpose();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i != j) out.second(i, j) += b * (volume - 1) * s[3 - i - j];
    return out;
}

detail::StretchModes modes_of(const StretchEnergy& energy, const Vec3& s) {
    detail::StretchModes out;
    out.along = energy.second;
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double difference = s[i] - s[j], sum = s[i] + s[j];
        out.symmetric[k] =
            std::abs(difference) > kEqual * sum
                ? (energy.first[i] - energy.first[j]) / difference
                : 0.5 * (energy.second(i, i) + energy.second(j, j)) - energy.second(i, j);
        out.antisymmetric[k] = (energy.first[i] + energy.first[j]) / sum;
    }
    return out;
}

/// The energy of fibres by their stretch l, with its derivatives.
struct FibreEnergy {
    double value = 0, first = 0, second = 0;
};

FibreEnergy fibre_energy(const FibreLaw& law, double l) {
    FibreEnergy out;
    if (law.c3_pa == 0 || l <= 1) return out;
    // l W' = tension; W is its integral, with the exponential integral Ei.
    const double end = std::min(l, law.straight);
    const double tension = law.c3_pa * std::expm1(law.c4 * (end - 1));
    out.value = law.c3_pa * (std::exp(-law.c4) * (std::expint(law.c4 * end) - std::expint(law.c4)) -
                             std::log(end));
    if (l <= law.straight) {
        out.first = tension / l;
        out.second = (law.c3_pa * law.c4 * std::exp(law.c4 * (l - 1)) - out.first) / l;
        return out;
    }
    const double c6 = tension - law.c5_pa * end;
    out.value += law.c5_pa * (l - end) + c6 * std::log(l / end);
    out.first = law.c5_pa + c6 / l;
    out.second = -c6 / (l * l);
    return out;
}

/// l and its gradient by F.
struct FibreStretch {
    double l;
    Mat3 gradient, inverse_transposed;
    Vec3 along;  ///< F a
};

FibreStretch fibre_stretch(const Mat3& f, const Vec3& a) {
    FibreStretch out;
    out.along = f * a;
    out.inverse_transposed = f.inverse().transpose();
    out.l = std::pow(f.determinant(), -1.0 / 3) * out.along.norm();
    out.gradient =
        out.l * (out.along * a.transpose() / out.along.squaredNorm() - out.inverse_transposed / 3);
    return out;
}

}  // namespace

double Hyperelastic::shear_pa() const {
    double sum = 2 * (c10_pa + c01_pa);
    for (const OgdenTerm& term : ogden) sum += 0.5 * term.modulus_pa * term.exponent;
    return sum;
}

Response response(const Hyperelastic& material, const Mat3& f, const Vec3& fibre) {
    Response out;
    if (!(f.determinant() > 0)) {
        out.energy_pa = std::numeric_limits<double>::infinity();
        return out;
    }
    const detail::PrincipalStretches stretches = detail::principal_stretches(f);
    const StretchEnergy energy = stretch_energy(material, stretches.sigma);
    out.energy_pa = energy.value;
    out.stress_pa = stretches.u * energy.first.asDiagonal() * stretches.v.transpose();
    if (material.fibres.c3_pa == 0) return out;
    const FibreStretch stretch = fibre_stretch(f, fibre);
    const FibreEnergy along = fibre_energy(material.fibres, stretch.l);
    out.energy_pa += along.value;
    out.stress_pa += along.first * stretch.gradient;
    return out;
}

Stiffness stiffness(const Hyperelastic& material, const Mat3& f, const Vec3& fibre) {
    Stiffness out = Stiffness::Zero();
    if (!(f.determinant() > 0)) return out;
    const detail::PrincipalStretches stretches = detail::principal_stretches(f);
    const Mat3 &u = stretches.u, &v = stretches.v;
    const detail::StretchModes modes =
        modes_of(stretch_energy(material, stretches.sigma), stretches.sigma);
    // What a change of each entry of F does, in the frame of the stretches.
    for (int column = 0; column < 9; ++column) {
        const Mat3 change = u.row(column % 3).transpose() * v.row(column / 3);
        Mat3 stress = Mat3::Zero();
        stress.diagonal() = modes.along * change.diagonal();
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            const double even = 0.5 * modes.symmetric[k] * (change(i, j) + change(j, i)),
                         odd = 0.5 * modes.antisymmetric[k] * (change(i, j) - change(j, i));
            stress(i, j) = even + odd;
            stress(j, i) = even - odd;
        }
        const Mat3 turned = u * stress * v.transpose();
        out.col(column) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(turned.data());
    }
    if (material.fibres.c3_pa == 0) return out;
    const FibreStretch stretch = fibre_stretch(f, fibre);
    const FibreEnergy along = fibre_energy(material.fibres, stretch.l);
    const Mat3 n = stretch.along * fibre.transpose(), &t = stretch.inverse_transposed,
               &g = stretch.gradient;
    const double squared = stretch.along.squaredNorm();
    for (int r = 0; r < 9; ++r)
        for (int c = 0; c < 9; ++c) {
            const int i = r % 3, k = r / 3, j = c % 3, m = c / 3;
            const double bend = (i == j ? fibre[k] * fibre[m] / squared : 0) -
                                2 * n(i, k) * n(j, m) / (squared * squared) + t(i, m) * t(j, k) / 3;
            out(r, c) += along.second * g(i, k) * g(j, m) +
                         along.first * (g(i, k) * g(j, m) / stretch.l + stretch.l * bend);
        }
    return out;
}

Mat3 cauchy_stress_pa(const Hyperelastic& material, const Mat3& f, const Vec3& fibre) {
    return response(material, f, fibre).stress_pa * f.transpose() / f.determinant();
}

}  // namespace risorius::tissue
