// SPDX-License-Identifier: MIT
// The prototype muscle between planes. Its belly swells uniformly along its length, so it is fibre, tendon and matrix in
// series.

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/tissue/grid_shape.h"
#include "softbody/muscle_bench.h"

namespace risorius::softbody {
namespace {

using namespace testing_of;

MuscleDescription between_planes(const tissue::GridShape& grid, double mu_pa = 2e3) {
    MuscleDescription d = prototype_muscle(grid);
    d.moduli.mu_pa = mu_pa;
    d.origin.hold = d.insertion.hold = MuscleEnd::Hold::kPlane;
    return d;
}

/// Tension of fibre and matrix in parallel, in series with the tendon, divided by F0. The matrix stores mu/4 |C - 1|^2, where C
/// is that of a volume-preserving stretch s.
double tension_in_matrix(const MuscleDescription& d, double section_m2, double length,
                         double activation) {
    const muscle::MuscleCurves curves = muscle::zajac_curves();
    const double matrix = d.moduli.mu_pa * section_m2 / d.musculotendon.f0_n;
    const auto pull = [&](double s) {
        return activation * curves.active.value(s) + curves.passive.value(s) +
               matrix * (s * (s * s - 1) - (1 / s - 1) / (s * s));
    };
    // Tendons are half as long as fibres. Where fibres would push, tendons are slack.
    if (!(pull(length) > 0)) return 0;
    double low = 0.3, high = length;
    for (int i = 0; i < 60; ++i) {
        const double s = (low + high) / 2;
        (pull(s) > curves.tendon.value((length - s) / 0.5) ? high : low) = s;
    }
    return pull(low);
}

struct FromLine {
    /// Difference of active tension from fibre and tendon in series.
    double line = 0, line_from_06 = 0;
    double matrix = 0;  ///< difference of tension from that with the matrix
    double aside = 0;   ///< maximum force along a plate / F0
};

/// T8a from 0.5 to 1.6.
FromLine tension_between_planes(const MuscleDescription& d) {
    MuscleBench relaxed(d), shortening(d), lengthening(d);
    const double section_m2 = relaxed.muscle().body.volume(relaxed.rest()) / d.length_m;
    FromLine found;
    const auto measure = [&](MuscleBench& bench, int k) {
        const double length = 1 + 0.1 * k, lengthening_m = 0.1 * k * 0.04;
        bench.at(1, lengthening_m);
        double passive = 0;  // between slack tendons
        if (k > 0) {
            relaxed.at(0, lengthening_m);
            passive = relaxed.tension();
        }
        const double line =
            line_tension(d.musculotendon, length, 1) - line_tension(d.musculotendon, length, 0);
        const double off = std::abs(bench.tension() - passive - line);
        found.line = std::max(found.line, off);
        if (k >= -4) found.line_from_06 = std::max(found.line_from_06, off);
        const auto from_matrix = [&](double tension, double activation) {
            found.matrix =
                std::max(found.matrix,
                         std::abs(tension - tension_in_matrix(d, section_m2, length, activation)));
        };
        from_matrix(bench.tension(), 1);
        from_matrix(passive, 0);
        const Vec3 pull =
            bench.muscle().musculotendon->anchor_pull(muscle::End::kInsertion, 0, bench.x());
        found.aside = std::max(found.aside, pull.tail<2>().norm() / d.musculotendon.f0_n);
    };
    for (int k = 0; k >= -5; --k) measure(shortening, k);
    for (int k = 1; k <= 6; ++k) measure(lengthening, k);
    return found;
}

TEST(PlaneMuscle, TensionOverLengthIsThatOfTheLineMuscleAndItsMatrix) {
    const FromLine found = tension_between_planes(between_planes({3, 4, 4}));
    EXPECT_LT(found.line_from_06, 0.02);
    EXPECT_LT(found.matrix, 5e-4);
    EXPECT_LT(found.aside, 1e-6);
}

// Compressed to half its length, a matrix of 2 kPa reduces tension by 0.029 F0, and one of 1 kPa by half of that.
TEST(PlaneMuscle, ASofterMatrixIsWithinTwoPercentAtEveryLength) {
    EXPECT_LT(tension_between_planes(between_planes({3, 4, 4}, 1e3)).line, 0.02);
}

TEST(PlaneMuscle, AShortenedBellySwellsAlikeAllAlong) {
    MuscleBench bench(between_planes({5, 4, 4}));
    bench.at(1, 0);
    const Points& x = bench.at(1, -0.01);
    const double stretch = bench.muscle().musculotendon->stretch(x).mean();
    for (const int m : {0, 1, 2, 3, 4})
        for (const int node : tissue::plane_nodes(bench.muscle().body.grid, 0, m)) {
            const double swelling =
                x.row(node).tail(2).norm() / bench.rest().row(node).tail(2).norm();
            EXPECT_NEAR(swelling, 1 / std::sqrt(stretch), 0.01) << node;
        }
    EXPECT_NEAR(1 / std::sqrt(stretch), 1.164, 0.005);
    EXPECT_LT(std::abs(bench.volume_change()), 0.003);
}

TEST(PlaneMuscle, WhatHoldsItBesideTheAxisTakesNothingOffItsTension) {
    MuscleDescription d = between_planes({3, 3, 3});
    MuscleBench floating(d);
    floating.at(1, -0.01);
    d.gravity_m_per_s2 = {0, -9.81, 0};
    MuscleBench hanging(d);
    hanging.at(1, -0.01);
    EXPECT_NEAR(hanging.tension(), floating.tension(), 1e-3);
    const auto& muscle = *hanging.muscle().musculotendon;
    const Vec3 pull = muscle.anchor_pull(muscle::End::kOrigin, 0, hanging.x()) +
                      muscle.anchor_pull(muscle::End::kInsertion, 0, hanging.x());
    const double weight_n = 9.81 * hanging.muscle().body.system.mass_kg().sum();
    EXPECT_NEAR(pull.y(), -weight_n, 1e-3 * weight_n);
    EXPECT_LT(hanging.x().col(1).mean(), -1e-6);
}

TEST(PlaneMuscle, EndsAreReadAsPlanes) {
    const Json json = Json::parse(R"({"grid": [3, 2, 2], "section": "block",
        "length_m": 0.04, "width_m": 0.01, "thickness_m": 0.01, "insertion": "plane",
        "moduli": {"shear_pa": 2000, "bulk_pa": 5e6},
        "musculotendon": {"f0_n": 10, "optimal_length_m": 0.04, "tendon_slack_m": 0.01}})");
    const MuscleDescription d =
        read_muscle(JsonCursor::from_json({{"muscle", json}}, "head.json").at("muscle"));
    EXPECT_EQ(d.origin.hold, MuscleEnd::Hold::kPlate);
    EXPECT_EQ(d.insertion.hold, MuscleEnd::Hold::kPlane);
}

}  // namespace
}  // namespace risorius::softbody
