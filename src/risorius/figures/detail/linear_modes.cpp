// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/linear_modes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "risorius/core/dense_algebra.h"

namespace risorius::figures {
namespace {

using Complex = std::complex<double>;

/// Largest |eigenvalue| of a complex matrix. The eigenvalues of ((Re, -Im), (Im, Re)) are those of the matrix and their
/// conjugates.
double largest(const Eigen::Matrix4cd& matrix) {
    Eigen::MatrixXd doubled(8, 8);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            doubled(i, j) = doubled(4 + i, 4 + j) = matrix(i, j).real();
            doubled(4 + i, j) = matrix(i, j).imag();
            doubled(i, 4 + j) = -matrix(i, j).imag();
        }
    double max = 0;
    for (const Complex& value : eigenvalues(doubled)) max = std::max(max, std::abs(value));
    return max;
}

/// Largest |root| of z^4 = c3 z^3 + c2 z^2 + c1 z + c0.
double max_root(Complex c3, Complex c2, Complex c1, Complex c0) {
    Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero();
    companion.row(0) << c3, c2, c1, c0;
    companion(1, 0) = companion(2, 1) = companion(3, 2) = 1;
    return largest(companion);
}

/// Stoermer's method r+ = 2 r - r- + h^2 a with the damping of (r - r-)/h. A pair of conjugate eigenvalues is one oscillator with
/// w^2 = |lambda|^2 and d = -2 Re lambda; a real eigenvalue counts as pure damping.
double verlet_growth(Complex lambda, double h) {
    const bool oscillates = std::abs(lambda.imag()) > 1e-9 * std::abs(lambda);
    const double w2 = oscillates ? std::norm(lambda) : 0;
    const double d = oscillates ? -2 * lambda.real() : -lambda.real();
    const Complex half = 0.5 * (2 - h * h * w2 - h * d);
    const Complex root = std::sqrt(half * half - (1 - h * d));
    return std::max(std::abs(half + root), std::abs(half - root));
}

}  // namespace

std::vector<Complex> small_motions(const softbody::SoftBody& body, const Points& x) {
    std::vector<int> free;
    for (int i = 0; i < body.system.size(); ++i)
        if (!body.system.fixed()[static_cast<std::size_t>(i)]) free.push_back(i);
    const long n = 3 * static_cast<long>(free.size());
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    motion.topRightCorner(n, n).setIdentity();

    const double step_m = 1e-6 * body.length_scale_m;  // central differences: error about 1e-9 of K
    Points shifted = x, plus, minus;
    Points v = Points::Zero(x.rows(), 3);
    const auto column = [&](double step) {
        Eigen::VectorXd change(n);
        for (std::size_t k = 0; k < free.size(); ++k)
            change.segment<3>(3 * static_cast<long>(k)) =
                (plus.row(free[k]) - minus.row(free[k])).transpose() / (2 * step);
        return change;
    };
    for (long c = 0; c < n; ++c) {
        const int node = free[static_cast<std::size_t>(c / 3)];
        const int axis = static_cast<int>(c % 3);
        shifted(node, axis) = x(node, axis) + step_m;
        body.system.acceleration(0, shifted, v, plus);
        shifted(node, axis) = x(node, axis) - step_m;
        body.system.acceleration(0, shifted, v, minus);
        shifted(node, axis) = x(node, axis);
        motion.block(n, c, n, 1) = column(step_m);

        v(node, axis) = step_m;
        body.system.acceleration(0, x, v, plus);
        v(node, axis) = -step_m;
        body.system.acceleration(0, x, v, minus);
        v(node, axis) = 0;
        motion.block(n, n + c, n, 1) = column(step_m);
    }
    return eigenvalues(motion);
}

double growth_per_step(solve::Method method, Complex lambda, double step_s) {
    const Complex z = step_s * lambda;
    switch (method) {
        case solve::Method::kEuler:
            return std::abs(1.0 + z);
        case solve::Method::kRungeKutta2:
            return std::abs(1.0 + z * (1.0 + z / 2.0));
        case solve::Method::kRungeKutta4:
            return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
        case solve::Method::kCashKarp: {
            // A method of order 5 with six stages: the last coefficient is the product of the weights along the chain of stages.
            const double last = 512.0 / 1771 * 253.0 / 4096 * 35.0 / 27 * 6.0 / 5 * 9.0 / 40 / 5;
            const Complex z2 = z * z;
            return std::abs(1.0 + z + z2 / 2.0 + z2 * z / 6.0 + z2 * z2 / 24.0 +
                            z2 * z2 * z / 120.0 + last * z2 * z2 * z2);
        }
        case solve::Method::kVerlet:
            return verlet_growth(lambda, step_s);
        case solve::Method::kAdamsBashforth:
            return max_root(1.0 + 55.0 / 24 * z, -59.0 / 24 * z, 37.0 / 24 * z, -9.0 / 24 * z);
        case solve::Method::kAdamsMoulton: {
            // Predict, evaluate, correct, evaluate (PECE).
            const Complex p = 9.0 / 24 * z;
            return max_root(1.0 + p * (1.0 + 55.0 / 24 * z) + 19.0 / 24 * z,
                            -p * 59.0 / 24.0 * z - 5.0 / 24 * z, p * 37.0 / 24.0 * z + 1.0 / 24 * z,
                            -p * 9.0 / 24.0 * z);
        }
        default:
            throw std::invalid_argument(
                "growth_per_step: expected an explicit method of fixed step");
    }
}

bool stays_bounded(solve::Method method, const std::vector<Complex>& lambdas, double step_s,
                   double duration_s, double factor) {
    const double max = std::log(factor) * step_s / duration_s;
    for (const Complex& lambda : lambdas)
        if (std::log(growth_per_step(method, lambda, step_s)) > max) return false;
    return true;
}

}  // namespace risorius::figures
