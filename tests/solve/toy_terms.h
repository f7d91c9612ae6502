// SPDX-License-Identifier: MIT
/// \file
/// Forces with known motions for the tests of integrators: springs to the origin, chains, and a stiffening spring.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "risorius/solve/motion_system.h"

namespace risorius::solve::toy {

/// Every node is attached to the origin by a linear spring k and a linear damper d, and has the load f(t).
class Anchor : public EnergyTerm {
  public:
    Anchor(double stiffness, double damping) : k_(stiffness), d_(damping) {}
    std::function<Vec3(double t_s)> load = [](double) { return Vec3::Zero(); };
    mutable long forces = 0;
    long begun = 0;

    void begin_step(double, double, const Points&, const Points&) override { ++begun; }
    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override {
        ++forces;
        const Eigen::RowVector3d f = load(t_s).transpose();
        force += -k_ * x - d_ * v;
        force.rowwise() += f;
    }
    double energy(double t_s, const Points& x) const override {
        return 0.5 * k_ * x.squaredNorm() - (x * load(t_s)).sum();
    }
    double add_potential(const ImplicitStep& step, const Points& x,
                         Points& gradient) const override {
        const Points move = x - step.start;
        gradient += k_ * x + d_ * step.rate_hz() * move;
        gradient.rowwise() -= load(step.end_s).transpose();
        return energy(step.end_s, x) + 0.5 * d_ * step.rate_hz() * move.squaredNorm();
    }
    void add_hessian(const ImplicitStep& step, const Points& x, Curvature,
                     HessianBuilder& hessian) const override {
        for (int i = 0; i < x.rows(); ++i) hessian.add_diagonal(i, k_ + d_ * step.rate_hz());
    }
    void add_metric(double step_s, MetricBuilder& metric) const override {
        for (int i = 0; i < metric.nodes(); ++i) metric.add_diagonal(i, k_ + d_ / step_s);
    }
    void add_secant(double t_s, const Points& x, const Points&, bool, MetricBuilder& K,
                    MetricBuilder& damping, Points& force) const override {
        const Eigen::RowVector3d f = load(t_s).transpose();
        for (int i = 0; i < x.rows(); ++i) {
            K.add_diagonal(i, k_);
            damping.add_diagonal(i, d_);
        }
        force.rowwise() += f;
    }

  private:
    double k_, d_;
};

/// Links between successive nodes with the energy k/4 (|d|^2 - l^2)^2 / l^2. Near the rest shape a link is a spring of
/// stiffness 2 k without transverse stiffness; shortened, it is indefinite. Every node has the weight g along -y.
class Chain : public EnergyTerm {
  public:
    Chain(double stiffness, double rest_m, double weight_n)
        : k_(stiffness), l_(rest_m), weight_(weight_n) {}

    void add_force(double t_s, const Points& x, const Points&, Points& force) const override {
        Points gradient = Points::Zero(x.rows(), 3);
        add_potential({t_s, std::numeric_limits<double>::infinity(), x}, x, gradient);
        force -= gradient;
    }
    double energy(double, const Points& x) const override {
        double sum = weight_ * x.col(1).sum();
        for (int i = 0; i + 1 < x.rows(); ++i) {
            const double excess = (x.row(i + 1) - x.row(i)).squaredNorm() - l_ * l_;
            sum += k_ / 4 * excess * excess / (l_ * l_);
        }
        return sum;
    }
    double add_potential(const ImplicitStep&, const Points& x, Points& gradient) const override {
        for (int i = 0; i + 1 < x.rows(); ++i) {
            const Eigen::RowVector3d d = x.row(i + 1) - x.row(i);
            const double tension = k_ * (d.squaredNorm() - l_ * l_) / (l_ * l_);
            gradient.row(i + 1) += tension * d;
            gradient.row(i) -= tension * d;
        }
        gradient.col(1).array() += weight_;
        return energy(0, x);
    }
    void add_hessian(const ImplicitStep&, const Points& x, Curvature curvature,
                     HessianBuilder& hessian) const override {
        for (int i = 0; i + 1 < x.rows(); ++i) {
            const Vec3 d = (x.row(i + 1) - x.row(i)).transpose();
            double tension = k_ * (d.squaredNorm() - l_ * l_) / (l_ * l_);
            if (curvature == Curvature::kPositive) tension = std::max(tension, 0.0);
            const Mat3 H = tension * Mat3::Identity() + 2 * k_ / (l_ * l_) * d * d.transpose();
            hessian.add(i, i, H);
            hessian.add(i + 1, i + 1, H);
            hessian.add(i, i + 1, -H);
        }
    }
    void add_metric(double, MetricBuilder& metric) const override {
        const double c[2] = {-1, 1};
        for (int i = 0; i + 1 < metric.nodes(); ++i) {
            const int nodes[2] = {i, i + 1};
            metric.add_outer(nodes, c, 2, 2 * k_);
        }
    }
    void add_secant(double, const Points& x, const Points&, bool, MetricBuilder& K, MetricBuilder&,
                    Points& force) const override {
        const double c[2] = {-1, 1};
        for (int i = 0; i + 1 < x.rows(); ++i) {
            const int nodes[2] = {i, i + 1};
            K.add_outer(nodes, c, 2,
                        k_ * ((x.row(i + 1) - x.row(i)).squaredNorm() - l_ * l_) / (l_ * l_));
        }
        force.col(1).array() -= weight_;
    }

  private:
    double k_, l_, weight_;
};

/// Force - k sinh(|x| / l) towards the origin. Its Hessian has no useful upper bound and no negative part.
class Stiffening : public EnergyTerm {
  public:
    Stiffening(double force_n, double length_m) : f_(force_n), l_(length_m) {}
    void add_force(double t_s, const Points& x, const Points&, Points& force) const override {
        Points gradient = Points::Zero(x.rows(), 3);
        add_potential({t_s, std::numeric_limits<double>::infinity(), x}, x, gradient);
        force -= gradient;
    }
    double energy(double, const Points& x) const override {
        return f_ * l_ * (x.array() / l_).cosh().sum();
    }
    double add_potential(const ImplicitStep&, const Points& x, Points& gradient) const override {
        gradient.array() += f_ * (x.array() / l_).sinh();
        return energy(0, x);
    }
    void add_hessian(const ImplicitStep&, const Points& x, Curvature,
                     HessianBuilder& hessian) const override {
        for (int i = 0; i < x.rows(); ++i) {
            const Vec3 c = (x.row(i).array() / l_).cosh().matrix().transpose();
            hessian.add(i, i, f_ / l_ * Mat3(c.asDiagonal()));
        }
    }
    void add_metric(double, MetricBuilder& metric) const override {
        for (int i = 0; i < metric.nodes(); ++i) metric.add_diagonal(i, f_ / l_);
    }

  private:
    double f_, l_;
};

inline MotionSystem system_of(int nodes, double mass_kg, std::shared_ptr<EnergyTerm> term,
                              std::vector<char> fixed = {}) {
    MotionSystem system(Eigen::VectorXd::Constant(nodes, mass_kg), std::move(fixed));
    system.add(std::move(term));
    return system;
}

inline MotionState at_rest(Points x) {
    MotionState state;
    state.v = Points::Zero(x.rows(), 3);
    state.x = std::move(x);
    return state;
}

/// A straight chain along x, with rest links of length `l`.
inline Points straight(int nodes, double l) {
    Points x = Points::Zero(nodes, 3);
    for (int i = 0; i < nodes; ++i) x(i, 0) = i * l;
    return x;
}

inline std::vector<char> first_fixed(int nodes) {
    std::vector<char> fixed(static_cast<std::size_t>(nodes), 0);
    fixed[0] = 1;
    return fixed;
}

}  // namespace risorius::solve::toy
