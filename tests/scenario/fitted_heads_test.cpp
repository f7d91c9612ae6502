// SPDX-License-Identifier: MIT
// Heads made by others, fitted from their landmarks alone: the same muscles do the same things on both.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "paths.h"
#include "risorius/face/diagnostics.h"
#include "risorius/fitting/fit_rig.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/facs.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

struct HeadFiles {
    const char* name;
    const char* mesh;
    const char* landmarks;
};
const HeadFiles kHeads[] = {
    {"ict", "data/heads/ict/ict_neutral.obj", "ict_landmarks.json"},
    {"makehuman", "data/heads/makehuman/mh_head.obj", "makehuman_landmarks.json"}};

/// One head, fitted and built once for all tests of it.
struct Fitted {
    Folder folder;
    fitting::FitReport report;
    scene::RigFiles files;
    std::unique_ptr<face::Face> face;
    std::unique_ptr<scene::LandmarkPoints> points;
    Points rest;
    mutable bool in_equilibrium = false;  // in settled()

    explicit Fitted(const HeadFiles& head) {
        fitting::FitOptions options;
        options.mesh = fs::path(RISORIUS_SHARED_DIR) / head.mesh;
        options.landmarks = kRoot / "tests/data/heads" / head.landmarks;
        options.out = folder / "rig.json";
        options.together = std::string(head.name) == "makehuman";  // takes its time: once
        report = fitting::fit_rig(options);
        files = scene::read_rig_files(options.out);
        face = std::make_unique<face::Face>(files.rig, files.mesh, face::quality_named("video"),
                                            files.place());
        points = std::make_unique<scene::LandmarkPoints>(face->head(), files.rig);
        rest = face->pose().vertices;
    }

    track::Drive drive_of(const std::string& unit, std::optional<Side> side = std::nullopt) const {
        const auto channels = files.rig.channels();
        const track::Expansion e = track::expand(*files.rig.facs.find(unit), side, channels);
        return {e.excitation, Eigen::VectorXd(), e.kinematic};
    }

    /// At rest under the drive, from the neutral face.
    face::FacePose equilibrium_pose(const track::Drive& drive) const {
        track::Drive none = drive;
        none.excitation.setZero();
        none.kinematic.fill(0);
        face->start([&](double) { return none; });
        in_equilibrium = face->solve_equilibrium(drive.excitation, drive).converged;
        return face->pose();
    }

    Vec3 moved_mm(const std::string& id, const face::FacePose& pose) const {
        return 1e3 * (points->at(id, pose.vertices) - points->at(id, rest));
    }
};

class FittedHead : public testing::TestWithParam<HeadFiles> {
  protected:
    static std::map<std::string, std::unique_ptr<Fitted>>& heads() {
        static std::map<std::string, std::unique_ptr<Fitted>> all;
        return all;
    }
    void SetUp() override {
        if (!fs::exists(fs::path(RISORIUS_SHARED_DIR) / GetParam().mesh))
            GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
        auto& head = heads()[GetParam().name];
        if (!head) head = std::make_unique<Fitted>(GetParam());
        fitted = head.get();
    }
    Fitted* fitted = nullptr;
};

TEST_P(FittedHead, IsFoundToBeAHeadInCentimetresWithEveryMuscleStrongEnough) {
    const fitting::FitReport& report = fitted->report;
    EXPECT_EQ(report.metres_per_unit, 0.01);
    EXPECT_GT(report.size, 0.85);
    EXPECT_LT(report.size, 1.15);
    EXPECT_LT(report.residual_mm, 10);
    EXPECT_TRUE(report.eyes);
    EXPECT_TRUE(report.teeth);
    EXPECT_EQ(report.inverted_tets, 0);
    EXPECT_LT(report.dropped_tets, report.tets / 50);
    EXPECT_EQ(report.strengths.size(), 28u);
    int reached = 0;
    for (const fitting::MuscleStrength& m : report.strengths) {
        // Limits of each muscle by itself, then of the factor when all are scaled together
        EXPECT_GE(m.strength, 0.1 / std::exp(1.0) - 1e-4) << m.muscle;
        EXPECT_LE(m.strength, 6.0 * std::exp(1.0) + 1e-4) << m.muscle;
        reached += std::abs(m.stretch - m.target_stretch) < 0.02;
        EXPECT_TRUE(m.at_limit || std::abs(m.stretch - m.target_stretch) < 0.05)
            << m.muscle << " " << m.stretch;
    }
    EXPECT_GE(reached, 24);
    if (std::string(GetParam().name) == "makehuman") {
        EXPECT_GT(report.difference_before, 0.3);
        EXPECT_LT(report.difference, 0.28) << "expressions as on the standard head";
    }
}

TEST_P(FittedHead, RestsExactlyAsItsMesh) {
    const track::Drive none = [&] {
        track::Drive drive = fitted->drive_of("AU12");
        drive.excitation.setZero();
        return drive;
    }();
    fitted->face->start([&](double) { return none; });
    EXPECT_LT((fitted->face->pose().vertices - fitted->face->head().vertices).cwiseAbs().maxCoeff(),
              1e-6);
    const Points later = fitted->face->pose_at(0.2, [&](double) { return none; }).vertices;
    EXPECT_LT((later - fitted->face->head().vertices).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_P(FittedHead, ZygomaticusDrawsTheCornersUpAndOut) {
    const face::FacePose pose = fitted->equilibrium_pose(fitted->drive_of("AU12"));
    EXPECT_TRUE(pose.vertices.allFinite());
    const Vec3 left = fitted->moved_mm("ch_l", pose), right = fitted->moved_mm("ch_r", pose);
    EXPECT_GT(left.norm(), 5) << left.transpose();
    EXPECT_GT(right.norm(), 5) << right.transpose();
    EXPECT_GT(left.y(), 2);
    EXPECT_GT(right.y(), 2);
    EXPECT_GT(left.x(), 1);
    EXPECT_LT(right.x(), -1);
}

TEST_P(FittedHead, BlinkClosesTheLids) {
    const face::FacePose pose = fitted->equilibrium_pose(fitted->drive_of("AU45"));
    EXPECT_TRUE(pose.vertices.allFinite());
    for (const auto& [upper, lower] : {std::pair{"ps_l", "pi_l"}, std::pair{"ps_r", "pi_r"}}) {
        EXPECT_GT(1e3 * fitted->points->distance(upper, lower, fitted->rest), 6);
        EXPECT_LT(fitted->points->at(upper, pose.vertices).y() * 1e3 -
                      fitted->points->at(lower, pose.vertices).y() * 1e3,
                  0.6)
            << upper;
    }
}

TEST_P(FittedHead, OpenJawOpensTheMouth) {
    track::Drive drive = fitted->drive_of("AU12");
    drive.excitation.setZero();
    drive.kinematic.fill(0);
    drive.kinematic[static_cast<std::size_t>(track::Kinematic::kJawOpen)] = 1;
    const face::FacePose pose = fitted->equilibrium_pose(drive);
    EXPECT_TRUE(pose.vertices.allFinite());
    EXPECT_TRUE(fitted->in_equilibrium);
    EXPECT_GT(1e3 * fitted->points->distance("stos", "stoi", pose.vertices), 20);
    EXPECT_LT(fitted->moved_mm("pg", pose).y(), -15);
    EXPECT_LT(fitted->moved_mm("n", pose).norm(), 2);
}

TEST_P(FittedHead, FrontalisRaisesTheBrows) {
    track::Drive drive = fitted->drive_of("AU1");
    drive.excitation = drive.excitation.cwiseMax(fitted->drive_of("AU2").excitation);
    const face::FacePose pose = fitted->equilibrium_pose(drive);
    EXPECT_TRUE(pose.vertices.allFinite());
    for (const char* brow : {"bm_l", "bm_r", "bc_l", "bc_r"})
        EXPECT_GT(fitted->moved_mm(brow, pose).y(), 3) << brow;
}

TEST_P(FittedHead, OneSideMovesAlone) {
    for (const auto& [side, own, other, sign] : {std::tuple{Side::kLeft, "ch_l", "ch_r", 1.0},
                                                 std::tuple{Side::kRight, "ch_r", "ch_l", -1.0}}) {
        const face::FacePose pose = fitted->equilibrium_pose(fitted->drive_of("AU12", side));
        const Vec3 here = fitted->moved_mm(own, pose), there = fitted->moved_mm(other, pose);
        EXPECT_GT(here.norm(), 5);
        EXPECT_GT(sign * here.x(), 1);
        EXPECT_LT(there.norm(), 0.6 * here.norm()) << other;
        EXPECT_LT(there.y(), 0.4 * here.y());
    }
    for (const auto& [side, own, other] :
         {std::tuple{Side::kLeft, "bc_l", "bc_r"}, std::tuple{Side::kRight, "bc_r", "bc_l"}}) {
        const face::FacePose pose = fitted->equilibrium_pose(fitted->drive_of("AU2", side));
        EXPECT_GT(fitted->moved_mm(own, pose).y(), 2);
        EXPECT_LT(fitted->moved_mm(other, pose).norm(), 0.5);
    }
}

TEST_P(FittedHead, EveryActionUnitComesToRestAndPassesThroughNothing) {
    // Settling takes its time: every unit on one of the heads
    int turn = std::string(GetParam().name) == kHeads[0].name ? 0 : 1;
    for (const track::ActionUnit& unit : fitted->files.rig.facs.units) {
        if (!unit.unsupported.empty() || turn++ % 2) continue;
        const face::FacePose pose = fitted->equilibrium_pose(fitted->drive_of(unit.id));
        EXPECT_TRUE(pose.vertices.allFinite()) << unit.id;
        EXPECT_TRUE(fitted->in_equilibrium) << unit.id;
        const face::Penetration penetration = fitted->face->diagnostics().penetration();
        EXPECT_LT(1e3 * penetration.lips_m, 0.3) << unit.id;
        EXPECT_LT(1e3 * penetration.bone_m, 0.2) << unit.id;
        EXPECT_LT(1e3 * penetration.eyeball_m, 0.2) << unit.id;
        // Nothing flies off: the jaw's 50 mm is the largest movement a face makes.
        if (!pose.head.isApprox(Rigid::Identity(), 0.0)) continue;
        EXPECT_LT((pose.vertices - fitted->rest).rowwise().norm().maxCoeff(), 0.06) << unit.id;
    }
}

// A lip that is sucked in too hard folds under itself where the mesh is fine, and circles.
TEST_P(FittedHead, ALipSuckedInComesToRestOnAFineMesh) {
    if (std::string(GetParam().name) != kHeads[0].name) return;  // settles in seconds: one head
    face::Quality quality = face::quality_named("preview");
    quality.shell_vertices = 3400;
    face::Face face(fitted->files.rig, fitted->files.mesh, quality, fitted->files.place());
    EXPECT_GT(face.diagnostics().node_count(), 10000);
    const track::Drive drive = fitted->drive_of("AU28_lower");
    track::Drive none = drive;
    none.excitation.setZero();
    face.start([&](double) { return none; });
    const face::StepStats figures =
        face.solve_equilibrium(drive.excitation, drive, {.iterations = 400});
    EXPECT_TRUE(figures.converged);
    EXPECT_LE(figures.lip_depth_m, 0.3e-3);
    EXPECT_LE(figures.bone_depth_m, 0.2e-3);
}

INSTANTIATE_TEST_SUITE_P(Heads, FittedHead, testing::ValuesIn(kHeads),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace risorius::scenario
