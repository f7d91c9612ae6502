// SPDX-License-Identifier: MIT
// The skin's colours on texture coordinates, and where the hair of the scalp begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "message_of.h"
#include "render/round_head.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

constexpr int kSide_px = 128;

/// The front of the head laid out as one sees it, the back outside of the square.
RoundHead laid_out() {
    RoundHead head;
    for (Surface& surface : head.scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        surface.texcoords.resize(3 * surface.triangles.rows(), 2);
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
            std::array<Vec3, 3> corner;
            for (int k = 0; k < 3; ++k)
                corner[static_cast<std::size_t>(k)] =
                    head.scene.rest.row(surface.triangles(f, k)).transpose();
            const bool front = std::all_of(corner.begin(), corner.end(),
                                           [](const Vec3& p) { return p.z() > 0.02; });
            for (int k = 0; k < 3; ++k) {
                const Vec3& p = corner[static_cast<std::size_t>(k)];
                surface.texcoords.row(3 * f + k) =
                    (front ? Vec2(0.5 + 4 * p.x(), 0.5 + 4 * p.y()) : Vec2(2, 2)).transpose();
            }
        }
    }
    return head;
}

TEST(SkinTexture, ShowsSkinAndLipsWhereTheyAreLaidOut) {
    const RoundHead head = laid_out();
    const OffscreenView view(head.scene, {.width_px = 128, .height_px = 128});
    const Image texture = view.skin_texture(head.scene, kSide_px);
    ASSERT_EQ(texture.width_px, kSide_px);
    const auto colour = [&](double x_m, double y_m) -> Vec3 {
        const auto* p = texture.pixel(static_cast<int>((0.5 + 4 * x_m) * kSide_px),
                                      static_cast<int>((0.5 - 4 * y_m) * kSide_px));
        return Vec3(p[0], p[1], p[2]) / 255;
    };
    const Vec3 forehead = colour(0.02, 0.05), lip = colour(0.002, -0.052);
    EXPECT_LT((forehead - head.scene.appearance.skin_tone).cwiseAbs().maxCoeff(), 0.15);
    EXPECT_GT(lip.x() / lip.y(), forehead.x() / forehead.y() + 0.1) << "the red of the lips";
    EXPECT_EQ(texture.rgba, view.skin_texture(head.scene, kSide_px).rgba);
}

/// Mottling changes the colour of the skin by some percent from place to place, and its mean hardly. Without it all stays as it was.
TEST(SkinTexture, IsUnevenWhereItIsMottled) {
    RoundHead head = laid_out();
    const auto painted = [&](double mottling) {
        head.scene.appearance.mottling = mottling;
        return OffscreenView(head.scene, {.width_px = 64, .height_px = 64})
            .skin_texture(head.scene, kSide_px);
    };
    const Image plain = painted(0), mottled = painted(1);
    EXPECT_EQ(plain.rgba, painted(0).rgba);
    double sum = 0, squares = 0;
    int count = 0;
    for (int y = 20; y < 50; ++y)
        for (int x = 50; x < 80; ++x) {
            const double ratio = mottled.pixel(x, y)[1] / (1.0 + plain.pixel(x, y)[1]);
            sum += ratio;
            squares += ratio * ratio;
            ++count;
        }
    const double mean = sum / count;
    EXPECT_NEAR(mean, 1, 0.05);
    EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.03, 0.02);
}

TEST(SkinTexture, NeedsTextureCoordinates) {
    const RoundHead head;
    const OffscreenView view(head.scene, {.width_px = 64, .height_px = 64});
    EXPECT_EQ(message_of([&] { view.skin_texture(head.scene, kSide_px); }),
              "skin: expected texture coordinates, found none");
}

TEST(SkinTexture, HairBeginsHigherWhereItHasReceded) {
    RoundHead head;
    head.scene.landmarks["tr"] = RoundHead::on_skin(0, 0.07);
    head.scene.landmarks["fht_l"] = Vec3(0.08, 0.05, 0.033);
    head.scene.landmarks["fht_r"] = Vec3(-0.08, 0.05, 0.033);
    const auto line = [&](double hairline_mm, double temples_mm, const Vec2& place) {
        head.scene.appearance.hairline_mm = hairline_mm;
        head.scene.appearance.temples_mm = temples_mm;
        return hairline_radius(plan_skin(head.scene, Vec3::Zero()), place);
    };
    const Vec2 front(0.5, 0.7), bay(0.60, 0.68), nape(0.5, 0.1);
    EXPECT_GT(line(15, 0, front), line(0, 0, front) + 0.01);
    EXPECT_GT(line(0, 15, bay), line(0, 0, bay) + 0.01);
    EXPECT_NEAR(line(0, 15, front), line(0, 0, front), 0.01);
    EXPECT_NEAR(line(15, 15, nape), line(0, 0, nape), 1e-9);
}

}  // namespace
}  // namespace risorius::render
