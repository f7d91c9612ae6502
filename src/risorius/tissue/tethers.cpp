// SPDX-License-Identifier: MIT
#include "risorius/tissue/tethers.h"

#include <algorithm>
#include <utility>

#include "risorius/solve/hessian_builder.h"

namespace risorius::tissue {

ZeroLengthSprings::ZeroLengthSprings(std::vector<Tether> tethers) : tethers_(std::move(tethers)) {}

double ZeroLengthSprings::add_energy(const Points& x, Points& gradient) const {
    double energy = 0;
    for (const Tether& tether : tethers_) {
        const Vec3 d = x.row(tether.node).transpose() - tether.target;
        const double along = d.dot(tether.normal);
        // kn along^2 + kt (|d|^2 - along^2), without a difference of squares.
        const Vec3 across = d - along * tether.normal;
        energy +=
            0.5 * (tether.kn_n_per_m * along * along + tether.kt_n_per_m * across.squaredNorm());
        gradient.row(tether.node) +=
            (tether.kn_n_per_m * along * tether.normal + tether.kt_n_per_m * across).transpose();
    }
    return energy;
}

void ZeroLengthSprings::add_hessian(solve::HessianBuilder& hessian) const {
    for (const Tether& tether : tethers_)
        hessian.add(tether.node, tether.node,
                    tether.kt_n_per_m * Mat3::Identity() + (tether.kn_n_per_m - tether.kt_n_per_m) *
                                                               tether.normal *
                                                               tether.normal.transpose());
}

void ZeroLengthSprings::add_metric(solve::MetricBuilder& builder) const {
    for (const Tether& tether : tethers_)
        builder.add_diagonal(tether.node, std::max(tether.kn_n_per_m, tether.kt_n_per_m));
}

}  // namespace risorius::tissue
