// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "risorius/core/error.h"
#include "risorius/tissue/detail/material_checks.h"

namespace risorius::tissue {

namespace {

constexpr double kRounding = 0.1;  ///< fraction of the rest bend

void check_material(const CurveMaterial& material, const std::string& place) {
    check_range(material.elastic_n_per_m3, /*zero_allowed=*/true, place + "/elastic_n_per_m3");
    check_range(material.damping_ns_per_m3, /*zero_allowed=*/true, place + "/damping_ns_per_m3");
    check_range(material.bending_n_per_m, /*zero_allowed=*/true, place + "/bending_n_per_m");
    check_range(material.mass_kg, /*zero_allowed=*/false, place + "/mass_kg");
    check_range(material.drag_ns_per_m, /*zero_allowed=*/true, place + "/drag_ns_per_m");
}

const CurveMaterial& material_of(const GridCurve& curve, Eigen::Index node) {
    assert(!curve.material.empty());
    return curve.material.size() == 1 ? curve.material.front()
                                      : curve.material[static_cast<std::size_t>(node)];
}

}  // namespace

CurveMaterial rod_material(double tension_stiffness_n, double bending_stiffness_n_m2,
                           double length_m) {
    const double cubed = length_m * length_m * length_m;
    CurveMaterial material;
    material.elastic_n_per_m3 = tension_stiffness_n / (2 * cubed);
    material.bending_n_per_m = bending_stiffness_n_m2 / cubed;
    return material;
}

Points line_rest(int nodes, const Vec3& from, const Vec3& to) {
    Points rest(nodes, 3);
    for (int i = 0; i < nodes; ++i)
        rest.row(i) = (from + (to - from) * (static_cast<double>(i) / (nodes - 1))).transpose();
    return rest;
}

void check(const GridCurve& curve, const std::string& place) {
    const Eigen::Index nodes = curve.rest.rows();
    if (nodes < 2) throw Error(place + "/rest", "at least 2 nodes", std::to_string(nodes));
    for (Eigen::Index node = 0; node < nodes; ++node)
        if (!curve.rest.row(node).allFinite())
            throw Error(place + "/rest/" + std::to_string(node), "three finite numbers",
                        shown(Vec3(curve.rest.row(node))));
    Vec3 before = Vec3::Zero();
    for (Eigen::Index node = 0; node + 1 < nodes; ++node) {
        const Vec3 link = (curve.rest.row(node + 1) - curve.rest.row(node)).transpose();
        const std::string at = place + "/rest/" + std::to_string(node + 1);
        if (!(link.norm() > 0)) throw Error(at, "a place of its own", "that of the node before");
        constexpr double kTurnsBack = -0.99;
        if (node > 0 && link.normalized().dot(before) < kTurnsBack)
            throw Error(at, "a shape without folds", "a link turning back on the one before");
        before = link.normalized();
    }
    if (curve.material.size() == 1) {
        check_material(curve.material.front(), place + "/material");
        return;
    }
    if (static_cast<Eigen::Index>(curve.material.size()) != nodes)
        throw Error(place + "/material",
                    "1 material or " + std::to_string(nodes) + ", one per node",
                    std::to_string(curve.material.size()));
    for (std::size_t node = 0; node < curve.material.size(); ++node)
        check_material(curve.material[node], place + "/material/" + std::to_string(node));
}

Eigen::VectorXd node_mass(const GridCurve& curve) {
    Eigen::VectorXd mass(curve.rest.rows());
    for (Eigen::Index node = 0; node < mass.size(); ++node)
        mass[node] = material_of(curve, node).mass_kg / static_cast<double>(mass.size());
    return mass;
}

Eigen::VectorXd node_drag(const GridCurve& curve) {
    Eigen::VectorXd drag(curve.rest.rows());
    for (Eigen::Index node = 0; node < drag.size(); ++node)
        drag[node] = material_of(curve, node).drag_ns_per_m;
    return drag;
}

GridCurveTerm::GridCurveTerm(const GridCurve& curve) {
    const int nodes = static_cast<int>(curve.rest.rows());
    const double h = 1.0 / (nodes - 1);
    const double weight = curve.parameters == Parameters::kPerNode ? 1 : h;
    for (int node = 0; node + 1 < nodes; ++node) {
        const CurveMaterial& material = material_of(curve, node);
        MetricElements::Element link;
        link.count = 2;
        link.node[0] = node;
        link.node[1] = node + 1;
        link.d[0][0] = -1 / h;
        link.d[0][1] = 1 / h;
        link.eta(0, 0) = weight * material.elastic_n_per_m3;
        link.phi(0, 0) = weight * material.damping_ns_per_m3;
        stretch_.add(link, curve.rest);
    }
    for (int node = 1; node + 1 < nodes; ++node) {
        Bending bend;
        bend.zeta = weight * material_of(curve, node).bending_n_per_m;
        if (!(bend.zeta > 0)) continue;
        const Vec3 before = curve.rest.row(node - 1), at = curve.rest.row(node);
        const Vec3 after = curve.rest.row(node + 1);
        const Vec3 tangent = (after - before) / (2 * h);
        const Vec3 second = (before - 2 * at + after) / (h * h);
        const double along = second.dot(tangent) / tangent.squaredNorm();
        // Rounding errors of a straight line do not count as a bend.
        const double scale = (before.norm() + 2 * at.norm() + after.norm()) / (h * h);
        constexpr double kRoundOff = 1e-13;
        const double bent = (second - along * tangent).norm();
        const double rest = bent > kRoundOff * scale ? bent : 0;
        const double slide = std::abs(along) * tangent.norm() > kRoundOff * scale ? along : 0;
        for (int k = 0; k < 3; ++k) {
            bend.node[k] = node - 1 + k;
            bend.d[k] = (k == 1 ? -2 : 1) / (h * h) - slide * (k - 1) / (2 * h);
        }
        bend.squared_rounding = kRounding * kRounding * rest * rest;
        bend.rest = std::sqrt(rest * rest + bend.squared_rounding);
        bending_.push_back(bend);
    }
}

template <class Visit>
void GridCurveTerm::for_each_bend(const Points& x, const Visit& visit) const {
    for (const Bending& bend : bending_) {
        Vec3 second = Vec3::Zero();
        for (int k = 0; k < 3; ++k) second += bend.d[k] * x.row(bend.node[k]).transpose();
        // Where S = 0, the quotient S / s is zero even at s = 0.
        const double s = std::max(std::sqrt(second.squaredNorm() + bend.squared_rounding),
                                  std::numeric_limits<double>::min());
        visit(bend, second, s);
    }
}

double GridCurveTerm::add_bending_gradient(const Points& x, Points& gradient) const {
    double energy = 0;
    for_each_bend(x, [&](const Bending& bend, const Vec3& second, double s) {
        energy += 0.5 * bend.zeta * (s - bend.rest) * (s - bend.rest);
        const Vec3 pull = bend.zeta * (1 - bend.rest / s) * second;
        for (int k = 0; k < 3; ++k) gradient.row(bend.node[k]) += bend.d[k] * pull.transpose();
    });
    return energy;
}

double GridCurveTerm::bending_energy(const Points& x) const {
    Points ignored = Points::Zero(x.rows(), 3);
    return add_bending_gradient(x, ignored);
}

double GridCurveTerm::energy(double, const Points& x) const {
    return stretch_.energy(x) + bending_energy(x);
}

void GridCurveTerm::add_force(double, const Points& x, const Points& v, Points& force) const {
    stretch_.add_force(x, v, force);
    Points gradient = Points::Zero(x.rows(), 3);
    add_bending_gradient(x, gradient);
    force -= gradient;
}

double GridCurveTerm::add_potential(const solve::ImplicitStep& step, const Points& x,
                                    Points& gradient) const {
    const double energy = stretch_.add_potential(step, x, gradient);
    return energy + add_bending_gradient(x, gradient);
}

void GridCurveTerm::add_hessian(const solve::ImplicitStep& step, const Points& x,
                                solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    stretch_.add_hessian(step, x, curvature, hessian);
    for_each_bend(x, [&](const Bending& bend, const Vec3& second, double s) {
        // Across the bend: 1 - S/s. Along it: the same plus S |r''|^2 / s^3.
        const double length = second.norm();
        const Vec3 direction = length > 0 ? Vec3(second / length) : Vec3::Zero();
        double across = 1 - bend.rest / s;
        double along = bend.rest > 0 ? across + bend.rest * length * length / (s * s * s) : 1;
        if (curvature == solve::Curvature::kPositive) {
            across = std::max(across, 0.0);
            along = std::max(along, 0.0);
        }
        const Mat3 block = bend.zeta * (across * Mat3::Identity() +
                                        (along - across) * direction * direction.transpose());
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l <= k; ++l)
                hessian.add(bend.node[k], bend.node[l], bend.d[k] * bend.d[l] * block);
    });
}

void GridCurveTerm::add_metric(double step_s, solve::MetricBuilder& metric) const {
    stretch_.add_metric(step_s, metric);
    for (const Bending& bend : bending_) metric.add_outer(bend.node, bend.d, 3, bend.zeta);
}

void GridCurveTerm::add_secant(double, const Points& x, const Points& v, bool lag_rate,
                               solve::MetricBuilder& K, solve::MetricBuilder&,
                               Points& force) const {
    stretch_.add_secant(x, v, lag_rate, K, force);
    for_each_bend(x, [&](const Bending& bend, const Vec3& second, double s) {
        K.add_outer(bend.node, bend.d, 3, bend.zeta);
        const Vec3 push = bend.zeta * bend.rest / s * second;
        for (int k = 0; k < 3; ++k) force.row(bend.node[k]) += bend.d[k] * push.transpose();
    });
}

}  // namespace risorius::tissue
