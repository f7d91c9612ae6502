// SPDX-License-Identifier: MIT
#include "risorius/tissue/hyperelastic_tets.h"

#include <Eigen/LU>
#include <stdexcept>
#include <string>
#include <utility>

#include "risorius/core/dense_algebra.h"

namespace risorius::tissue {

namespace {

Mat3 edges_of(const Tets& tets, const Points& x, int tet) {
    Mat3 out;
    for (int k = 0; k < 3; ++k)
        out.col(k) = (x.row(tets(tet, k + 1)) - x.row(tets(tet, 0))).transpose();
    return out;
}

}  // namespace

HyperelasticTets::HyperelasticTets(HyperelasticBody body) : body_(std::move(body)) {
    const auto count = body_.tets.rows();
    if (static_cast<Eigen::Index>(body_.material_of.size()) != count ||
        (body_.fibres.rows() != 0 && body_.fibres.rows() != count))
        throw std::invalid_argument(
            "HyperelasticTets: a material, and a fibre or none, is needed for each tetrahedron");
    rest_volume_.resize(count);
    for (int t = 0; t < static_cast<int>(count); ++t) {
        const Mat3 edges = edges_of(body_.tets, body_.rest, t);
        rest_volume_[t] = edges.determinant() / 6;
        if (!(rest_volume_[t] > 0))
            throw std::invalid_argument("HyperelasticTets: tetrahedron " + std::to_string(t) +
                                        " has no positive volume");
        inverse_.push_back(edges.inverse());
    }
}

Mat3 HyperelasticTets::deformation_gradient(const Points& x, int tet) const {
    return edges_of(body_.tets, x, tet) * inverse_[static_cast<std::size_t>(tet)];
}

Mat3 HyperelasticTets::cauchy_stress_pa(const Points& x, int tet) const {
    return tissue::cauchy_stress_pa(material(tet), deformation_gradient(x, tet), fibre(tet));
}

double HyperelasticTets::volume(const Points& x) const {
    double sum = 0;
    for (int t = 0; t < static_cast<int>(body_.tets.rows()); ++t)
        sum += edges_of(body_.tets, x, t).determinant() / 6;
    return sum;
}

Eigen::Matrix<double, 4, 3> HyperelasticTets::gradients(int tet) const {
    Eigen::Matrix<double, 4, 3> out;
    out.bottomRows<3>() = inverse_[static_cast<std::size_t>(tet)];
    out.row(0) = -out.bottomRows<3>().colwise().sum();
    return out;
}

double HyperelasticTets::add_potential(const solve::ImplicitStep& /*step*/, const Points& x,
                                       Points& gradient) const {
    double energy = 0;
    for (int t = 0; t < static_cast<int>(body_.tets.rows()); ++t) {
        const Response at = response(material(t), deformation_gradient(x, t), fibre(t));
        energy += rest_volume_[t] * at.energy_pa;
        const Eigen::Matrix<double, 4, 3> pull =
            rest_volume_[t] * gradients(t) * at.stress_pa.transpose();
        for (int k = 0; k < 4; ++k) gradient.row(body_.tets(t, k)) += pull.row(k);
    }
    return energy;
}

void HyperelasticTets::add_hessian(const solve::ImplicitStep& /*step*/, const Points& x,
                                   solve::Curvature curvature,
                                   solve::HessianBuilder& hessian) const {
    for (int t = 0; t < static_cast<int>(body_.tets.rows()); ++t) {
        Stiffness k = stiffness(material(t), deformation_gradient(x, t), fibre(t));
        if (curvature == solve::Curvature::kPositive) k = positive_part(k);
        const Eigen::Matrix<double, 4, 3> g = gradients(t);
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b <= a; ++b) {
                Mat3 block = Mat3::Zero();
                for (int p = 0; p < 3; ++p)
                    for (int q = 0; q < 3; ++q)
                        block += g(a, p) * g(b, q) * k.block<3, 3>(3 * p, 3 * q);
                hessian.add(body_.tets(t, a), body_.tets(t, b), rest_volume_[t] * block);
            }
    }
}

void HyperelasticTets::add_metric(double /*step_s*/, solve::MetricBuilder& metric) const {
    for (int t = 0; t < static_cast<int>(body_.tets.rows()); ++t) {
        const Hyperelastic& of = material(t);
        const double weight = rest_volume_[t] * (4.0 / 3 * of.shear_pa() + of.bulk_pa +
                                                 of.fibres.c3_pa * of.fibres.c4);
        const Eigen::Matrix<double, 4, 3> g = gradients(t);
        const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block = weight * g * g.transpose();
        const int nodes[4] = {body_.tets(t, 0), body_.tets(t, 1), body_.tets(t, 2),
                              body_.tets(t, 3)};
        metric.add_block(nodes, block.data(), 4);
    }
}

}  // namespace risorius::tissue
