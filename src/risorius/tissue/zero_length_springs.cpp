// SPDX-License-Identifier: MIT
#include "risorius/tissue/zero_length_springs.h"

#include <algorithm>
#include <utility>

#include "risorius/solve/hessian_builder.h"

namespace risorius::tissue {

ZeroLengthSprings::ZeroLengthSprings(std::vector<Spring> springs) : springs_(std::move(springs)) {}

double ZeroLengthSprings::add_energy(const Points& x, Points& gradient) const {
    double energy = 0;
    for (const Spring& spring : springs_) {
        const Vec3 d = x.row(spring.node).transpose() - spring.target;
        const double along = d.dot(spring.normal);
        // kn along^2 + kt (|d|^2 - along^2), without the difference of squares
        const Vec3 across = d - along * spring.normal;
        energy +=
            0.5 * (spring.kn_n_per_m * along * along + spring.kt_n_per_m * across.squaredNorm());
        gradient.row(spring.node) +=
            (spring.kn_n_per_m * along * spring.normal + spring.kt_n_per_m * across).transpose();
    }
    return energy;
}

void ZeroLengthSprings::add_hessian(solve::HessianBuilder& hessian) const {
    for (const Spring& spring : springs_)
        hessian.add(spring.node, spring.node,
                    spring.kt_n_per_m * Mat3::Identity() + (spring.kn_n_per_m - spring.kt_n_per_m) *
                                                               spring.normal *
                                                               spring.normal.transpose());
}

void ZeroLengthSprings::add_metric(solve::MetricBuilder& builder) const {
    for (const Spring& spring : springs_)
        builder.add_diagonal(spring.node, std::max(spring.kn_n_per_m, spring.kt_n_per_m));
}

}  // namespace risorius::tissue
