// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/chin.h"

#include <gtest/gtest.h>

#include "paths.h"
#include "risorius/io/read_mesh.h"
#include "risorius/rig/head.h"

namespace risorius::landmarks {
namespace {

class Chin : public ::testing::Test {
  protected:
    Chin() {
        const std::filesystem::path adult =
            std::filesystem::path(RISORIUS_SOURCE_DIR) / "models/adult";
        mesh_ = io::read_mesh(adult / "head.obj");
        mesh_.positions *= 1e-3;
        for (const auto& [id, landmark] : rig::read_landmarks(adult / "landmarks.json"))
            at_[id] = mesh_.positions.row(landmark.vertex).transpose();
        pogonion_ =
            mesh_.positions
                .row(rig::read_landmarks(adult / "landmarks_by_definition.json").at("pg").vertex)
                .transpose();
    }

    geom::PolygonMesh mesh_;
    std::map<std::string, Vec3> at_;
    Vec3 pogonion_;
};

// Along the profile, the comparison says nothing of where the menton lies, up to 7 mm.
TEST_F(Chin, AMentonThatIsOffAlongTheProfileIsDrawnBack) {
    const ShownHead head = shown_head(mesh_, "adult");
    for (const double off_mm : {0.0, -5.0, 5.0}) {
        const Vec3 guess = head.skin_tree.closest(at_.at("me") + 1e-3 * Vec3(0, 0, off_mm))->point;
        const auto found = menton_by_profile(head, {at_.at("sl"), pogonion_, guess, at_.at("hyo")});
        ASSERT_TRUE(found);
        EXPECT_LT(1e3 * (*found - at_.at("me")).norm(), 2.5) << off_mm;
    }
    // Farther off, 7 mm nearer
    const Vec3 guess = head.skin_tree.closest(at_.at("me") - Vec3(0, 0, 12e-3))->point;
    const auto found = menton_by_profile(head, {at_.at("sl"), pogonion_, guess, at_.at("hyo")});
    ASSERT_TRUE(found);
    EXPECT_NEAR(1e3 * (*found - guess).norm(), 7, 0.7);
}

TEST_F(Chin, AMaskWithoutAChinHasNoProfile) {
    const Vec3 up(0, 0.4, 0);
    EXPECT_FALSE(menton_by_profile(
        shown_head(mesh_, "adult"),
        {at_.at("sl") + up, at_.at("pg") + up, at_.at("me") + up, at_.at("hyo") + up}));
}

}  // namespace
}  // namespace risorius::landmarks
