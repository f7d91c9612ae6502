// SPDX-License-Identifier: MIT
#include "risorius/scene/detail/articulation_view.h"

#include <gtest/gtest.h>

#include "risorius/scene/scene_from_rig.h"
#include "scene/adult_of_bundles.h"

namespace risorius::scene {
namespace {

TEST(ArticulationView, ShowsTheTongueAndDoesNotMoveWithTheHead) {
    const RigFiles& files = adult_of_bundles();
    const rig::Head head = rig::place_head(files.rig, files.mesh, files.place());
    const render::Scene scene = scene_from_rig(head, files.rig, files.mesh);
    const ArticulationView view(scene, head);
    Image rest(200, 200), nodded(200, 200), lower(200, 200);
    view.draw(scene.rest, rest);
    const Eigen::AngleAxisd nod(0.3, Vec3(1, 0.4, 0).normalized());
    const Points turned = ((scene.rest * nod.toRotationMatrix().transpose()).rowwise() +
                           Vec3(0, 0.02, 0.01).transpose())
                              .eval();
    view.draw(turned, nodded);
    long differ = 0, tongue = 0, skin = 0;
    const auto is_tongue = [](const Image& image, int x, int y) {
        const std::uint8_t* p = image.pixel(x, y);
        return p[0] > 180 && p[1] < 150 && p[2] < 150;
    };
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) {
            differ += std::abs(rest.pixel(x, y)[1] - nodded.pixel(x, y)[1]) > 8;
            tongue += is_tongue(rest, x, y);
            skin += rest.pixel(x, y)[0] < 90;
        }
    EXPECT_LT(differ, 20);
    EXPECT_GT(tongue, 2000);  // 5 of 100 parts
    EXPECT_GT(skin, 200);
}

}  // namespace
}  // namespace risorius::scene
