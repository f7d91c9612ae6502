// SPDX-License-Identifier: MIT
#include "risorius/tissue/gravity.h"

#include <cassert>
#include <utility>

namespace risorius::tissue {

Gravity::Gravity(Eigen::VectorXd mass_kg, const Vec3& gravity_m_per_s2)
    : mass_kg_(std::move(mass_kg)), gravity_(gravity_m_per_s2) {}

void Gravity::add_force(double, const Points& x, const Points&, Points& force) const {
    assert(x.rows() == mass_kg_.size());
    for (Eigen::Index i = 0; i < x.rows(); ++i) force.row(i) += mass_kg_[i] * gravity_.transpose();
}

double Gravity::energy(double, const Points& x) const {
    assert(x.rows() == mass_kg_.size());
    double sum = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        sum -= mass_kg_[i] * x.row(i).dot(gravity_.transpose());
    return sum;
}

double Gravity::add_potential(const solve::ImplicitStep& step, const Points& x,
                              Points& gradient) const {
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        gradient.row(i) -= mass_kg_[i] * gravity_.transpose();
    return energy(step.end_s, x);
}

}  // namespace risorius::tissue
