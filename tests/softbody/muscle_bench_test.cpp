// SPDX-License-Identifier: MIT
// Experiments of Zajac and of Gasser and Hill on a muscle of cells: tension over length, quick release, bulging, stability.

#include "softbody/muscle_bench.h"

#include <cmath>

#include "risorius/tissue/grid_shape.h"

namespace risorius::softbody {
namespace {

using namespace testing_of;

struct TensionLength {
    double worst_active = 0;  ///< maximum difference from the line muscle
    double peak = 0, peak_at = 0;
    double published = 0;  ///< maximum difference from the published table
};

/// Active tension, total minus passive, from the shortest to the longest muscle.
TensionLength tension_length(const MuscleDescription& d) {
    TensionLength found;
    const double l0 = d.musculotendon.optimal_length_m;
    std::vector<double> passive;
    MuscleBench relaxed(d);
    for (int k = 1; k <= 6; ++k) {
        relaxed.at(0, 0.1 * k * l0);
        passive.push_back(relaxed.tension());
    }
    const auto active_at = [&](MuscleBench& bench, double length) {
        bench.at(1, (length - 1) * l0);
        // A relaxed muscle that is shorter than its slack length has no tension.
        const int k = static_cast<int>(std::lround(10 * (length - 1)));
        const double active =
            bench.tension() - (k > 0 ? passive[static_cast<std::size_t>(k) - 1] : 0);
        const double line =
            line_tension(d.musculotendon, length, 1) - line_tension(d.musculotendon, length, 0);
        found.worst_active = std::max(found.worst_active, std::abs(active - line));
        if (active > found.peak) found.peak = active, found.peak_at = length;
    };
    MuscleBench shortening(d), lengthening(d);
    for (int k = 0; k <= 5; ++k) active_at(shortening, 1 - 0.1 * k);
    for (int k = 1; k <= 6; ++k) active_at(lengthening, 1 + 0.1 * k);
    return found;
}

TEST(MuscleBench, ActiveTensionOverLengthIsThatOfTheLineMuscle) {
    const TensionLength found = tension_length(prototype_muscle({6, 3, 3}));
    EXPECT_LT(found.worst_active, 0.04);
    EXPECT_GT(found.peak, 0.97);
    EXPECT_LT(found.peak, 1.01);
    EXPECT_EQ(found.peak_at, 1);
}

// When the belly is a quarter as thick as long, its fibres are curved outwards. They press on the belly and the belly on its
// ends, which reduces tension by 0.04 F0 at 0.7 l0. The effect grows with the square of the thickness. With half that thickness
// all differences are below 0.02 F0.
TEST(MuscleBench, ActiveTensionOfASlenderMuscleIsWithinTwoPercentOfTheLineMuscle) {
    const TensionLength found = tension_length(prototype_muscle({5, 3, 3}, 0.005));
    EXPECT_LT(found.worst_active, 0.02);
    EXPECT_NEAR(found.peak, 0.998, 0.002);
}

struct Release {
    double before = 0, slack = 0, after = 0;  ///< tension / F0
    double t50_s = 0, t90_s = 0;  ///< from the release to that fraction of the last tension
};

/// Full activation; the anchors approach each other by 2.5 mm within 1 ms.
Release released(double max_speed_hz) {
    MuscleDescription d = prototype_muscle({4, 3, 3});
    d.musculotendon.max_speed_hz = max_speed_hz;
    d.musculotendon.damping = 0.07;
    constexpr double kRelease_s = 1e-3, kBy_m = 2.5e-3;
    const MuscleBody muscle = build_muscle(
        d, {.activation = [](double) { return 1.0; },
            .lengthening_m =
                [](double t_s) { return -kBy_m * std::clamp(t_s / kRelease_s, 0.0, 1.0); }});
    const solve::IntegratorOptions quiet{
        .method = solve::Method::kQuasiStatic, .step_s = 1, .length_scale_m = 0.04};
    solve::MotionState state = muscle.body.start();
    solve::make_integrator(quiet)->advance(muscle.body.system, state, 0);
    Release found{.before = muscle.tension(0, state.x)};

    solve::MotionState last = state;
    solve::make_integrator(quiet)->advance(muscle.body.system, last, 1);
    found.after = muscle.tension(1, last.x);

    // Steps of half a millisecond, and later of a hundredth of the recovery time.
    solve::IntegratorOptions moving{.step_s = 5e-4, .length_scale_m = 0.04};
    auto integrator = solve::make_integrator(moving);
    integrator->advance(muscle.body.system, state, kRelease_s);
    found.slack = muscle.tension(kRelease_s, state.x);
    moving.step_s = std::max(5e-4, 2e-3 / max_speed_hz);
    integrator = solve::make_integrator(moving);
    double before = found.slack;
    while (found.t90_s == 0 && state.t_s < 0.5) {
        const double from_s = state.t_s;
        integrator->advance(muscle.body.system, state, from_s + moving.step_s);
        const double tension = muscle.tension(state.t_s, state.x);
        const auto crossing = [&](double fraction, double& when_s) {
            const double wanted = fraction * found.after;
            if (when_s == 0 && tension >= wanted)
                when_s = from_s + moving.step_s * (wanted - before) / (tension - before);
        };
        crossing(0.5, found.t50_s);
        crossing(0.9, found.t90_s);
        before = tension;
    }
    return found;
}

// Gasser and Hill's quick release: the tendons become slack, and slower fibres take longer to tighten them.
TEST(MuscleBench, AfterAQuickReleaseTensionComesBackAsFastAsTheFibresShorten) {
    const struct {
        double speed_hz, t90_s;
    } published[] = {{10, 15.2e-3}, {4, 36.6e-3}, {2, 72.2e-3}};
    std::vector<double> shortening;  // t50 vmax
    for (const auto& [speed_hz, t90_s] : published) {
        const Release found = released(speed_hz);
        EXPECT_NEAR(found.before, 0.995, 0.015);
        EXPECT_LT(found.slack, 0.05);
        EXPECT_NEAR(found.after, 0.9725, 0.0125);
        EXPECT_NEAR(found.t90_s / t90_s, 1, 0.2) << speed_hz;
        shortening.push_back(found.t50_s * speed_hz);
        EXPECT_GT(shortening.back(), 85e-3) << speed_hz;
        EXPECT_LT(shortening.back(), 100e-3) << speed_hz;
    }
    const auto [min, max] = std::minmax_element(shortening.begin(), shortening.end());
    EXPECT_LT(*max / *min, 1.1);
}

TEST(MuscleBench, AnActiveMuscleShortenedByAQuarterBulgesAndKeepsItsVolume) {
    MuscleBench bench(prototype_muscle({5, 5, 5}));
    bench.at(1, 0);
    EXPECT_LT(std::abs(bench.volume_change()), 0.003);
    const Points& x = bench.at(1, -0.01);
    double radius = 0;
    int count = 0;
    for (const int node : tissue::plane_nodes(bench.muscle().body.grid, 0, 2)) {
        if (bench.rest().row(node).tail(2).norm() < 0.0099) continue;  // not on the rim
        radius += x.row(node).tail(2).norm();
        ++count;
    }
    ASSERT_EQ(count, 16);
    EXPECT_GT(radius / count / 0.01, 1.15);
    EXPECT_LT(radius / count / 0.01, 1.23);
    EXPECT_LT(std::abs(bench.volume_change()), 0.003);
    EXPECT_NEAR(bench.volume_change(), -0.0014, 0.0004);  // for 5 MPa; it is proportional to 1 / K
}

// Segments in series would diverge in length on the falling limb. The force-length curve of the whole chain keeps them together
// permanently.
TEST(MuscleBench, SegmentsOfAnActiveStretchedMuscleStayTogether) {
    const MuscleDescription d = prototype_muscle({6, 3, 3}, 0.005);
    const MuscleBody muscle = build_muscle(
        d, {.activation = [](double) { return 1.0; },
            .lengthening_m = [](double t_s) { return 0.01 * std::min(1.0, t_s / 0.1); }});
    const auto integrator = solve::make_integrator({.step_s = 0.05, .length_scale_m = 0.04});
    solve::MotionState state = muscle.body.start();
    integrator->advance(muscle.body.system, state, 0.5);
    const double early = muscle.musculotendon->segment_spread(state.x);
    integrator->advance(muscle.body.system, state, 2.5);
    const double late = muscle.musculotendon->segment_spread(state.x);
    EXPECT_LT(late, 0.05);
    EXPECT_NEAR(late, early, 0.005);
}

}  // namespace
}  // namespace risorius::softbody
