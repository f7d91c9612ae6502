// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/metric_elements.h"

#include <Eigen/Eigenvalues>

namespace risorius::tissue {

namespace {

using Element = MetricElements::Element;
using Tangents = Eigen::Matrix<double, 3, 2>;

Tangents tangents(const Element& element, const Points& x) {
    Tangents r = Tangents::Zero();
    for (int k = 0; k < element.count; ++k)
        for (int i = 0; i < 2; ++i)
            r.col(i) += element.d[i][k] * x.row(element.node[k]).transpose();
    return r;
}

Mat2 metric(const Element& element, const Points& x) {
    const Tangents r = tangents(element, x);
    return r.transpose() * r;
}

/// dG/dt
Mat2 rate(const Element& element, const Tangents& r, const Points& v) {
    const Mat2 half = tangents(element, v).transpose() * r;
    return half + half.transpose();
}

/// Adds `sign` times the derivative by the nodes of an energy whose derivative by the tangents is r stress.
void add_to_nodes(const Element& element, const Tangents& r, const Mat2& stress, double sign,
                  Points& out) {
    const Tangents p = sign * (r * stress);
    for (int k = 0; k < element.count; ++k)
        for (int i = 0; i < 2; ++i)
            out.row(element.node[k]) += element.d[i][k] * p.col(i).transpose();
}

Mat2 tension_only(const Mat2& s) {
    Eigen::SelfAdjointEigenSolver<Mat2> eigen;
    eigen.computeDirect(s);  // closed form
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
           eigen.eigenvectors().transpose();
}

}  // namespace

void MetricElements::add(Element element, const Points& rest) {
    element.rest_metric = metric(element, rest);
    elements_.push_back(element);
}

double MetricElements::energy(const Points& x) const {
    double energy = 0;
    for (const Element& element : elements_) {
        const Mat2 change = metric(element, x) - element.rest_metric;
        energy += 0.25 * element.eta.cwiseProduct(change.cwiseAbs2()).sum();
    }
    return energy;
}

void MetricElements::add_force(const Points& x, const Points& v, Points& force) const {
    for (const Element& element : elements_) {
        const Tangents r = tangents(element, x);
        const Mat2 stress = element.eta.cwiseProduct(r.transpose() * r - element.rest_metric) +
                            element.phi.cwiseProduct(rate(element, r, v));
        add_to_nodes(element, r, stress, -1, force);
    }
}

double MetricElements::add_potential(const solve::ImplicitStep& step, const Points& x,
                                     Points& gradient) const {
    const double rate_hz = step.rate_hz();
    double energy = 0;
    for (const Element& element : elements_) {
        const Tangents r = tangents(element, x);
        const Mat2 g = r.transpose() * r;
        const Mat2 strain = g - element.rest_metric;
        Mat2 stress = element.eta.cwiseProduct(strain);
        energy += 0.25 * stress.cwiseProduct(strain).sum();
        if (rate_hz > 0) {
            const Mat2 moved = g - metric(element, step.start);
            const Mat2 viscous = rate_hz * element.phi.cwiseProduct(moved);
            energy += 0.25 * viscous.cwiseProduct(moved).sum();
            stress += viscous;
        }
        add_to_nodes(element, r, stress, 1, gradient);
    }
    return energy;
}

void MetricElements::add_hessian(const solve::ImplicitStep& step, const Points& x,
                                 solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    const double rate_hz = step.rate_hz();
    for (const Element& element : elements_) {
        const Tangents r = tangents(element, x);
        const Mat2 g = r.transpose() * r;
        Mat2 stress = element.eta.cwiseProduct(g - element.rest_metric);
        Mat2 stiffness = element.eta;
        if (rate_hz > 0) {
            stress += rate_hz * element.phi.cwiseProduct(g - metric(element, step.start));
            stiffness += rate_hz * element.phi;
        }
        if (curvature == solve::Curvature::kPositive) stress = tension_only(stress);
        // Second derivative by r_1, r_2: stress (x) I + 1/2 sum k_ij g_ij g_ij^T, where g_ij is the gradient of G_ij.
        const Vec3 r1 = r.col(0), r2 = r.col(1);
        const double shear = stiffness(0, 1);
        Mat3 block[2][2];
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) block[a][b] = stress(a, b) * Mat3::Identity();
        block[0][0] += 2 * stiffness(0, 0) * r1 * r1.transpose() + shear * r2 * r2.transpose();
        block[1][1] += 2 * stiffness(1, 1) * r2 * r2.transpose() + shear * r1 * r1.transpose();
        block[0][1] += shear * r2 * r1.transpose();
        block[1][0] += shear * r1 * r2.transpose();
        for (int k = 0; k < element.count; ++k)
            for (int l = 0; l <= k; ++l) {
                Mat3 sum = Mat3::Zero();
                for (int a = 0; a < 2; ++a)
                    for (int b = 0; b < 2; ++b)
                        sum += element.d[a][k] * element.d[b][l] * block[a][b];
                hessian.add(element.node[k], element.node[l], sum);
            }
    }
}

void MetricElements::add_metric(double step_s, solve::MetricBuilder& builder) const {
    for (const Element& element : elements_) {
        // In the rest shape only 1/2 sum k_ij g_ij g_ij^T is left. (a + b)^2 <= 2 a^2 + 2 b^2 separates the shear.
        const Mat2 k = element.eta + element.phi / step_s;
        const Mat2& g = element.rest_metric;
        builder.add_outer(element.node, element.d[0], element.count,
                          2 * (k(0, 0) * g(0, 0) + k(0, 1) * g(1, 1)));
        builder.add_outer(element.node, element.d[1], element.count,
                          2 * (k(1, 1) * g(1, 1) + k(0, 1) * g(0, 0)));
    }
}

void MetricElements::add_secant(const Points& x, const Points& v, bool lag_rate,
                                solve::MetricBuilder& K, Points& force) const {
    for (const Element& element : elements_) {
        const Tangents r = tangents(element, x);
        const Mat2 viscous = element.phi.cwiseProduct(rate(element, r, v));
        Mat2 alpha = element.eta.cwiseProduct(r.transpose() * r - element.rest_metric);
        if (lag_rate)
            alpha += viscous;
        else
            add_to_nodes(element, r, viscous, -1, force);
        double block[9];
        for (int k = 0; k < element.count; ++k)
            for (int l = 0; l < element.count; ++l) {
                double sum = 0;
                for (int a = 0; a < 2; ++a)
                    for (int b = 0; b < 2; ++b)
                        sum += element.d[a][k] * element.d[b][l] * alpha(a, b);
                block[k * element.count + l] = sum;
            }
        K.add_block(element.node, block, element.count);
    }
}

}  // namespace risorius::tissue
