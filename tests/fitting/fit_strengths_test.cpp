// SPDX-License-Identifier: MIT
// Muscles are scaled together until expressions move a head's landmarks as a table asks.
#include "risorius/fitting/detail/fit_strengths.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/rig/rig_description.h"
#include "scene/adult_of_bundles.h"
#include "temporary_folder.h"

namespace risorius::fitting {
namespace {

face::Face face_of(const rig::RigDescription& rig) {
    return face::Face(rig, scene::adult_of_bundles().mesh, face::quality_named("preview"), "adult");
}

TEST(FitStrengths, FindsAgainWhatAMuscleAndALipHadBeforeTheyWereSpoilt) {
    const rig::RigDescription& rig = scene::adult_of_bundles().rig;
    scene::DisplacementTable goal;
    {
        face::Face face = face_of(rig);
        scene::LandmarkDisplacements ways(face, rig, "adult");
        for (const std::string name : {"zygomaticus_major", "orbicularis_oris_upper_peripheral"}) {
            const Points moved = ways.solve_equilibrium(ways.drive(name));
            for (std::size_t i = 0; i < ways.landmarks().size(); ++i)
                goal[name][ways.landmarks()[i]] = moved.row(static_cast<long>(i)).transpose();
        }
    }
    rig::RigDescription spoilt = rig;
    constexpr double kStronger = 1.5, kFarther = 1.4;
    for (rig::MuscleBand& band : spoilt.atlas.bands)
        if (band.muscle == "zygomaticus_major") band.strength *= kStronger;
    spoilt.lips.upper_push *= kFarther;

    face::Face face = face_of(spoilt);
    face::FaceTeam team(face);
    const StrengthFit fit = fit_strengths(team, spoilt, goal, {.keep = 1e-4}, "adult", {});
    EXPECT_GT(fit.difference_before, 0.15);
    EXPECT_LT(fit.difference, 0.03);
    EXPECT_NEAR(fit.factor.at("zygomaticus_major"), 1 / kStronger, 0.04);
    EXPECT_NEAR(fit.lips.upper_push, rig.lips.upper_push, 0.06);
    EXPECT_NEAR(fit.factor.at("frontalis_medial"), 1, 1e-9) << "took no part";
    EXPECT_NEAR(fit.lips.lower_turn, rig.lips.lower_turn, 1e-9) << "took no part";
}

TEST(FitStrengths, NeedsAWayForEveryLandmarkItCompares) {
    face::Face face = face_of(scene::adult_of_bundles().rig);
    face::FaceTeam team(face);
    try {
        fit_strengths(team, scene::adult_of_bundles().rig,
                      {{"mouthSmile", {{"ch_l", Vec3::Zero()}}}}, {}, "adult", {});
        FAIL() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "ways of \"mouthSmile\": expected landmark n, found none");
    }
}

}  // namespace
}  // namespace risorius::fitting
