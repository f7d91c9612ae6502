// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/jaw_synergies.h"

#include <algorithm>
#include <cmath>

namespace risorius::face {

namespace {

constexpr double kLevels[] = {0.02, 0.04, 0.06, 0.08, 0.1, 0.13, 0.16, 0.2,
                              0.23, 0.27, 0.32, 0.4,  0.5, 0.65, 0.8,  1.0};
constexpr double kTryStep_s = 1.0 / 60.0;
constexpr int kTrySteps = 45;
constexpr double kMinMove = 0.01;  // movement / range that counts as progress

// Tissue that adapts holds a jaw less than tissue that only follows it, and still less once the jaw is open. Square roots of the ratios
// on the adult head, 0.036 for opening and 0.031 for sliding.
constexpr double kGives[] = {0.19, 0.175};
constexpr double kYield_mm = 13, kYielded = 0.15;

struct Share {
    const char* muscle;  // with .l or .r, or both sides
    double weight;
};
const std::vector<Share>& fractions(int group) {
    static const std::vector<Share> all[] = {
        {{"pterygoid_lateral_inferior", 1},
         {"digastric_anterior", 1},
         {"digastric_posterior", 0.5},
         {"geniohyoid", 1},
         {"mylohyoid_anterior", 1},
         {"mylohyoid_posterior", 0.5}},
        {{"pterygoid_lateral_inferior", 1},
         {"pterygoid_lateral_superior", 0.5},
         {"masseter_superficial", 0.1},
         {"pterygoid_medial", 0.1},
         {"digastric_anterior", 0.15}},
        {{"temporalis_posterior", 1}, {"temporalis_middle", 0.3}},
        {{"pterygoid_lateral_inferior.r", 1},
         {"pterygoid_medial.r", 0.1},
         {"temporalis_posterior.l", 0.3},
         {"temporalis_middle.l", 0.1},
         {"digastric_anterior", 0.3}},
        {{"pterygoid_lateral_inferior.l", 1},
         {"pterygoid_medial.l", 0.1},
         {"temporalis_posterior.r", 0.3},
         {"temporalis_middle.r", 0.1},
         {"digastric_anterior", 0.3}}};
    return all[group];
}

}  // namespace

JawSynergies::JawSynergies(const JawDynamics& jaw, const track::ChannelTable& channels,
                           const Ranges& ranges, const JawMatrix& tissue) {
    JawVector gives = JawVector::Constant(kGives[1]);
    gives[kOpen] = kGives[0];
    const JawMatrix spring = gives.asDiagonal() * tissue * gives.asDiagonal();
    const auto held = [&](const JawVector& q) {
        JawVector strain = q, slope = JawVector::Ones();
        if (const double over = q[kOpen] - 1e-3 * kYield_mm * jaw.joint().size(); over > 0) {
            strain[kOpen] -= (1 - kYielded) * over;
            slope[kOpen] = std::sqrt(kYielded);
        }
        return JawLoad{q, spring * strain, slope.asDiagonal() * spring * slope.asDiagonal()};
    };
    for (int group = 0; group < kGroups; ++group) {
        pattern_[group] = Eigen::VectorXd::Zero(channels.column_count());
        for (const Share& fraction : fractions(group)) {
            const track::SidedName name = track::split_side(fraction.muscle);
            for (const Side side : {Side::kLeft, Side::kRight})
                if (const int column = channels.column(name.id, side);
                    column >= 0 && (!name.side || *name.side == side))
                    pattern_[group][column] = fraction.weight;
        }
        samples_[group].push_back({0, 0});
        JawDynamics::State state;  // each level continues from the one before
        for (const double level : kLevels) {
            for (int i = 0; i < kTrySteps; ++i) {
                const auto step = jaw.begin(kTryStep_s, state, level * pattern_[group]);
                JawVector q = state.q;
                const JawLoad load = held(q);
                jaw.minimise(step, q, &load);
                state = jaw.end(step, q);
            }
            const JawPlace place = jaw.joint().place(state.q);
            const double moved = group == kOpening     ? place.open_m / ranges.open_m
                                 : group == kForwards  ? place.forward_m / ranges.forward_m
                                 : group == kBackwards ? -place.forward_m / ranges.forward_m
                                 : group == kLeft      ? place.side_m / ranges.side_m
                                                       : -place.side_m / ranges.side_m;
            if (moved > samples_[group].back().moved + kMinMove)
                samples_[group].push_back({moved, level});
        }
    }
}

double JawSynergies::level(Group group, double moved) const {
    if (moved <= 0) return 0;
    const std::vector<Sample>& samples = samples_[group];
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (moved <= samples[i].moved) {
            const double fraction =
                (moved - samples[i - 1].moved) / (samples[i].moved - samples[i - 1].moved);
            return (1 - fraction) * samples[i - 1].level + fraction * samples[i].level;
        }
    return samples.back().level;  // beyond the reach of the muscles
}

Eigen::VectorXd JawSynergies::excitation(double open, double forward, double side) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(pattern_[0].size());
    for (const auto& [group, moved] : {std::pair{kOpening, open},
                                       {kForwards, forward},
                                       {kBackwards, -forward},
                                       {kLeft, side},
                                       {kRight, -side}})
        if (moved > 0) sum += level(group, moved) * pattern_[group];
    return sum.cwiseMin(1.0);
}

}  // namespace risorius::face
