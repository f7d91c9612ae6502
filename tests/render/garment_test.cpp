// SPDX-License-Identifier: MIT
// The shirt: where it begins, that it covers the skin below without gaps, and that it moves with the skin.
#include "risorius/render/detail/garment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "message_of.h"
#include "render/round_head.h"
#include "render/small_pictures.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/render/surface_passes.h"

namespace risorius::render {
namespace {

constexpr double kNeck_m = 0.055, kTop_m = 0.03, kShoulder_m = -0.03, kBottom_m = -0.09;
constexpr int kAround = 60;

/// A neck that is round and 55 mm wide, and shoulders that widen by 1.5 mm a millimetre below y = -30 mm.
Scene neck_and_shoulders() {
    constexpr int kRows = 40;
    Scene scene;
    scene.rest.resize(kRows * kAround, 3);
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kAround; ++j) {
            const double y = kTop_m + (kBottom_m - kTop_m) * i / (kRows - 1),
                         r = kNeck_m + 1.5 * std::max(0.0, kShoulder_m - y),
                         turn = 2 * std::numbers::pi * j / kAround;
            scene.rest.row(i * kAround + j) << r * std::sin(turn), y, r * std::cos(turn);
        }
    Surface skin;
    skin.material = Material::kSkin;
    skin.triangles.resize(2 * (kRows - 1) * kAround, 3);
    int f = 0;
    for (int i = 0; i + 1 < kRows; ++i)
        for (int j = 0; j < kAround; ++j) {
            const int a = i * kAround + j, b = i * kAround + (j + 1) % kAround, c = a + kAround,
                      d = b + kAround;
            skin.triangles.row(f++) << a, c, b;
            skin.triangles.row(f++) << b, c, d;
        }
    scene.surfaces.push_back(skin);
    scene.landmarks["gn"] = Vec3(0, 0.035, kNeck_m);
    return scene;
}

Scene in_shirt(const std::string& garment) {
    Scene scene = neck_and_shoulders();
    scene.appearance.garment = garment;
    return scene;
}

Vec3 on_shoulder(double turn, double y) {
    const double r = kNeck_m + 1.5 * std::max(0.0, kShoulder_m - y);
    return {r * std::sin(turn), y, r * std::cos(turn)};
}

/// 12 mm wider than the neck is 8 mm below where the shoulder begins; in front the border is 4 mm lower, behind as much higher.
TEST(Garment, BeginsWhereNeckTurnsIntoShoulder) {
    const auto line = Neckline::of(in_shirt("crew_neck"), "crew_neck");
    ASSERT_TRUE(line);
    for (const auto& [turn, expected] :
         {std::pair{0.0, -0.042}, {1.5708, -0.038}, {3.1416, -0.034}})
        EXPECT_NEAR(line->below_m(on_shoulder(turn, expected)), 0, 0.0025) << turn;
    EXPECT_NEAR(line->below_m(Vec3(0.1, -0.06, 0)) - line->below_m(Vec3(0.1, -0.05, 0)), 0.01,
                1e-9);
}

TEST(Garment, TheVIsDeeperInFrontAndTheSameBehind) {
    const auto round = Neckline::of(in_shirt("crew_neck"), "crew_neck"),
               v = Neckline::of(in_shirt("v_neck"), "v_neck");
    ASSERT_TRUE(round && v);
    const auto deeper = [&](double turn) {
        const Vec3 p = on_shoulder(turn, -0.06);
        return round->below_m(p) - v->below_m(p);
    };
    EXPECT_NEAR(deeper(0), 0.030, 0.003);
    EXPECT_NEAR(deeper(0.5), 0.015, 0.003);
    EXPECT_NEAR(deeper(1.2), 0, 1e-9);
    EXPECT_NEAR(deeper(3), 0, 1e-9);
}

TEST(Garment, LiesSomeMillimetresOffTheSkinAndLeavesNoGap) {
    const Scene scene = in_shirt("crew_neck");
    const Garment garment = plan_garment(scene);
    ASSERT_FALSE(garment.empty());
    const PosedGarment posed = pose_garment(garment, scene.rest);
    for (Eigen::Index i = 0; i < posed.positions.rows(); ++i) {
        EXPECT_GE(garment.vertices[static_cast<std::size_t>(i)].below_m, 0);
        const double y = posed.positions(i, 1),
                     r = std::hypot(posed.positions(i, 0), posed.positions(i, 2)),
                     off =
                         (r - kNeck_m - 1.5 * std::max(0.0, kShoulder_m - y)) / std::hypot(1, 1.5);
        EXPECT_GT(off, 0.0004) << i;  // the skin is made of flat triangles
        EXPECT_LT(off, 0.0034) << i;
    }
    // As large as the cone below the border: pi (r1^2 - r0^2) / sin, by the mean border of -38 mm, in parts around the neck
    Garment flat = garment;
    for (GarmentVertex& v : flat.vertices) v.off_m = 0;
    const PosedGarment on_skin = pose_garment(flat, scene.rest);
    double area = 0;
    for (std::size_t t = 0; t < flat.triangles.size(); t += 3) {
        const auto at = [&](std::size_t k) -> Vec3 {
            return on_skin.positions.row(static_cast<Eigen::Index>(flat.triangles[t + k]))
                .transpose();
        };
        area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
    }
    const auto line = Neckline::of(scene, "crew_neck");
    double expected = 0;
    constexpr int kParts = 720;
    for (int k = 0; k < kParts; ++k) {
        const double turn = 2 * std::numbers::pi * (k + 0.5) / kParts,
                     border = -0.05 + line->below_m(on_shoulder(turn, -0.05)),
                     r0 = kNeck_m + 1.5 * (kShoulder_m - border),
                     r1 = kNeck_m + 1.5 * (kShoulder_m - kBottom_m);
        expected += std::numbers::pi / kParts * (r1 * r1 - r0 * r0) * std::hypot(1, 1.5) / 1.5;
    }
    EXPECT_NEAR(area / expected, 1, 0.01);
}

TEST(Garment, HidesOnlySkinWellBelowItsBorder) {
    const Scene scene = in_shirt("v_neck");
    const Garment garment = plan_garment(scene);
    const auto line = Neckline::of(scene, "v_neck");
    EXPECT_GT(std::count(garment.covered.begin(), garment.covered.end(), 1), 400);
    for (Eigen::Index v = 0; v < scene.rest.rows(); ++v)
        if (garment.covered[static_cast<std::size_t>(v)]) {
            EXPECT_GT(line->below_m(scene.rest.row(v).transpose()), 0.012);
        }
}

TEST(Garment, MovesWithTheSkin) {
    const Scene scene = in_shirt("crew_neck");
    const Garment garment = plan_garment(scene);
    const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(0.2, 0.9, -0.1).normalized()).toRotationMatrix();
    const Points turned = scene.rest * turn.transpose();
    EXPECT_LT((pose_garment(garment, turned).positions -
               pose_garment(garment, scene.rest).positions * turn.transpose())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-12);
}

TEST(Garment, IsNoneWhereNobodyAsksOrThereAreNoShoulders) {
    EXPECT_TRUE(plan_garment(in_shirt("none")).empty());
    RoundHead head;
    head.scene.appearance.garment = "crew_neck";
    EXPECT_TRUE(plan_garment(head.scene).empty()) << "no landmark of the chin";
    head.scene.landmarks["gn"] = RoundHead::on_skin(0, -0.07);
    EXPECT_TRUE(plan_garment(head.scene).empty()) << "no shoulders";
    EXPECT_EQ(message_of([] { plan_garment(in_shirt("shirt")); }),
              "garment: expected one of \"none\", \"crew_neck\", \"v_neck\", found \"shirt\"");
}

TEST(Garment, IsSeenInItsToneAndTheGroundTruthKnowsIt) {
    RoundHead head;
    const Scene bust = neck_and_shoulders();
    // The round head above, the shoulders below it
    const auto first = static_cast<int>(head.scene.rest.rows());
    head.scene.rest.conservativeResize(first + bust.rest.rows(), 3);
    head.scene.rest.bottomRows(bust.rest.rows()) =
        bust.rest.rowwise() + Eigen::RowVector3d(0, -0.085, 0);
    Surface skin = bust.surfaces.front();
    skin.triangles.array() += first;
    head.scene.surfaces.push_back(skin);
    head.scene.landmarks["gn"] = RoundHead::on_skin(0, -0.05);
    head.pose.positions = head.scene.rest;
    const ViewOptions options{.width_px = 160, .height_px = 160, .camera = "front"};
    const auto drawn = [&](const std::string& garment, const Vec3& tone) {
        head.scene.appearance.garment = garment;
        head.scene.appearance.garment_tone = tone;
        return OffscreenView(head.scene, options).draw(head.pose);
    };
    const Image bare = drawn("none", Vec3::Zero());
    EXPECT_EQ(drawn("none", Vec3::Ones()).rgba, bare.rgba);
    const Image black = drawn("crew_neck", Vec3(0.1, 0.1, 0.1)),
                red = drawn("crew_neck", Vec3(0.7, 0.1, 0.1));
    OffscreenView view(head.scene, options);
    const Vec3 face(0, 0, 0.1);
    const SurfacePasses passes(head.scene, view.clip_from_world(), 160, 160);
    const auto parts = passes.parts(passes.look(head.pose.positions));
    const auto is_cloth = [&](int x, int y) {
        return part_names()[parts[static_cast<std::size_t>(160 * y + x)]] == "garment";
    };
    Vec2 there(0, 0);
    for (int y = 2; y < 158; ++y)
        for (int x = 2; x < 158; ++x)
            if (is_cloth(x - 2, y) && is_cloth(x + 2, y) && is_cloth(x, y - 2) &&
                is_cloth(x, y + 2))
                there = {x, y};
    ASSERT_GT(there.y(), 100);
    EXPECT_FALSE(is_cloth(static_cast<int>(view.project(face).x()),
                          static_cast<int>(view.project(face).y())));
    EXPECT_LT(brightness_of(mean_colour(black, there, 1)),
              0.4 * brightness_of(mean_colour(bare, there, 1)));
    const auto shade = mean_colour(red, there, 1);
    EXPECT_GT(shade[0], 2 * shade[1]);
    EXPECT_EQ(mean_colour(black, view.project(face), 1), mean_colour(bare, view.project(face), 1));
}

}  // namespace
}  // namespace risorius::render
