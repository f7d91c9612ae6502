// SPDX-License-Identifier: MIT
#include "risorius/muscle/chain_set.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "risorius/solve/energy_term.h"

namespace risorius::muscle {

namespace {

Vec3 segment(const Points& x, const std::vector<int>& node, int i) {
    return (x.row(node[static_cast<std::size_t>(i) + 1]) - x.row(node[static_cast<std::size_t>(i)]))
        .transpose();
}

}  // namespace

ChainSet::ChainSet(std::vector<std::vector<int>> chains, const Points& rest,
                   ChainProperties properties, MuscleCurves curves)
    : properties_(properties), curves_(std::move(curves)) {
    for (std::vector<int>& nodes : chains) {
        Chain chain;
        chain.node = std::move(nodes);
        for (int s = 0; s + 1 < static_cast<int>(chain.node.size()); ++s)
            if (!(segment(rest, chain.node, s).norm() > 0))
                throw std::invalid_argument("ChainSet: a segment has no length");
        const double whole = length(chain, rest);
        chain.tendon_m = properties_.tendon_fraction * whole;
        chain.fibre_m = whole - chain.tendon_m;
        if (!(chain.fibre_m > 0)) throw std::invalid_argument("ChainSet: a chain has no fibres");
        chains_.push_back(std::move(chain));
    }
}

double ChainSet::length(const Chain& chain, const Points& x) const {
    double sum = 0;
    for (int s = 0; s + 1 < static_cast<int>(chain.node.size()); ++s)
        sum += segment(x, chain.node, s).norm();
    return sum;
}

ChainSet::Pull ChainSet::fibre_pull(const Chain& chain, double fibre_m, double activation) const {
    const double thick = std::sin(properties_.pennation_rad);
    const double along2 = properties_.rest_stretch * properties_.rest_stretch - thick * thick;
    const double optimal_m = chain.fibre_m / std::sqrt(along2);
    const double ratio = std::max(fibre_m, 0.0) / chain.fibre_m;
    const double lam = std::sqrt(ratio * ratio * along2 + thick * thick);
    const Curve::Value passive = curves_.passive.at(lam);
    const Curve::Value active = activation == 0 ? Curve::Value{} : curves_.active.at(lam);
    const double force = activation * active.value + passive.value;
    const double slope = activation * active.slope + passive.slope;
    // lam dlam = S dS along2 / S0^2 = S dS / l0^2
    const double cosine = lam > 0 ? ratio * std::sqrt(along2) / lam : 1.0;
    const double f0 = properties_.f0_n;
    return {
        .tension = f0 * force * cosine,
        .slope = f0 / optimal_m *
                 (slope * cosine * cosine + (lam > 0 ? force * (1 - cosine * cosine) / lam : 0)),
        .energy = f0 * optimal_m * (activation * active.integral + passive.integral),
        .stretch = lam};
}

ChainSet::Pull ChainSet::pull(const Chain& chain, double length_m, double activation) const {
    const double slack = chain.tendon_m, f0 = properties_.f0_n;
    Pull fibres = fibre_pull(chain, length_m - slack, activation);
    if (properties_.rigid_tendon || slack == 0 || fibres.tension <= 0) return fibres;
    // Finds the tendon strain at which tendon and fibres have equal tension, by Newton steps between two strains whose excess
    // has opposite signs.
    const auto excess = [&](double strain, double& slope) {
        fibres = fibre_pull(chain, length_m - slack * (1 + strain), activation);
        const Curve::Value tendon = curves_.tendon.at(strain);
        slope = f0 * tendon.slope + slack * fibres.slope;
        return f0 * tendon.value - fibres.tension;
    };
    double low = 0, high = 0.05, slope = 0;
    while (excess(high, slope) < 0) {
        low = high;
        high *= 2;
    }
    double strain = high;
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double over = excess(strain, slope);
        (over > 0 ? high : low) = strain;
        double next = slope > 0 ? strain - over / slope : low;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - strain) < 1e-14) break;
        strain = next;
    }
    const Curve::Value tendon = curves_.tendon.at(strain);
    const double tendon_slope = f0 * tendon.slope / slack;
    fibres.energy += f0 * slack * tendon.integral;
    fibres.slope = fibres.slope > 0 ? fibres.slope * tendon_slope / (fibres.slope + tendon_slope)
                                    : fibres.slope;
    return fibres;
}

double ChainSet::add_energy(const Points& x, double activation, Points& gradient) const {
    double energy = 0;
    for (const Chain& chain : chains_) {
        const Pull chain_pull = pull(chain, length(chain, x), activation);
        energy += chain_pull.energy;
        if (chain_pull.tension == 0) continue;
        for (int s = 0; s + 1 < static_cast<int>(chain.node.size()); ++s) {
            const Vec3 d = segment(x, chain.node, s);
            const double l = d.norm();
            if (!(l > 0)) continue;  // no direction to pull along
            const Vec3 force = chain_pull.tension / l * d;
            gradient.row(chain.node[static_cast<std::size_t>(s)]) -= force.transpose();
            gradient.row(chain.node[static_cast<std::size_t>(s) + 1]) += force.transpose();
        }
    }
    return energy;
}

void ChainSet::add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                             solve::HessianBuilder& hessian) const {
    for (const Chain& chain : chains_) {
        const Pull chain_pull = pull(chain, length(chain, x), activation);
        const int segments = static_cast<int>(chain.node.size()) - 1;
        for (int s = 0; s < segments; ++s) {
            const Vec3 d = segment(x, chain.node, s);
            const double l = d.norm();
            if (!(l > 0)) continue;
            const Vec3 u = d / l;
            const double across = std::max(chain_pull.tension, 0.0) / l;
            const double along = std::max(chain_pull.slope, 0.0) * segments;
            const Mat3 block = across * Mat3::Identity() + (along - across) * u * u.transpose();
            const int
                a = row[static_cast<std::size_t>(chain.node[static_cast<std::size_t>(s)])],
                b = row[static_cast<std::size_t>(chain.node[static_cast<std::size_t>(s) + 1])];
            hessian.add(a, a, block);
            hessian.add(b, b, block);
            hessian.add(a, b, -block);
        }
    }
}

void ChainSet::add_hessian(const Points& x, double activation, solve::Curvature curvature,
                           const std::vector<int>& row, solve::HessianBuilder& hessian) const {
    const bool positive = curvature == solve::Curvature::kPositive;
    for (const Chain& chain : chains_) {
        const Pull chain_pull = pull(chain, length(chain, x), activation);
        const double slope = positive ? std::max(chain_pull.slope, 0.0) : chain_pull.slope;
        const double tension = positive ? std::max(chain_pull.tension, 0.0) : chain_pull.tension;
        const auto count = chain.node.size();
        std::vector<Vec3> by_node(count, Vec3::Zero());  // dL/dx
        for (int s = 0; s + 1 < static_cast<int>(count); ++s) {
            const Vec3 d = segment(x, chain.node, s);
            const double l = d.norm();
            if (!(l > 0)) continue;
            const Vec3 u = d / l;
            const auto from = static_cast<std::size_t>(s);
            by_node[from] -= u;
            by_node[from + 1] += u;
            const Mat3 turn = tension / l * (Mat3::Identity() - u * u.transpose());
            const int a = row[static_cast<std::size_t>(chain.node[from])],
                      b = row[static_cast<std::size_t>(chain.node[from + 1])];
            hessian.add(a, a, turn);
            hessian.add(b, b, turn);
            hessian.add(a, b, -turn);
        }
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                hessian.add(row[static_cast<std::size_t>(chain.node[i])],
                            row[static_cast<std::size_t>(chain.node[j])],
                            slope * by_node[i] * by_node[j].transpose());
    }
}

double ChainSet::mean_stretch(const Points& x, double activation) const {
    double sum = 0;
    for (const Chain& chain : chains_)
        sum += pull(chain, length(chain, x), activation).stretch / properties_.rest_stretch;
    return chains_.empty() ? 1.0 : sum / static_cast<double>(chains_.size());
}

std::vector<ChainSet::State> ChainSet::states(const Points& x, double activation) const {
    std::vector<State> out;
    for (const Chain& chain : chains_) {
        const double length_m = length(chain, x);
        const Pull now = pull(chain, length_m, activation);
        out.push_back({.length_m = length_m, .stretch = now.stretch, .force_n = now.tension});
    }
    return out;
}

}  // namespace risorius::muscle
