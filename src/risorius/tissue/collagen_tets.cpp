// SPDX-License-Identifier: MIT
#include "risorius/tissue/collagen_tets.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace risorius::tissue {

namespace {

constexpr double kLargestExponent = 6;  // k2 u^2 from which dW/du is a straight line

struct FibreEnergy {
    double energy_pa = 0, slope_pa = 0, curvature_pa = 0;  // W, dW/du, d2W/du2
};

FibreEnergy exponential(const CollagenFibres& fibres, double u) {
    const double exponent = fibres.k2 * u * u, growth = std::exp(exponent);
    return {.energy_pa = exponent < 1e-6 ? 0.5 * fibres.k1_pa * u * u * (1 + 0.5 * exponent)
                                         : 0.5 * fibres.k1_pa / fibres.k2 * std::expm1(exponent),
            .slope_pa = fibres.k1_pa * u * growth,
            .curvature_pa = fibres.k1_pa * growth * (1 + 2 * exponent)};
}

FibreEnergy fibre_energy(const CollagenFibres& fibres, double u) {
    if (!(u > 0)) return {};
    if (fibres.k2 * u * u <= kLargestExponent) return exponential(fibres, u);
    const double end = std::sqrt(kLargestExponent / fibres.k2), beyond = u - end;
    const FibreEnergy at = exponential(fibres, end);
    return {.energy_pa = at.energy_pa + beyond * (at.slope_pa + 0.5 * beyond * at.curvature_pa),
            .slope_pa = at.slope_pa + beyond * at.curvature_pa,
            .curvature_pa = at.curvature_pa};
}

Mat3 edges_from_first(const CollagenFibres& fibres, const Points& x) {
    Mat3 out;
    for (int k = 0; k < 3; ++k)
        out.col(k) = (x.row(fibres.nodes[k + 1]) - x.row(fibres.nodes[0])).transpose();
    return out;
}

}  // namespace

CollagenTets::CollagenTets(std::vector<CollagenFibres> fibres, const Points& rest)
    : fibres_(std::move(fibres)) {
    for (const CollagenFibres& one : fibres_) {
        const Mat3 edges = edges_from_first(one, rest);
        volume_m3_.push_back(edges.determinant() / 6);
        if (!(volume_m3_.back() > 0))
            throw std::invalid_argument("CollagenTets: tetrahedron " + std::to_string(one.tet) +
                                        " has no positive volume");
        inverse_.push_back(edges.inverse());
        Eigen::Vector4d rate;
        rate.tail<3>() = inverse_.back() * one.along;
        rate[0] = -rate.tail<3>().sum();
        rate_.push_back(rate);
    }
}

Vec3 CollagenTets::moved(const Points& x, std::size_t i) const {
    Vec3 out = Vec3::Zero();
    for (int k = 0; k < 4; ++k) out += rate_[i][k] * x.row(fibres_[i].nodes[k]).transpose();
    return out;
}

double CollagenTets::stretch(const Points& x, std::size_t i) const { return moved(x, i).norm(); }

Mat3 CollagenTets::cauchy_stress_pa(const Points& x, std::size_t i) const {
    const Vec3 fa = moved(x, i);
    const double change = (edges_from_first(fibres_[i], x) * inverse_[i]).determinant();
    return 2 * fibre_energy(fibres_[i], fa.squaredNorm() - 1).slope_pa / change * fa *
           fa.transpose();
}

double CollagenTets::add_potential(const solve::ImplicitStep& /*step*/, const Points& x,
                                   Points& gradient) const {
    double energy = 0;
    for (std::size_t i = 0; i < fibres_.size(); ++i) {
        const Vec3 fa = moved(x, i);
        const FibreEnergy at = fibre_energy(fibres_[i], fa.squaredNorm() - 1);
        if (at.energy_pa == 0) continue;
        energy += volume_m3_[i] * at.energy_pa;
        for (int k = 0; k < 4; ++k)
            gradient.row(fibres_[i].nodes[k]) +=
                2 * volume_m3_[i] * at.slope_pa * rate_[i][k] * fa.transpose();
    }
    return energy;
}

// Positive as it is: slope and curvature are never negative.
void CollagenTets::add_hessian(const solve::ImplicitStep& /*step*/, const Points& x,
                               solve::Curvature /*curvature*/,
                               solve::HessianBuilder& hessian) const {
    for (std::size_t i = 0; i < fibres_.size(); ++i) {
        const Vec3 fa = moved(x, i);
        const FibreEnergy at = fibre_energy(fibres_[i], fa.squaredNorm() - 1);
        const Mat3 block = volume_m3_[i] * (2 * at.slope_pa * Mat3::Identity() +
                                            4 * at.curvature_pa * fa * fa.transpose());
        // Slack fibres are added too, so that the pattern of the matrix stays
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b <= a; ++b)
                hessian.add(fibres_[i].nodes[a], fibres_[i].nodes[b],
                            rate_[i][a] * rate_[i][b] * block);
    }
}

void CollagenTets::add_metric(double /*step_s*/, solve::MetricBuilder& metric) const {
    for (std::size_t i = 0; i < fibres_.size(); ++i) {
        const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block =
            4 * volume_m3_[i] * fibres_[i].k1_pa * rate_[i] * rate_[i].transpose();
        metric.add_block(fibres_[i].nodes, block.data(), 4);
    }
}

}  // namespace risorius::tissue
