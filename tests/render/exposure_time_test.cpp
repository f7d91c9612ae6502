// SPDX-License-Identifier: MIT
// Pictures over a time (motion blur) and through a lens of some width (depth of field).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "risorius/render/offscreen_view.h"
#include "round_head.h"

namespace risorius::render {
namespace {

ViewOptions front_128() {
    ViewOptions options;
    options.width_px = options.height_px = 128;
    return options;
}

Pose moved(const RoundHead& head, const Vec3& by) {
    Pose pose = head.pose;
    pose.positions.rowwise() += by.transpose();
    return pose;
}

TEST(ExposureTime, AHeadThatKeepsStillLooksTheSameToTheByte) {
    RoundHead head;
    ViewOptions options = front_128();
    options.background.transparent = true;
    options.deep = true;
    OffscreenView view(head.scene, options);
    const Image once = view.draw(head.pose), nine = view.draw(std::vector<Pose>(9, head.pose));
    EXPECT_EQ(nine.rgba, once.rgba);
    EXPECT_EQ(nine.deep, once.deep);
}

TEST(ExposureTime, AHeadThatMovesIsTheMeanInLinearLightOfItsMoments) {
    RoundHead head;
    OffscreenView view(head.scene, front_128());
    const std::vector<Pose> poses{moved(head, {-0.01, 0, 0}), head.pose,
                                  moved(head, {0.01, 0.003, 0})};
    const Image blurred = view.draw(poses);
    std::vector<Image> sharp;
    for (const Pose& pose : poses) sharp.push_back(view.draw(pose));
    const auto linear = [](std::uint8_t byte) {  // IEC 61966-2-1
        const double s = byte / 255.0;
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    int differing = 0;
    for (std::size_t i = 0; i < blurred.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const double mean =
            (linear(sharp[0].rgba[i]) + linear(sharp[1].rgba[i]) + linear(sharp[2].rgba[i])) / 3;
        const double srgb =
            mean <= 0.0031308 ? 12.92 * mean : 1.055 * std::pow(mean, 1 / 2.4) - 0.055;
        ASSERT_NEAR(blurred.rgba[i], 255 * srgb, 0.51) << "byte " << i;  // nearest
        differing += blurred.rgba[i] != sharp[1].rgba[i];
    }
    EXPECT_GT(differing, 1000);
}

/// Greatest difference of brightness between neighbours in a row about a place.
double sharpness(const Image& image, const Vec2& at, int reach) {
    double max = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -reach; dx < reach; ++dx) {
            const std::uint8_t* p =
                image.pixel(static_cast<int>(at.x()) + dx, static_cast<int>(at.y()) + dy);
            max = std::max(max, std::abs(static_cast<double>(p[1]) - p[5]));
        }
    return max;
}

TEST(DepthOfField, TheEyesStaySharpAndTheRimOfTheHeadBlurs) {
    RoundHead head;
    ViewOptions options = front_128();
    options.background.rgb = {0, 0, 0};
    for (const int side : {0, 1}) {
        const Vec3 front =
            head.scene.eyes[static_cast<std::size_t>(side)].centre + Vec3(0, 0, 0.012);
        const std::string s = side == 0 ? "_l" : "_r";
        head.scene.landmarks["en" + s] = front - Vec3(side == 0 ? 0.002 : -0.002, 0, 0);
        head.scene.landmarks["ex" + s] = front + Vec3(side == 0 ? 0.002 : -0.002, 0, 0);
    }
    OffscreenView pinhole(head.scene, options);
    options.lens.aperture_mm = 60;
    OffscreenView wide(head.scene, options);
    const Image sharp = pinhole.draw(head.pose), soft = wide.draw(head.pose);
    // The rim lies a head's radius behind the eyes.
    const Vec2 rim = pinhole.project({kHeadRadius_m, 0, 0});
    const Vec2 eye = pinhole.project(head.scene.eyes[0].centre + Vec3(0, 0, 0.012));
    EXPECT_GT(sharpness(sharp, rim, 6), 1.5 * sharpness(soft, rim, 6));
    EXPECT_GT(sharpness(soft, eye, 6), 0.85 * sharpness(sharp, eye, 6));
}

}  // namespace
}  // namespace risorius::render
