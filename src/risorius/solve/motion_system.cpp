// SPDX-License-Identifier: MIT
// Sums of the terms over a system of nodes.
#include "risorius/solve/motion_system.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace risorius::solve {

MotionSystem::MotionSystem(Eigen::VectorXd mass_kg, std::vector<char> fixed)
    : mass_kg_(std::move(mass_kg)), fixed_(std::move(fixed)) {
    if (fixed_.empty()) fixed_.assign(static_cast<std::size_t>(mass_kg_.size()), 0);
    if (static_cast<long>(fixed_.size()) != mass_kg_.size())
        throw std::invalid_argument("one fixed flag per node is needed");
    inverse_mass_.setZero(mass_kg_.size(), 3);
    for (int i = 0; i < size(); ++i) {
        if (fixed_[static_cast<std::size_t>(i)]) {
            fixed_nodes_.push_back(i);
            continue;
        }
        if (!(mass_kg_[i] > 0 && std::isfinite(mass_kg_[i])))
            throw std::invalid_argument("node " + std::to_string(i) + " is free and has no mass");
        inverse_mass_.row(i).setConstant(1.0 / mass_kg_[i]);
    }
}

void MotionSystem::add(std::shared_ptr<EnergyTerm> term) { terms_.push_back(std::move(term)); }

void MotionSystem::place_fixed(double t_s, Points& x, Points& v) const {
    for (const int i : fixed_nodes_) v.row(i).setZero();
    if (prescribed_) prescribed_(t_s, x, v);
}

void MotionSystem::begin_step(double t_s, double step_s, const Points& x, const Points& v) const {
    for (const auto& term : terms_) term->begin_step(t_s, step_s, x, v);
}

void MotionSystem::force(double t_s, const Points& x, const Points& v, Points& force) const {
    force.setZero(size(), 3);
    for (const auto& term : terms_) term->add_force(t_s, x, v, force);
}

void MotionSystem::acceleration(double t_s, const Points& x, const Points& v, Points& a) const {
    force(t_s, x, v, a);
    a.array() *= inverse_mass_.array();
    for (const int i : fixed_nodes_) a.row(i).setZero();
}

double MotionSystem::energy(double t_s, const Points& x) const {
    double sum = 0;
    for (const auto& term : terms_) sum += term->energy(t_s, x);
    return sum;
}

double MotionSystem::kinetic_energy(const Points& v) const {
    double sum = 0;
    for (int i = 0; i < size(); ++i)
        if (!fixed_[static_cast<std::size_t>(i)]) sum += 0.5 * mass_kg_[i] * v.row(i).squaredNorm();
    return sum;
}

double MotionSystem::potential(const ImplicitStep& step, const Points& x, Points& gradient) const {
    gradient.setZero(size(), 3);
    double sum = 0;
    for (const auto& term : terms_) sum += term->add_potential(step, x, gradient);
    for (const int i : fixed_nodes_) gradient.row(i).setZero();
    return sum;
}

void MotionSystem::add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                               HessianBuilder& hessian) const {
    for (const auto& term : terms_) term->add_hessian(step, x, curvature, hessian);
}

void MotionSystem::add_metric(double step_s, MetricBuilder& metric) const {
    for (const auto& term : terms_) term->add_metric(step_s, metric);
}

}  // namespace risorius::solve
