// SPDX-License-Identifier: MIT
// What `risorius info` says about the muscles of a rig, against the face that is simulated.
#include "tools/risorius/rig_info.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "face/adult_face.h"
#include "temporary_folder.h"

namespace risorius::cli {
namespace {

const face::Quality kCoarse{.name = "coarse", .shell_vertices = 300};

/// How many muscles are simulated as each model, by `risorius info`.
using Models = std::map<std::string, int>;

/// Compares the forces that info prints for a rig with those of the face that is built from it; muscles move its jaw.
Models expect_simulated_forces(const rig::RigDescription& rig, const std::filesystem::path& file,
                               double size) {
    const Json info = rig_info(file);
    EXPECT_NEAR(info["size"].get<double>(), size, 1e-6);
    face::Face face(rig, rig::adult().mesh, kCoarse, "adult");
    face.drive_jaw_by(track::JawDrive::kMuscles);
    Models models;
    for (const Json& muscle : info["muscles"]) {
        const std::string id = muscle["id"];
        ++models[muscle["simulated_as"]];
        for (const Side side : {Side::kLeft, Side::kRight}) {
            const auto simulated_n = face.diagnostics().greatest_force_n(id, side);
            EXPECT_EQ(simulated_n.has_value(), muscle.contains("greatest_force_n")) << id;
            if (!simulated_n || !muscle.contains("greatest_force_n")) continue;
            const double said_n = muscle["greatest_force_n"];
            EXPECT_NEAR(said_n / *simulated_n, 1, 1e-9) << id << ", " << *simulated_n << " N";
            // The factors that are printed beside it give it
            EXPECT_NEAR(muscle["table_n"].get<double>() * muscle["strength"].get<double>() *
                            muscle["factor"].get<double>() * size * size / said_n,
                        1, 1e-9)
                << id;
        }
    }
    return models;
}

TEST(RigInfo, PrintsTheForcesThatAreSimulated) {
    const Models models =
        expect_simulated_forces(rig::adult().rig, rig::adult_rig_file(), rig::adult_placed().size);
    EXPECT_GT(models.at("solid"), 5);
    EXPECT_GT(models.at("bundles"), 15);
    EXPECT_GT(models.at("line"), 5);
    EXPECT_EQ(models.at("none"), 2) << "levator palpebrae and the tarsal muscle move the lid only";
}

TEST(RigInfo, NamesEveryChannelThatAScriptMayUse) {
    const Json info = rig_info(rig::adult_rig_file());
    EXPECT_EQ(info["arkit"].size(), 52U);  // as ARKit's ARFaceAnchor.BlendShapeLocation has
    EXPECT_EQ(info["arkit"][0], rig::adult().rig.facs.arkit[0].name);
    EXPECT_EQ(info["action_units"][0]["id"], "AU1");
}

TEST(RigInfo, PrintsTheForcesOfBundlesOnALargerHead) {
    rig::RigDescription rig = rig::adult().rig;
    rig.solids.clear();
    rig.metres_per_unit *= 1.1;
    rig.tissue.force_scale = 1.25;
    for (rig::MuscleBand& band : rig.atlas.bands)
        if (band.muscle == "risorius") band.strength = 0.7;
    TemporaryFolder folder;
    rig::write_rig(rig, folder / "rig.json",
                   {.standard_folder = rig::source_folder() / "rigs" / "standard"});
    const Models models = expect_simulated_forces(
        rig::read_rig(folder / "rig.json"), folder / "rig.json", 1.1 * rig::adult_placed().size);
    EXPECT_EQ(models.count("solid"), 0u);
    EXPECT_EQ(models.at("bundles"), 28);
    EXPECT_EQ(models.at("line"), 14);
}

}  // namespace
}  // namespace risorius::cli
