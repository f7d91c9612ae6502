#include "muscle/chain_set.h"

#include <cmath>
#include <stdexcept>
#include <utility>

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
        const int segments = static_cast<int>(chain.node.size()) - 1;
        if (segments < (properties_.elastic_tendons ? 3 : 1))
            throw std::invalid_argument("ChainSet: a chain has too few nodes");
        for (int s = 0; s < segments; ++s)
            if (!(segment(rest, chain.node, s).norm() > 0))
                throw std::invalid_argument("ChainSet: a segment has no length");
        if (properties_.elastic_tendons)
            for (int end = 0; end < 2; ++end)
                chain.tendon_m[end] = segment(rest, chain.node, end == 0 ? 0 : segments - 1).norm();
        chain.rest_m = fibre_length(chain, rest);
        if (!(chain.rest_m > 0))
            throw std::invalid_argument("ChainSet: the tendon is longer than the chain");
        chains_.push_back(std::move(chain));
    }
}

double ChainSet::fibre_length(const Chain& chain, const Points& x) const {
    double length = -properties_.rigid_tendon_m;
    for (int s = first_fibre(); s < end_fibre(chain); ++s)
        length += segment(x, chain.node, s).norm();
    return length;
}

double ChainSet::stretch(const Chain& chain, double length_m) const {
    const double thick = std::sin(properties_.pennation_rad);
    const double ratio = length_m / chain.rest_m;
    return std::sqrt(ratio * ratio *
                         (properties_.rest_stretch * properties_.rest_stretch - thick * thick) +
                     thick * thick);
}

ChainSet::Pull ChainSet::fibre_pull(const Chain& chain, double length_m, double activation) const {
    const double thick = std::sin(properties_.pennation_rad);
    const double along2 = properties_.rest_stretch * properties_.rest_stretch - thick * thick;
    const double optimal_m = chain.rest_m / std::sqrt(along2);
    const double lam = stretch(chain, length_m);
    const Curve::Value passive = curves_.passive.at(lam);
    const Curve::Value active = activation == 0 ? Curve::Value{} : curves_.active.at(lam);
    const double force = activation * active.value + passive.value;
    const double slope = activation * active.slope + passive.slope;
    // lam dlam = S dS along2 / S0^2 = S dS / l0^2
    const double cosine = lam > 0 ? length_m / (optimal_m * lam) : 1.0;
    const double f0 = properties_.f0_n;
    return {
        .tension = f0 * force * cosine,
        .slope = f0 / optimal_m *
                 (slope * cosine * cosine + (lam > 0 ? force * (1 - cosine * cosine) / lam : 0)),
        .energy = f0 * optimal_m * (activation * active.integral + passive.integral)};
}

ChainSet::Pull ChainSet::tendon_pull(double slack_m, double length_m) const {
    const Curve::Value tendon = curves_.tendon.at((length_m - slack_m) / slack_m);
    const double f0 = properties_.f0_n;
    return {.tension = f0 * tendon.value,
            .slope = f0 * tendon.slope / slack_m,
            .energy = f0 * slack_m * tendon.integral};
}

double ChainSet::add_energy(const Points& x, double activation, Points& gradient) const {
    double energy = 0;
    const auto pull_along = [&](const Chain& chain, int s, double tension) {
        const Vec3 d = segment(x, chain.node, s);
        const double l = d.norm();
        if (!(l > 0)) return;  // no direction to pull along
        const Vec3 pull = tension / l * d;
        gradient.row(chain.node[static_cast<std::size_t>(s)]) -= pull.transpose();
        gradient.row(chain.node[static_cast<std::size_t>(s) + 1]) += pull.transpose();
    };
    for (const Chain& chain : chains_) {
        const Pull fibres = fibre_pull(chain, fibre_length(chain, x), activation);
        energy += fibres.energy;
        if (fibres.tension != 0)
            for (int s = first_fibre(); s < end_fibre(chain); ++s)
                pull_along(chain, s, fibres.tension);
        if (!properties_.elastic_tendons) continue;
        for (int end = 0; end < 2; ++end) {
            const int s = end == 0 ? 0 : static_cast<int>(chain.node.size()) - 2;
            const Pull tendon = tendon_pull(chain.tendon_m[end], segment(x, chain.node, s).norm());
            energy += tendon.energy;
            if (tendon.tension != 0) pull_along(chain, s, tendon.tension);
        }
    }
    return energy;
}

void ChainSet::add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                             solve::HessianBuilder& hessian) const {
    const auto add = [&](const Chain& chain, int s, const Pull& pull, double in_series) {
        const Vec3 d = segment(x, chain.node, s);
        const double l = d.norm();
        if (!(l > 0)) return;
        const Vec3 u = d / l;
        const double across = std::max(pull.tension, 0.0) / l;
        const Mat3 block = across * Mat3::Identity() +
                           (std::max(pull.slope, 0.0) * in_series - across) * u * u.transpose();
        const int a = row[static_cast<std::size_t>(chain.node[static_cast<std::size_t>(s)])],
                  b = row[static_cast<std::size_t>(chain.node[static_cast<std::size_t>(s) + 1])];
        hessian.add(a, a, block);
        hessian.add(b, b, block);
        hessian.add(a, b, -block);
    };
    for (const Chain& chain : chains_) {
        const Pull fibres = fibre_pull(chain, fibre_length(chain, x), activation);
        const int count = end_fibre(chain) - first_fibre();
        for (int s = first_fibre(); s < end_fibre(chain); ++s) add(chain, s, fibres, count);
        if (!properties_.elastic_tendons) continue;
        for (int end = 0; end < 2; ++end) {
            const int s = end == 0 ? 0 : static_cast<int>(chain.node.size()) - 2;
            add(chain, s, tendon_pull(chain.tendon_m[end], segment(x, chain.node, s).norm()), 1);
        }
    }
}

double ChainSet::mean_stretch(const Points& x) const {
    double sum = 0;
    for (const Chain& chain : chains_)
        sum += stretch(chain, fibre_length(chain, x)) / properties_.rest_stretch;
    return chains_.empty() ? 1.0 : sum / static_cast<double>(chains_.size());
}

}  // namespace risorius::muscle
