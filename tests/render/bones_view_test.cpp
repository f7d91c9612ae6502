// SPDX-License-Identifier: MIT
// Bone under skin of glass: seen through it wherever it is, and moved by the pose alone.
#include <gtest/gtest.h>

#include "message_of.h"
#include "render/round_head.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

/// An octahedron of bone 60 mm wide in the middle of a round head.
struct HeadWithBone : RoundHead {
    HeadWithBone() {
        Bones& bones = scene.bones;
        const double r = 0.03;
        bones.rest.resize(6, 3);
        bones.rest << r, 0, 0, -r, 0, 0, 0, r, 0, 0, -r, 0, 0, 0, r, 0, 0, -r;
        bones.triangles.resize(8, 3);
        bones.triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
        bones.open.assign(6, 1.0);
        pose.bone_positions = bones.rest;
    }
};

ViewOptions skull_shown() {
    ViewOptions options;
    options.width_px = options.height_px = 128;
    options.show = Show::kSkull;
    options.background.rgb = {0.1, 0.1, 0.1};
    return options;
}

int sum_of_colours(const Image& image, const Vec2& at) {
    const auto* p = image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()));
    return p[0] + p[1] + p[2];
}

TEST(BonesView, BoneIsSeenThroughTheSkinWhereThePoseHasIt) {
    HeadWithBone head;
    OffscreenView view(head.scene, skull_shown());
    const Vec2 middle = view.project(Vec3(0.004, 0.004, 0)), beside = view.project({0.05, 0, 0});
    const Image there = view.draw(head.pose);
    EXPECT_GT(sum_of_colours(there, middle), sum_of_colours(there, beside) + 150);
    EXPECT_EQ(there.rgba, view.draw(head.pose).rgba);
    head.pose.bone_positions.col(0).array() += 0.05;
    const Image moved = view.draw(head.pose);
    EXPECT_GT(sum_of_colours(moved, beside), sum_of_colours(moved, middle) + 150);
}

TEST(BonesView, BonesThatDoNotFitAreRefused) {
    HeadWithBone head;
    {
        OffscreenView view(head.scene, skull_shown());
        Pose pose = head.pose;
        pose.bone_positions.conservativeResize(5, 3);
        EXPECT_EQ(message_of([&] { view.draw(pose); }),
                  "pose/bone_positions: expected 6 rows, found 5");
    }
    Scene scene = head.scene;
    scene.bones.triangles(0, 0) = 6;
    EXPECT_EQ(message_of([&] { OffscreenView(scene, skull_shown()); }),
              "scene/bones/triangles: expected vertices 0..5, found 0..6");
    scene.bones = {};
    EXPECT_EQ(message_of([&] { OffscreenView(scene, skull_shown()); }),
              "scene/bones: expected a skull, found none");
}

}  // namespace
}  // namespace risorius::render
