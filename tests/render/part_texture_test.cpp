// SPDX-License-Identifier: MIT
// Colours of eyes and teeth on their texture coordinates.
#include <gtest/gtest.h>

#include "message_of.h"
#include "render/round_head.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

constexpr int kPartSide_px = 200;
constexpr double kPerRadius = 0.4;  ///< of the square's side, for the radius of an eye or the teeth

/// Eyes and teeth laid out as one sees them from ahead, the backs outside of the square.
RoundHead parts_laid_out() {
    RoundHead head;
    for (Surface& surface : head.scene.surfaces) {
        if (surface.material == Material::kSkin) continue;
        const Vec3 middle = surface.eye < 0
                                ? Vec3(0, -0.045, 0.06)
                                : head.scene.eyes[static_cast<std::size_t>(surface.eye)].centre;
        surface.texcoords.resize(3 * surface.triangles.rows(), 2);
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
            bool front = true;
            for (int k = 0; k < 3; ++k)
                front &= head.scene.rest(surface.triangles(f, k), 2) > middle.z();
            for (int k = 0; k < 3; ++k) {
                const Vec3 p =
                    (head.scene.rest.row(surface.triangles(f, k)).transpose() - middle) / 0.012;
                surface.texcoords.row(3 * f + k) =
                    (front ? Vec2(0.5 + kPerRadius * p.x(), 0.5 + kPerRadius * p.y()) : Vec2(2, 2))
                        .transpose();
            }
        }
    }
    return head;
}

OffscreenView small_view_of(const RoundHead& head) {
    return OffscreenView(head.scene, {.width_px = 64, .height_px = 64});
}

/// Mean in linear light between two distances from the middle, in millimetres of eye or teeth.
Vec3 ring_mean(const Image& image, double from_mm, double to_mm) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int y = 0; y < kPartSide_px; ++y)
        for (int x = 0; x < kPartSide_px; ++x) {
            const double r = 12 / kPerRadius / kPartSide_px *
                             std::hypot(x + 0.5 - kPartSide_px / 2, y + 0.5 - kPartSide_px / 2);
            if (r < from_mm || r > to_mm) continue;
            for (int k = 0; k < 3; ++k) sum[k] += std::pow(image.pixel(x, y)[k] / 255.0, 2.2);
            ++count;
        }
    return sum / count;
}

TEST(PartTexture, TheIrisHasItsToneAroundABlackPupilInAWhiteEye) {
    for (const Vec3& tone : {Vec3(0.35, 0.50, 0.60), Vec3(0.33, 0.20, 0.11)}) {
        RoundHead head = parts_laid_out();
        head.scene.appearance.iris_tone = tone;
        const OffscreenView view = small_view_of(head);
        const Image eyes = view.part_texture(head.scene, Material::kEye, kPartSide_px);
        EXPECT_LT(ring_mean(eyes, 0, 1.2).maxCoeff(), 0.02);
        const Vec3 white = ring_mean(eyes, 7.5, 10);
        EXPECT_GT(white.minCoeff(), 0.4);
        EXPECT_GT(white.x(), white.z());
        // Fibres leave two thirds of a tone that is greyed by a third; around the pupil it is warmer.
        const Vec3 linear = tone.array().pow(2.2), iris = ring_mean(eyes, 3.6, 4.4);
        const Vec3 greyed = 0.65 * linear + 0.35 * Vec3::Constant(linear.dot(Vec3(0.3, 0.5, 0.2)));
        EXPECT_LT((iris / iris.sum() - greyed / greyed.sum()).cwiseAbs().maxCoeff(), 0.04)
            << iris.transpose() << " for " << greyed.transpose();
        EXPECT_GT(iris.sum(), 0.4 * greyed.sum());
        EXPECT_LT(iris.sum(), 0.9 * greyed.sum());
        EXPECT_EQ(eyes.rgba, view.part_texture(head.scene, Material::kEye, kPartSide_px).rgba);
    }
}

TEST(PartTexture, TeethAreWarmAtTheNeckAndGreyAtTheEdge) {
    const RoundHead head = parts_laid_out();
    const OffscreenView view = small_view_of(head);
    const auto colour = [&](double height) {
        const std::vector<double> crown(static_cast<std::size_t>(head.scene.rest.rows()), height);
        return ring_mean(view.part_texture(head.scene, Material::kTeeth, kPartSide_px, crown), 0,
                         8);
    };
    const Vec3 neck = colour(0.2), middle = colour(0.7), edge = colour(1);
    EXPECT_GT(neck.x() / neck.z(), 1.2 * middle.x() / middle.z());
    EXPECT_GT(middle.x() / middle.z(), 1.1 * edge.x() / edge.z());
    EXPECT_LT(edge.sum(), 0.95 * middle.sum());
    EXPECT_GT(middle.minCoeff(), 0.4);
}

TEST(PartTexture, WhatCannotBeLaidOutIsRefused) {
    const RoundHead head = parts_laid_out();
    const OffscreenView view = small_view_of(head);
    const auto message = [&](Material part, int side_px, const std::vector<double>& crown) {
        return message_of([&] { view.part_texture(head.scene, part, side_px, crown); });
    };
    EXPECT_EQ(message(Material::kEye, 8, {}), "side_px: expected 16..8192, found 8");
    EXPECT_EQ(message(Material::kTongue, 64, {}),
              "tongue: expected texture coordinates, found none");
    EXPECT_EQ(message(Material::kSkin, 64, {}),
              "part: expected eyes, teeth, gums or tongue, found 0");
    EXPECT_EQ(message(Material::kTeeth, 64, {0, 1}), "crown_height: expected " +
                                                         std::to_string(head.scene.rest.rows()) +
                                                         " rows, or none, found 2");
}

}  // namespace
}  // namespace risorius::render
