// SPDX-License-Identifier: MIT
#include "risorius/muscle/fibre_tets.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace risorius::muscle {

using solve::Curvature;
using solve::ImplicitStep;

FibreTets::FibreTets(const FibreTetsParameters& parameters, const Points& rest, const Tets& tets,
                     const Points& fibres, ActivationAt activation,
                     const std::vector<double>& density)
    : parameters_(parameters),
      curves_(make_curves(parameters.curves)),
      activation_(std::move(activation)) {
    if (!(parameters.tension_pa > 0) || !(parameters.optimal_stretch > 0) ||
        !(parameters.max_speed_hz > 0) || !(parameters.damping >= 0))
        throw std::invalid_argument("FibreTets: a parameter is outside its range");
    if (fibres.rows() != tets.rows() ||
        (!density.empty() && density.size() != static_cast<std::size_t>(tets.rows())))
        throw std::invalid_argument("FibreTets: each tetrahedron needs a direction of fibres");
    for (Eigen::Index t = 0; t < tets.rows(); ++t) {
        Mat3 edges;
        for (int k = 0; k < 3; ++k)
            edges.col(k) = (rest.row(tets(t, k + 1)) - rest.row(tets(t, 0))).transpose();
        Element element{};
        element.volume_m3 = edges.determinant() / 6;
        if (!(element.volume_m3 > 0))
            throw std::invalid_argument("FibreTets: a tetrahedron without volume");
        const Vec3 share = edges.inverse() * fibres.row(t).transpose();
        for (int k = 0; k < 4; ++k) {
            element.node[k] = tets(t, k);
            element.weight[k] = k == 0 ? -share.sum() : share[k - 1];
        }
        element.density = density.empty() ? 1.0 : density[static_cast<std::size_t>(t)];
        if (!density.empty()) element.volume_m3 *= element.density;
        volume_m3_ += element.volume_m3;
        elements_.push_back(element);
    }
}

double FibreTets::mean_for(const ImplicitStep& step, const Points& x) const {
    if (!parameters_.active_by_mean) return 1;
    return mean_stretch(step.rate_hz() == 0 ? x : step.start);
}

FibreTets::Pull FibreTets::pull(const ImplicitStep& step, const Element& element, double stretch,
                                double activation, double mean) const {
    const double l0 = parameters_.optimal_stretch, b = parameters_.damping;
    const Curve::Value passive = curves_.passive.at(stretch / l0);
    Pull pull{
        .energy = l0 * passive.integral, .tension = passive.value, .slope = passive.slope / l0};
    if (step.rate_hz() == 0) {
        if (activation == 0) return pull;
        if (parameters_.active_by_mean) {  // its energy is that of the muscle
            pull.tension += activation * curves_.active.value(mean);
            return pull;
        }
        const Curve::Value active = curves_.active.at(stretch / l0);
        pull.energy += activation * l0 * active.integral;
        pull.tension += activation * active.value;
        pull.slope += activation * active.slope / l0;
        return pull;
    }
    const double start = along(element, step.start).norm();
    const double length = parameters_.active_by_mean ? mean : start / l0;
    const double force = activation == 0 ? 0 : activation * curves_.active.value(length);
    const double way = parameters_.max_speed_hz * l0 * step.step_s;
    const double speed = (stretch - start) / way;
    const Curve::Value velocity = curves_.velocity.at(speed);
    pull.energy += way * (force * velocity.integral + b * speed * speed / 2);
    pull.tension += force * velocity.value + b * speed;
    pull.slope += (force * velocity.slope + b) / way;
    return pull;
}

void FibreTets::add_force(double t_s, const Points& x, const Points& v, Points& force) const {
    const double a = activation_(t_s), l0 = parameters_.optimal_stretch;
    const double mean = parameters_.active_by_mean ? mean_stretch(x) : 0;
    for (const Element& element : elements_) {
        const Vec3 d = along(element, x);
        const double l = d.norm();
        if (!(l > 0)) continue;
        const double speed = along(element, v).dot(d) / (l * parameters_.max_speed_hz * l0);
        double tension = curves_.passive.value(l / l0) + parameters_.damping * speed;
        if (a != 0)
            tension += a * curves_.active.value(parameters_.active_by_mean ? mean : l / l0) *
                       curves_.velocity.value(speed);
        const Vec3 pulls = element.volume_m3 * parameters_.tension_pa * tension / l * d;
        for (int k = 0; k < 4; ++k)
            force.row(element.node[k]) -= element.weight[k] * pulls.transpose();
    }
}

double FibreTets::add_potential(const ImplicitStep& step, const Points& x, Points& gradient) const {
    const double a = activation_(step.end_s), mean = mean_for(step, x);
    double potential = 0;
    if (parameters_.active_by_mean && step.rate_hz() == 0 && a != 0)
        potential += a * volume_m3_ * parameters_.tension_pa * parameters_.optimal_stretch *
                     curves_.active.at(mean).integral;
    for (const Element& element : elements_) {
        const double scale = element.volume_m3 * parameters_.tension_pa;
        const Vec3 d = along(element, x);
        const double l = d.norm();
        const Pull now = pull(step, element, l, a, mean);
        potential += scale * now.energy;
        if (!(l > 0)) continue;
        const Vec3 pulls = scale * now.tension / l * d;
        for (int k = 0; k < 4; ++k)
            gradient.row(element.node[k]) += element.weight[k] * pulls.transpose();
    }
    return potential;
}

void FibreTets::add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                            solve::HessianBuilder& hessian) const {
    const double a = activation_(step.end_s), mean = mean_for(step, x);
    if (parameters_.active_by_mean && step.rate_hz() == 0 && a != 0 &&
        curvature == Curvature::kExact)
        add_mean_hessian(a, x, hessian);
    for (const Element& element : elements_) {
        const Vec3 d = along(element, x);
        const double l = d.norm();
        if (!(l > 0)) continue;
        const Pull now = pull(step, element, l, a, mean);
        double stiff = now.slope, across = now.tension / l;
        if (curvature == Curvature::kPositive) {
            stiff = std::max(stiff, 0.0);
            across = std::max(across, 0.0);
        }
        const Mat3 block =
            element.volume_m3 * parameters_.tension_pa *
            (across * Mat3::Identity() + (stiff - across) / (l * l) * d * d.transpose());
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j <= i; ++j)
                hessian.add(element.node[i], element.node[j],
                            element.weight[i] * element.weight[j] * block);
    }
}

void FibreTets::add_mean_hessian(double activation, const Points& x,
                                 solve::HessianBuilder& hessian) const {
    // a s0 fl' / (V l0) w w^T,  w = sum V dl/dx
    std::vector<int> nodes;
    Points slope = Points::Zero(x.rows(), 3);
    for (const Element& element : elements_) {
        const Vec3 d = along(element, x);
        const double l = d.norm();
        for (int k = 0; k < 4; ++k) {
            nodes.push_back(element.node[k]);
            if (l > 0)
                slope.row(element.node[k]) +=
                    element.volume_m3 * element.weight[k] / l * d.transpose();
        }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const double stiffness = activation * parameters_.tension_pa *
                             curves_.active.at(mean_stretch(x)).slope /
                             (volume_m3_ * parameters_.optimal_stretch);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j)
            hessian.add(nodes[i], nodes[j],
                        stiffness * slope.row(nodes[i]).transpose() * slope.row(nodes[j]));
}

void FibreTets::add_metric(double step_s, solve::MetricBuilder& metric) const {
    const double steepest = curves_.velocity.at(0).slope + parameters_.damping;
    const double rate = steepest / (parameters_.max_speed_hz * step_s);  // 0 in an equilibrium
    for (const Element& element : elements_)
        metric.add_outer(
            element.node, element.weight, 4,
            element.volume_m3 * parameters_.tension_pa / parameters_.optimal_stretch * (1 + rate));
}

double FibreTets::mean_stretch(const Points& x) const {
    double sum = 0;
    for (const Element& element : elements_) sum += element.volume_m3 * along(element, x).norm();
    return sum / (volume_m3_ * parameters_.optimal_stretch);
}

std::vector<FibreTets::State> FibreTets::states(double t_s, const Points& x) const {
    const double a = activation_(t_s), mean = mean_stretch(x);
    std::vector<State> out;
    for (const Element& element : elements_) {
        State state{.stretch = along(element, x).norm() / parameters_.optimal_stretch};
        state.tension_pa =
            element.density * parameters_.tension_pa *
            (curves_.passive.value(state.stretch) +
             a * curves_.active.value(parameters_.active_by_mean ? mean : state.stretch));
        out.push_back(state);
    }
    return out;
}

}  // namespace risorius::muscle
