// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/pull_term.h"

#include <cmath>

namespace risorius::face {

namespace {

/// The energy of a spring and its slope by the point, J and N.
struct Pulled {
    double energy;
    Vec3 slope;
};

Pulled pulled(const Vec3& p, const PullSpring& spring) {
    const Vec3 d = p - spring.tied_to;
    const double k = spring.stiffness_n_per_m, most = spring.strongest_n, length = d.norm();
    if (k * length <= most) return {0.5 * k * length * length, k * d};
    return {most * (length - 0.5 * most / k), most / length * d};
}

/// The springs whose points have moving nodes. The part of a point that held nodes make is constant during the solve.
class LocalPulls : public LocalTerm {
  public:
    explicit LocalPulls(const std::vector<PullSpring>& whole) : whole_(whole) {}

    void begin(const LocalNodes& nodes, const LocalStep& step, const Points& x) override {
        pulls_.clear();
        for (const PullSpring& spring : whole_) {
            Pull pull{spring, {}, Vec3::Zero(), spring.at.of(step.start), step.h};
            for (int i = 0; i < spring.at.count(); ++i) {
                const int node = spring.at.node(i);
                if (nodes.moves(node))
                    pull.moving.add(nodes.row(node), spring.at.weight(i));
                else
                    pull.held += spring.at.weight(i) * x.row(node).transpose();
            }
            if (pull.moving.count() > 0) pulls_.push_back(pull);
        }
    }

    void add_energy(const Points& at, double& value, Points& gradient) const override {
        for (const Pull& pull : pulls_) {
            const Vec3 p = pull.moving.of(at) + pull.held, moved = p - pull.start;
            const Pulled now = pulled(p, pull.spring);
            const double c_over_h = pull.spring.damping_ns_per_m / pull.h;
            value += now.energy + 0.5 * c_over_h * moved.squaredNorm();
            pull.moving.scatter(Vec3(now.slope + c_over_h * moved), gradient);
        }
    }

  private:
    struct Pull {
        PullSpring spring;
        solve::NodeBlend moving;  ///< over local rows
        Vec3 held, start;
        double h;
    };
    const std::vector<PullSpring>& whole_;
    std::vector<Pull> pulls_;
};

}  // namespace

double PullTerm::add_potential(const solve::ImplicitStep& step, const Points& x,
                               Points& gradient) const {
    double sum = 0;
    for (const PullSpring& spring : springs_) {
        const Vec3 p = spring.at.of(x), moved = p - spring.at.of(step.start);
        const Pulled now = pulled(p, spring);
        const double c_over_h = spring.damping_ns_per_m * step.rate_hz();
        sum += now.energy + 0.5 * c_over_h * moved.squaredNorm();
        spring.at.scatter(Vec3(now.slope + c_over_h * moved), gradient);
    }
    return sum;
}

void PullTerm::add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature,
                           solve::HessianBuilder& hessian) const {
    for (const PullSpring& spring : springs_) {
        const Vec3 d = spring.at.of(x) - spring.tied_to;
        const double k = spring.stiffness_n_per_m, most = spring.strongest_n, length = d.norm();
        Mat3 block = k * Mat3::Identity();
        if (k * length > most) {
            const Vec3 n = d / length;
            block = most / length * (Mat3::Identity() - n * n.transpose());
        }
        block += spring.damping_ns_per_m * step.rate_hz() * Mat3::Identity();
        spring.at.scatter(block, hessian);
    }
}

std::unique_ptr<LocalTerm> PullTerm::restricted_to(LocalNodes&) const {
    return std::make_unique<LocalPulls>(springs_);
}

}  // namespace risorius::face
