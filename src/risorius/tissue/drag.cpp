// SPDX-License-Identifier: MIT
#include "risorius/tissue/drag.h"

#include <cassert>
#include <utility>

namespace risorius::tissue {

Drag::Drag(Eigen::VectorXd drag_ns_per_m) : drag_(std::move(drag_ns_per_m)) {}

void Drag::add_force(double, const Points&, const Points& v, Points& force) const {
    assert(v.rows() == drag_.size());
    for (Eigen::Index i = 0; i < v.rows(); ++i) force.row(i) -= drag_[i] * v.row(i);
}

double Drag::add_potential(const solve::ImplicitStep& step, const Points& x,
                           Points& gradient) const {
    assert(x.rows() == drag_.size());
    double sum = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const double w = drag_[i] * step.rate_hz();
        const Eigen::RowVector3d moved = x.row(i) - step.start.row(i);
        gradient.row(i) += w * moved;
        sum += 0.5 * w * moved.squaredNorm();
    }
    return sum;
}

void Drag::add_hessian(const solve::ImplicitStep& step, const Points&, solve::Curvature,
                       solve::HessianBuilder& hessian) const {
    if (step.rate_hz() == 0) return;
    for (Eigen::Index i = 0; i < drag_.size(); ++i)
        hessian.add_diagonal(static_cast<int>(i), drag_[i] * step.rate_hz());
}

void Drag::add_metric(double step_s, solve::MetricBuilder& metric) const {
    for (Eigen::Index i = 0; i < drag_.size(); ++i)
        metric.add_diagonal(static_cast<int>(i), drag_[i] / step_s);
}

void Drag::add_secant(double, const Points&, const Points&, bool, solve::MetricBuilder&,
                      solve::MetricBuilder& damping, Points&) const {
    for (Eigen::Index i = 0; i < drag_.size(); ++i)
        damping.add_diagonal(static_cast<int>(i), drag_[i]);
}

}  // namespace risorius::tissue
