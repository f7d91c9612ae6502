// SPDX-License-Identifier: MIT
// Volume muscles under the skin: what they keep, what they do to the face, and that the rest stays as it is.
#include "risorius/face/muscle/detail/muscle_solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "face/adult_face.h"
#include "risorius/face/anatomy/detail/jaw.h"

namespace risorius::face {
namespace {

constexpr const char* kSome = R"({
    "masseter_superficial": {"ends": [0.5, 0.5], "volume_pa": 8e6},
    "zygomaticus_major": {"strength": 0.6},
    "mentalis": {"strength": 0.15, "volume_pa": 3e6},
    "orbicularis_oris_upper_peripheral": {"strength": 0.2},
    "orbicularis_oris_lower_peripheral": {"strength": 0.2}})";

rig::RigDescription rig_with(const char* solids) {
    rig::RigDescription rig = rig::adult().rig;
    rig.solids =
        rig::read_solid_muscles(JsonCursor::from_json(Json::parse(solids), "rig"), rig.muscles);
    return rig;
}

Face small_face(const char* solids) {
    return Face(rig_with(solids), rig::adult().mesh, {"test", 400, 6}, "adult");
}

/// One face for all these tests; every pose is found from rest.
class MuscleSolidsInFace : public testing::Test {
  protected:
    static Face& face() {
        static Face one = small_face(kSome);
        return one;
    }
    static SolidFigures of(const std::string& muscle) {
        for (const SolidFigures& figures : face().diagnostics().solid_figures())
            if (figures.muscle == muscle) return figures;
        ADD_FAILURE() << "no volume muscle " << muscle;
        return {};
    }
};

TEST_F(MuscleSolidsInFace, WithoutActivationNothingMoves) {
    const FacePose pose = equilibrium_pose(face(), neutral());
    EXPECT_LT((pose.vertices - face().head().vertices).rowwise().norm().maxCoeff(), 1e-6);
    for (const SolidFigures& figures : face().diagnostics().solid_figures())
        EXPECT_NEAR(figures.volume_ratio, 1.0, 1e-9) << figures.muscle;
}

TEST_F(MuscleSolidsInFace, NoTissueAroundAMuscleIsSofterThanTheMuscle) {
    const std::vector<BesideSolid> all = face().diagnostics().beside_solids();
    EXPECT_EQ(all.size(), 8u);
    for (const BesideSolid& one : all) {
        EXPECT_GT(one.nodes, 0) << one.muscle;
        EXPECT_GE(one.softest_pa, one.muscle_pa) << one.muscle;
        EXPECT_LT(one.ratio(), 1.6) << one.muscle;
    }
}

TEST_F(MuscleSolidsInFace, AFullContractionKeepsTheVolumeOfEveryMuscle) {
    for (const char* muscle : {"masseter_superficial", "zygomaticus_major", "mentalis",
                               "orbicularis_oris_upper_peripheral"}) {
        StepStats figures;
        equilibrium_pose(face(), with_muscle(muscle, 1.0), &figures);
        EXPECT_LT(figures.last_step_rms_m, 1e-4) << muscle;
        EXPECT_LT(figures.muscle_volume_error, 0.01) << muscle;
        const SolidFigures now = of(muscle);
        EXPECT_LT(now.mean_stretch, 0.98) << muscle << " does not shorten";
        // The ring round the mouth becomes wider rather than thicker
        if (std::string(muscle) != "orbicularis_oris_upper_peripheral") {
            EXPECT_GT(now.thickness_ratio, 1.0) << muscle << " does not bulge";
        }
        EXPECT_GT(now.min_cell_ratio, 0.9) << muscle;
    }
}

TEST_F(MuscleSolidsInFace, BitingBulgesTheSkinOverTheMasseter) {
    const FacePose pose = equilibrium_pose(face(), with_muscle("masseter_superficial", 1.0));
    const Points u = moved_mm(face(), pose);
    double max = 0;
    for (long v = 0; v < u.rows(); ++v) {
        const Vec3 p = face().head().vertices.row(v).transpose();
        if (face().head().carrier[v] == rig::Carrier::kSkin && p.x() > 0.05 && p.z() < 0.06)
            max = std::max(max, u(v, 0));  // outwards on the left
    }
    EXPECT_GT(max, 0.3);
    EXPECT_LT(max, 5);
}

TEST_F(MuscleSolidsInFace, ASmileDrawsTheCornerUpAndOutwards) {
    const Points u =
        moved_mm(face(), equilibrium_pose(face(), with_muscle("zygomaticus_major", 1.0)));
    EXPECT_GT(at(u, "ch_l").y(), 3);
    EXPECT_GT(at(u, "ch_l").x(), 2);
}

TEST_F(MuscleSolidsInFace, AnOpenJawStretchesTheMasseterAndKeepsItsVolume) {
    equilibrium_pose(face(), with_kinematic(track::Kinematic::kJawOpen, 0.4));
    EXPECT_GT(of("masseter_superficial").mean_stretch, 1.1);
    EXPECT_NEAR(of("masseter_superficial").volume_ratio, 1.0, 0.01);
}

TEST_F(MuscleSolidsInFace, TheSameDrivesGiveTheSameBits) {
    const auto run = [&] {
        face().start(always(neutral()));
        for (int i = 0; i < 6; ++i) face().step(always(with_unit("AU12")));
        return face().pose().vertices;
    };
    const Points once = run();
    EXPECT_EQ(once, run());
}

TEST(MuscleSolids, TheRigChoosesMuscleByMuscle) {
    const Face bundles = small_face("{}"), one = small_face(R"({"zygomaticus_major": {}})");
    EXPECT_TRUE(bundles.diagnostics().solid_figures().empty());
    ASSERT_EQ(one.diagnostics().solid_figures().size(), 2u);
    EXPECT_EQ(one.diagnostics().solid_figures()[1].side, Side::kRight);
    EXPECT_LT(one.diagnostics().fibre_count(), bundles.diagnostics().fibre_count())
        << "the bundle it replaces is gone";
}

/// The solids alone, with the mandible somewhere and everything a little out of place.
struct Displaced {
    rig::RigDescription rig = rig_with(kSome);
    const rig::Head& head = rig::adult_placed();
    std::array<EyeLids, 2> lids{EyeLids(head, 0, 0.96), EyeLids(head, 1, 0.96)};
    Jaw jaw{head, rig.jaw};
    Shell shell = build_shell(head, jaw, lids, {300});
    TissueMesh mesh = build_tissue_mesh(head, rig, shell, lids);
    std::vector<Attachment> attachments = place_attachments(head, rig, jaw, shell, mesh);
    MuscleSolids solids{head, rig, jaw, shell, mesh, attachments};
    long tissue = mesh.nodes.rows();
    Rigid opened = jaw.motion(0.3, 0, 0.1);
    Points x;
    Eigen::VectorXd activation = Eigen::VectorXd::Constant(rig.channels().column_count(), 0.7);

    Displaced() {
        x.resize(tissue + solids.nodes(), 3);
        x << mesh.nodes, solids.rest();
        solids.carry(x, Rigid::Identity(), opened);
        solids.set_bodies({Rigid::Identity(), opened});
        solids.begin_step(1.0 / 60, x, activation);
        for (long i = 0; i < x.rows(); ++i)
            x.row(i) +=
                2e-4 * Vec3(std::sin(3.0 * i), std::sin(5.0 * i), std::cos(7.0 * i)).transpose();
    }
};

TEST(MuscleSolids, GradientAndWrenchesAreTheSlopesOfTheEnergy) {
    Displaced d;
    Points gradient = Points::Zero(d.x.rows(), 3), scratch = gradient;
    Wrenches on{};
    d.solids.add_energy(d.x, d.activation, gradient, &on);
    const double h = 1e-7;
    for (int trial = 0; trial < 4; ++trial) {
        Points along(d.x.rows(), 3);
        for (long i = 0; i < along.rows(); ++i)
            for (int k = 0; k < 3; ++k) along(i, k) = std::sin(1.0 + 12.9898 * (3 * i + k) + trial);
        for (int i = 0; i < d.solids.nodes(); ++i)
            if (d.solids.on_bone(i)) along.row(d.tissue + i).setZero();
        const double slope = (d.solids.add_energy(d.x + h * along, d.activation, scratch) -
                              d.solids.add_energy(d.x - h * along, d.activation, scratch)) /
                             (2 * h);
        const double expected = gradient.cwiseProduct(along).sum();
        EXPECT_NEAR(slope, expected, 1e-4 * (1 + std::abs(expected)));
    }
    // Moving the mandible against its wrench costs what the wrench says
    const auto energy_with = [&](const Rigid& more) {
        d.solids.set_bodies({Rigid::Identity(), more * d.opened});
        return d.solids.add_energy(d.x, d.activation, scratch);
    };
    for (int axis = 0; axis < 3; ++axis) {
        Rigid there = Rigid::Identity(), back = Rigid::Identity();
        there.translation()[axis] = h;
        back.translation()[axis] = -h;
        EXPECT_NEAR(-(energy_with(there) - energy_with(back)) / (2 * h),
                    on[kMandibleBody].force_n[axis], 0.05);
    }
    EXPECT_GT(on[kMandibleBody].force_n.y(), 50) << "an active masseter pulls the jaw up";
}

TEST(MuscleSolids, ForcesOnBonesAndTissueAddUpToNothing) {
    Displaced d;
    Points gradient = Points::Zero(d.x.rows(), 3);
    Wrenches on{};
    d.solids.add_energy(d.x, d.activation, gradient, &on);
    const Vec3 left = on[0].force_n + on[1].force_n - gradient.colwise().sum().transpose();
    EXPECT_LT(left.norm(), 1e-6 * on[1].force_n.norm());
}

TEST(MuscleSolids, AMuscleThatFoldsOnThisHeadIsNamed) {
    try {
        small_face(R"({"mentalis": {"width_mm": 100, "thickness_mm": 50, "cells": [9, 3, 3]}})");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(
            std::string(error.what()),
            "anatomy/solids/mentalis: expected a muscle whose cells have volume on this head, "
            "found a folded cell");
    }
}

}  // namespace
}  // namespace risorius::face
