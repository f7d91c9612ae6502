// SPDX-License-Identifier: MIT
#include "risorius/tissue/coordinate_guides.h"

namespace risorius::tissue {

double CoordinateGuides::add_potential(const solve::ImplicitStep& /*step*/, const Points& x,
                                       Points& gradient) const {
    double energy = 0;
    for (const Guide& guide : guides_) {
        const double pull = force_n(guide, x);
        energy += 0.5 * pull * (guide.at_m - x(guide.node, guide.axis));
        gradient(guide.node, guide.axis) -= pull;
    }
    return energy;
}

void CoordinateGuides::add_hessian(const solve::ImplicitStep& /*step*/, const Points& /*x*/,
                                   solve::Curvature /*curvature*/,
                                   solve::HessianBuilder& hessian) const {
    for (const Guide& guide : guides_) {
        Mat3 block = Mat3::Zero();
        block(guide.axis, guide.axis) = stiffness_n_per_m_;
        hessian.add(guide.node, guide.node, block);
    }
}

void CoordinateGuides::add_metric(double /*step_s*/, solve::MetricBuilder& metric) const {
    for (const Guide& guide : guides_) metric.add_diagonal(guide.node, stiffness_n_per_m_);
}

}  // namespace risorius::tissue
