// SPDX-License-Identifier: MIT
// Muscles of every shape contract: volume, balance of forces, behaviour of rings and fans, rigid tendons, and what is rejected.

#include <cmath>

#include "force_term_checks.h"
#include "muscle_shapes.h"
#include "risorius/core/error.h"
#include "softbody/muscle_bench.h"

namespace risorius::softbody {
namespace {

using namespace testing_of;

struct Sample {
    muscle::MuscleShape shape;
    tissue::GridShape grid;
    double area_m2;  ///< area of the thickest section
};

std::vector<Sample> samples() {
    return {{block_shape(), {5, 3, 3}, 2e-4},   {fusiform_shape(), {6, 3, 3}, 2.5e-4},
            {sheet_shape(), {5, 5, 2}, 1.5e-4}, {bent_shape(), {7, 3, 3}, 7.5e-5},
            {ring_shape(), {12, 3, 3}, 3.1e-5}, {spindle_shape(1.2), {7, 3, 3}, 2.2e-4}};
}

/// 0.30 MPa of specific tension. K is 15 times the stress at the thinnest section.
MuscleDescription shaped(const Sample& sample,
                         muscle::TendonModel tendon = muscle::TendonModel::kElastic) {
    MuscleDescription d;
    d.place = "muscle";
    d.grid = sample.grid;
    d.shape = sample.shape;
    d.moduli = {.mu_pa = 2e3, .bulk_pa = 20e6, .viscosity_pa_s = 200};
    const double l0 = muscle::muscle_belly(sample.shape, sample.grid).fibre_length_m.mean();
    d.musculotendon = {.f0_n = 0.3e6 * sample.area_m2,
                       .optimal_length_m = l0,
                       .tendon_slack_m = tendon == muscle::TendonModel::kRigid ? 0 : 0.3 * l0};
    d.musculotendon.tendon = tendon;
    if (sample.shape.form == muscle::MuscleShape::Form::kRing) d.bed_n_per_m = 8000;
    return d;
}

TEST(ShapedMuscle, EveryShapeKeepsItsVolumeThroughFullContraction) {
    for (const Sample& sample : samples()) {
        const MuscleDescription d = shaped(sample);
        MuscleBench bench(d);
        double worst = 0;
        const auto look = [&](double activation, double shortening) {
            bench.at(activation, -shortening * d.musculotendon.optimal_length_m);
            worst = std::max(worst, std::abs(bench.volume_change()));
        };
        look(0.3, 0);
        look(1, 0);
        if (sample.shape.form != muscle::MuscleShape::Form::kRing) {
            look(1, 0.15);
            look(1, 0.3);
        }
        EXPECT_GT(worst, 1e-6) << sample.shape.place;
        EXPECT_LT(worst, 0.003) << sample.shape.place;
        EXPECT_LT(bench.muscle().musculotendon->stretch(bench.x()).maxCoeff(), 0.8)
            << sample.shape.place;
    }
}

TEST(ShapedMuscle, ForcesAndTorquesOfEveryShapeAndItsAnchorsSumToZero) {
    for (const Sample& sample : samples())
        for (const auto tendon : {muscle::TendonModel::kElastic, muscle::TendonModel::kRigid}) {
            MuscleDescription d = shaped(sample, tendon);
            d.bed_n_per_m = 0;
            const MuscleBody muscle = build_muscle(d, {[](double) { return 0.8; }});
            const long rows = muscle.body.rest.rows();
            Points x = 1.1 * muscle.body.rest + random_points(rows, 1e-4, 1), force;
            muscle.body.system.force(0, x, random_points(rows, 0.05, 2), force);
            const double max = force.cwiseAbs().maxCoeff();
            Vec3 sum = force.colwise().sum(), torque = Vec3::Zero();
            for (long i = 0; i < rows; ++i) torque += Vec3(x.row(i)).cross(Vec3(force.row(i)));
            for (const muscle::End end : {muscle::End::kOrigin, muscle::End::kInsertion}) {
                // Rigid tendons are part of the nodes.
                if (tendon == muscle::TendonModel::kRigid) continue;
                const Points points = muscle.musculotendon->anchor_points(end, 0),
                             pulls = muscle.musculotendon->anchor_forces(end, 0, x);
                sum += muscle.musculotendon->anchor_pull(end, 0, x);
                for (long c = 0; c < points.rows(); ++c)
                    torque += Vec3(points.row(c)).cross(Vec3(pulls.row(c)));
            }
            EXPECT_GT(max, 1) << sample.shape.place;
            EXPECT_LT(sum.norm(), 1e-11 * max) << sample.shape.place;
            EXPECT_LT(torque.norm(), 1e-12 * max) << sample.shape.place;
        }
}

TEST(ShapedMuscle, ARingNarrowsItsOpeningAndStaysWhereItIs) {
    MuscleBench bench(shaped({ring_shape(), {12, 3, 3}, 3.1e-5}));
    const tissue::GridShape& grid = bench.muscle().body.grid;
    const auto opening = [&](const Points& x) {
        double twice = 0;
        for (int m = 0; m < grid.m; ++m) {
            const auto a = x.row(grid.index(m, 2, 1)), b = x.row(grid.index(grid.next(m), 2, 1));
            twice += a.x() * b.y() - a.y() * b.x();
        }
        return twice / 2;
    };
    const double whole = opening(bench.rest());
    double before = whole;
    for (const double activation : {0.1, 0.3, 1.0}) {
        const double now = opening(bench.at(activation, 0));
        EXPECT_LT(now, 0.95 * before) << activation;
        before = now;
        const Vec3 middle = (bench.x() - bench.rest()).colwise().mean();
        EXPECT_LT(middle.norm(), 1e-5) << activation;
    }
    EXPECT_LT(before, 0.6 * whole);
    EXPECT_GT(before, 0.2 * whole);
}

TEST(ShapedMuscle, FibresOfAFanAreStretchedAlike) {
    for (const double shortening : {0.0, 0.2}) {
        const MuscleDescription d = shaped({sheet_shape(), {6, 5, 2}, 1.5e-4});
        MuscleBench bench(d);
        bench.at(1, 0);
        bench.at(1, -shortening * d.musculotendon.optimal_length_m);
        const Eigen::VectorXd stretch = bench.muscle().musculotendon->stretch(bench.x());
        EXPECT_LT(stretch.maxCoeff() - stretch.minCoeff(), 0.01) << shortening;
    }
}

TEST(ShapedMuscle, RigidTendonsLeaveTheFibresThePathLessTheirLength) {
    MuscleDescription d = prototype_muscle({5, 3, 3}, 0.005);
    d.musculotendon.tendon = muscle::TendonModel::kRigid;
    MuscleBench bench(d);
    for (const double normalised : {1.0, 0.9, 0.8, 1.1, 1.3}) {
        const double lengthening = (normalised - 1) * d.musculotendon.optimal_length_m;
        bench.at(1, lengthening);
        const auto& muscle = *bench.muscle().musculotendon;
        const double path = (muscle.anchor_points(muscle::End::kInsertion, 0).row(4) -
                             muscle.anchor_points(muscle::End::kOrigin, 0).row(4))
                                .norm();
        EXPECT_NEAR(path, 0.06 + lengthening, 1e-15);
        EXPECT_NEAR(muscle.stretch(bench.x())[4] * 0.04, path - 0.02, 1e-8);
        EXPECT_NEAR(bench.tension(), line_tension(d.musculotendon, normalised, 1), 0.03)
            << normalised;
        EXPECT_LT(std::abs(bench.volume_change()), 0.003);
    }
    bench.at(1, 0);
    EXPECT_NEAR(bench.tension(), 1, 1e-9);
}

TEST(ShapedMuscle, AFreeInsertionIsDrawnTowardsTheBone) {
    MuscleDescription d = shaped({bent_shape(), {7, 3, 3}, 7.5e-5});
    d.musculotendon.tendon = muscle::TendonModel::kRigid;
    d.musculotendon.tendon_slack_m = 0;
    d.insertion.hold = MuscleEnd::Hold::kFree;
    MuscleBench bench(d);
    bench.at(0.02, 0);
    const auto end = [&](const Points& x) -> Vec3 {
        return x.row(bench.muscle().body.grid.index(6, 1, 1));
    };
    const auto start = [&](const Points& x) -> Vec3 {
        return x.row(bench.muscle().body.grid.index(0, 1, 1));
    };
    EXPECT_EQ(start(bench.x()), start(bench.rest()));
    EXPECT_LT((end(bench.x()) - start(bench.x())).norm(),
              0.9 * (end(bench.rest()) - start(bench.rest())).norm());
    // Only the bone holds it, and the bone gets no force.
    EXPECT_NEAR(bench.tension(), 0, 1e-6);
}

TEST(ShapedMuscle, TendonsToOnePointOfABonePullThere) {
    MuscleDescription d = shaped({block_shape(), {5, 3, 3}, 2e-4});
    d.origin.hold = MuscleEnd::Hold::kBone;
    d.origin.points_m.resize(1, 3);
    d.origin.points_m.row(0) << -0.02, 0, 0;
    MuscleBench bench(d);
    bench.at(0, 0);
    EXPECT_LT(std::abs(bench.tension()), 1e-9);
    bench.at(1, 0);
    const auto& muscle = *bench.muscle().musculotendon;
    const Vec3 pull = muscle.anchor_pull(muscle::End::kOrigin, 0, bench.x());
    EXPECT_NEAR(pull.x(), d.musculotendon.f0_n, 0.1 * d.musculotendon.f0_n);
    EXPECT_LT(pull.tail<2>().norm(), 1e-6 * pull.x());
}

Json described() {
    return Json::parse(R"({"grid": [5, 3, 3],
        "shape": {"path": {"path_m": [[0, 0, 0], [0.02, 0, 0.005], [0.04, 0, 0]], "width_m": 0.01,
                           "thickness_m": 0.004}},
        "origin": {"points_m": [[-0.01, -0.005, 0], [-0.01, 0.005, 0]]}, "insertion": "free",
        "moduli": {"shear_pa": 2000, "bulk_pa": 5e6},
        "musculotendon": {"f0_n": 10, "optimal_length_m": 0.042, "tendon_slack_m": 0.01}})");
}

std::string message(const Json& json) {
    try {
        build_muscle(
            read_muscle(JsonCursor::from_json({{"muscle", json}}, "head.json").at("muscle")),
            {[](double) { return 0.0; }});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ShapedMuscle, ShapesAndEndsAreReadFromJson) {
    EXPECT_EQ(message(described()), "");
    Json json = described();
    json["length_m"] = 0.04;
    EXPECT_EQ(message(json),
              "head.json:/muscle/length_m: expected no sizes beside \"shape\", found 0.04");
    json = described();
    json["discretisation"] = "differences";
    EXPECT_EQ(
        message(json),
        "head.json:/muscle/discretisation: expected \"cells\", which alone know shapes, found "
        "\"differences\"");
    json = described();
    json["shape"]["path"]["thickness_m"] = 0;
    EXPECT_EQ(message(json),
              "head.json:/muscle/shape/path/thickness_m: expected a number in (0, inf), found 0");
    json = described();
    json["insertion"] = "loose";
    EXPECT_EQ(message(json),
              "head.json:/muscle/insertion: expected one of \"plate\" \"plane\" \"free\", found "
              "\"loose\"");
    json = described();
    json.erase("insertion");
    json["musculotendon"].erase("tendon_slack_m");
    EXPECT_EQ(
        message(json),
        "head.json:/muscle/musculotendon/tendon_slack_m: expected (0, inf) of elastic tendons, "
        "found 0");
    json["musculotendon"]["tendon"] = "rigid";
    EXPECT_EQ(message(json), "");
    Json ring = described();
    ring["shape"] = Json::parse(R"({"ring": {"path_m": [[0.02, 0, 0], [0, 0.02, 0], [-0.02, 0, 0],
        [0, -0.02, 0]], "width_m": 0.006, "thickness_m": 0.004}})");
    EXPECT_EQ(message(ring),
              "head.json:/muscle/origin: expected no end of a ring, found an object with 1 keys");
    ring.erase("origin");
    ring.erase("insertion");
    EXPECT_EQ(message(ring), "");
}

}  // namespace
}  // namespace risorius::softbody
