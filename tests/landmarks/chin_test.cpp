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

// The profile below the chin is flat; of what a guess is off along it, 0.64 remain.
TEST_F(Chin, AMentonThatIsOffAlongTheProfileIsDrawnBack) {
    const ShownHead head = shown_head(mesh_, "adult");
    const auto in_place = menton_near(head, pogonion_, at_.at("me"));
    ASSERT_TRUE(in_place);
    EXPECT_LT(1e3 * (*in_place - at_.at("me")).norm(), 1);
    for (const double off_mm : {-6.0, 6.0}) {
        const Vec3 guess = head.skin_tree.closest(at_.at("me") + 1e-3 * Vec3(0, 0, off_mm))->point;
        const auto found = menton_near(head, pogonion_, guess);
        ASSERT_TRUE(found);
        EXPECT_LT(1e3 * (*found - at_.at("me")).norm(), 4.8) << off_mm;
    }
}

TEST_F(Chin, AMaskWithoutAChinHasNoProfile) {
    EXPECT_FALSE(menton_near(shown_head(mesh_, "adult"), at_.at("pg") + Vec3(0, 0.4, 0),
                             at_.at("me") + Vec3(0, 0.4, 0)));
}

}  // namespace
}  // namespace risorius::landmarks
