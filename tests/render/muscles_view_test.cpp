// SPDX-License-Identifier: MIT
// The muscles under translucent skin: seen where they are, brighter the more active, never outside of the head.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "message_of.h"
#include "render/round_head.h"
#include "risorius/render/detail/activation_colour.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

const Vec3 kPlace(-0.045, -0.03, 0.0);  // of the muscle, over the cheek; its depth is the head's

ViewOptions muscles_shown() {
    ViewOptions options;
    options.width_px = options.height_px = 160;
    options.show = Show::kMuscles;
    options.background.transparent = true;
    return options;
}

/// An octahedron of flesh 24 mm wide below the skin.
struct HeadWithMuscle : RoundHead {
    HeadWithMuscle() {
        Muscles& muscles = scene.muscles;
        const double r = 0.012;
        muscles.rest.resize(6, 3);
        muscles.rest << r, 0, 0, -r, 0, 0, 0, r, 0, 0, -r, 0, 0, 0, 0.003, 0, 0, -0.003;
        muscles.fibre = muscles.rest.leftCols(2);
        muscles.tendon.assign(6, 0.0);
        Muscle muscle{"zygomaticus_major", 1, Triangles(8, 3)};
        muscle.triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
        muscles.parts.push_back(muscle);
        muscles.rest = at_depth(0.006);
        pose.muscle_positions = muscles.rest;
        pose.activations = {0.0};
    }
    Points at_depth(double depth_m) const {
        Points moved = scene.muscles.rest;
        const Vec3 skin = on_skin(kPlace.x(), kPlace.y());
        moved.rowwise() -= moved.colwise().mean();
        moved.rowwise() += (skin * (1 - depth_m / skin.norm())).transpose();
        return moved;
    }
};

/// One view serves all: making it costs more than its pictures.
class MusclesView : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        head = std::make_unique<HeadWithMuscle>();
        view = std::make_unique<OffscreenView>(head->scene, muscles_shown());
    }
    static void TearDownTestSuite() { view.reset(); }

    static Image picture(double activation, const Points& positions) {
        Pose pose = head->pose;
        pose.muscle_positions = positions;
        pose.activations = {activation};
        return view->draw(pose);
    }
    static Image picture(double activation) {
        return picture(activation, head->scene.muscles.rest);
    }

    /// CIE lightness of the mean colour over the muscle.
    static double lightness_there(const Image& image) {
        const Vec2 at = view->project(RoundHead::on_skin(kPlace.x(), kPlace.y()));
        Vec3 sum = Vec3::Zero();
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx)
                for (int k = 0; k < 3; ++k) {
                    const double s = image.pixel(static_cast<int>(at.x()) + dx,
                                                 static_cast<int>(at.y()) + dy)[k] /
                                     255.0;
                    sum[k] += s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
                }
        return 116 * std::cbrt((sum / 25).dot(Vec3(0.2126, 0.7152, 0.0722))) - 16;
    }

    static std::unique_ptr<HeadWithMuscle> head;
    static std::unique_ptr<OffscreenView> view;
};
std::unique_ptr<HeadWithMuscle> MusclesView::head;
std::unique_ptr<OffscreenView> MusclesView::view;

int differing_pixels(const Image& a, const Image& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
        count += !std::equal(a.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                             a.rgba.begin() + static_cast<std::ptrdiff_t>(i + 4),
                             b.rgba.begin() + static_cast<std::ptrdiff_t>(i));
    return count;
}

TEST(ActivationColour, LightnessGrowsEvenlyFromRestToFullActivation) {
    const auto lightness = [](double a) {
        return 116 * std::cbrt(activation_colour(a).dot(Vec3(0.2126, 0.7152, 0.0722))) - 16;
    };
    const double step = (lightness(1) - lightness(0)) / 20;
    EXPECT_GT(step, 3);
    // Where the ramp leaves the colours a screen has, it is cut off; that bends it by less than half a step.
    for (int i = 0; i < 20; ++i)
        EXPECT_NEAR(lightness((i + 1) / 20.0) - lightness(i / 20.0), step, 0.5 * step) << i;
    EXPECT_EQ(activation_colour(-0.4), activation_colour(0));
    EXPECT_EQ(activation_colour(1.2), activation_colour(1));
}

TEST_F(MusclesView, AMuscleShinesThroughTheSkinAndBrightensAsItBecomesActive) {
    const Image rest = picture(0), half = picture(0.5), full = picture(1);
    EXPECT_GT(lightness_there(half), lightness_there(rest) + 12);
    EXPECT_GT(lightness_there(full), lightness_there(half) + 12);
    // What changes is the muscle, some 19 px of a head of 160, and nothing else.
    EXPECT_GT(differing_pixels(rest, full), 60);
    EXPECT_LT(differing_pixels(rest, full), 330);
    EXPECT_GT(lightness_there(picture(0, head->at_depth(0.150))), lightness_there(rest) + 15);
}

TEST_F(MusclesView, AMuscleOnTheFarSideOfTheHeadIsNotSeen) {
    const Points far = head->at_depth(0.150);
    EXPECT_EQ(differing_pixels(picture(0, far), picture(1, far)), 0);
}

TEST_F(MusclesView, AMuscleThatComesOutOfTheSkinIsStillUnderIt) {
    // Other light falls on it there; without it, this place is 15 darker or more.
    EXPECT_NEAR(lightness_there(picture(1, head->at_depth(-0.008))), lightness_there(picture(1)),
                6);
    // Nor does it reach over the outline of the head.
    Points beside = head->scene.muscles.rest;
    beside.rowwise() += Vec3(-0.05, 0, -0.03).transpose();
    const Image moved = picture(1, beside), plain = picture(1);
    for (std::size_t i = 3; i < moved.rgba.size(); i += 4)
        ASSERT_EQ(moved.rgba[i], plain.rgba[i]) << i / 4;
}

TEST_F(MusclesView, APictureIsTheSameAgainAndDoesNotDependOnTheFramesBefore) {
    const Image before = picture(0.1, head->at_depth(0.010)), after = picture(0.7);
    Pose pose = head->pose;
    pose.activations = {0.7};
    EXPECT_EQ(OffscreenView(head->scene, muscles_shown()).draw(pose).rgba, after.rgba);
}

TEST_F(MusclesView, TheScaleOfActivationIsInTheCorner) {
    const Image image = picture(0.5);
    // The bar begins 3 % in; its ends are the ends of the ramp.
    const std::uint8_t *rest = image.pixel(6, 6), *full = image.pixel(38, 6);
    EXPECT_GT(full[0], rest[0] + 40);
    EXPECT_GT(full[1], rest[1] + 100);
    for (const std::uint8_t* end : {rest, full}) EXPECT_EQ(end[3], 255);
    EXPECT_EQ(image.pixel(120, 6)[3], 0);
}

TEST_F(MusclesView, WhatDoesNotFitIsNamed) {
    EXPECT_EQ(message_of([] { show_named("bones", "--show"); }),
              "--show: expected one of \"skin\", \"muscles\", \"skull\", \"wire\", \"strain\", "
              "\"error\", "
              "\"landmarks\", \"articulation\", found \"bones\"");
    for (std::size_t i = 0; i < show_names().size(); ++i)
        EXPECT_EQ(show_named(show_names()[i], ""), static_cast<Show>(i));
    Pose pose = head->pose;
    pose.activations.clear();
    EXPECT_EQ(message_of([&] { view->draw(pose); }),
              "pose/activations: expected 1 values, found 0");
    pose.muscle_positions.resize(0, 3);
    EXPECT_EQ(message_of([&] { view->draw(pose); }),
              "pose/muscle_positions: expected 6 rows, found 0");
    HeadWithMuscle torn;
    torn.scene.muscles.parts[0].triangles(3, 1) = 6;
    EXPECT_EQ(message_of([&] { OffscreenView(torn.scene, muscles_shown()).draw(torn.pose); }),
              "scene/muscles/parts/0/triangles: expected vertices 0..5, found 0..6");
}

}  // namespace
}  // namespace risorius::render
