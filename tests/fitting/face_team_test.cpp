// SPDX-License-Identifier: MIT
// Faces that share the tasks of a fit: the result is that of one face, and a task that fails leaves its face to the others.
#include "risorius/face/face_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "risorius/face/calibration.h"
#include "risorius/fitting/detail/calibrate_strength.h"
#include "scene/adult_of_bundles.h"

namespace risorius::fitting {
namespace {

face::Face small_face() {
    return face::Face(scene::adult_of_bundles().rig, scene::adult_of_bundles().mesh,
                      {.name = "coarse", .shell_vertices = 300}, "adult");
}

TEST(FaceTeam, FindsTheSameStrengthsAsOneFace) {
    rig::RigDescription rig = scene::adult_of_bundles().rig;
    std::erase_if(rig.atlas.bands, [](const rig::MuscleBand& band) {
        return band.muscle != "zygomaticus_major" && band.muscle != "risorius" &&
               band.muscle != "frontalis_medial" && band.muscle != "mentalis";
    });
    face::Face alone = small_face(), first = small_face();
    face::FaceTeam one(alone), two(first, small_face, 2);
    const std::vector<MuscleStrength> wanted = calibrate_strength(one, rig, {});
    const std::vector<MuscleStrength> found = calibrate_strength(two, rig, {});
    ASSERT_EQ(wanted.size(), 4u);
    ASSERT_EQ(found.size(), 4u);
    int changed = 0;
    for (std::size_t m = 0; m < wanted.size(); ++m) {
        EXPECT_EQ(found[m].strength, wanted[m].strength) << wanted[m].muscle;
        EXPECT_EQ(found[m].stretch, wanted[m].stretch) << wanted[m].muscle;
        two.all([&](face::Face& face) {
            EXPECT_EQ(face.calibration().strength(wanted[m].muscle),
                      alone.calibration().strength(wanted[m].muscle));
        });
        changed += alone.calibration().strength(wanted[m].muscle) != 1;
    }
    EXPECT_GT(changed, 0);
}

TEST(FaceTeam, GoesOnAfterATaskThatFailed) {
    face::Face first = small_face();
    face::FaceTeam team(first, small_face, 2);
    EXPECT_THROW(team.each(1, [](int, face::Face&) { throw std::runtime_error("no"); }),
                 std::runtime_error);
    std::atomic<int> done = 0;
    team.each(6, [&](int, face::Face&) { ++done; });
    EXPECT_EQ(done, 6);
}

}  // namespace
}  // namespace risorius::fitting
