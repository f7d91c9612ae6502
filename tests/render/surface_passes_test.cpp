// SPDX-License-Identifier: MIT
// Ground truth of pictures against what is known of simple bodies, and against the picture that is drawn.
#include "risorius/render/surface_passes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/round_head.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

constexpr int kPictureWidth = 120, kPictureHeight = 80;

/// A camera at z = 1 m that looks along -z, 0.4 m of height at the origin.
Eigen::Matrix4d camera_ahead(bool orthographic) {
    const double near = 0.1, far = 3, half = 0.2;
    const double aspect = static_cast<double>(kPictureWidth) / kPictureHeight;
    Eigen::Matrix4d eye = Eigen::Matrix4d::Identity(), clip = Eigen::Matrix4d::Zero();
    eye(2, 3) = -1;
    clip(0, 0) = 1 / (half * aspect);
    clip(1, 1) = 1 / half;
    if (orthographic) {
        clip(2, 2) = -2 / (far - near);
        clip(2, 3) = -(far + near) / (far - near);
        clip(3, 3) = 1;
    } else {
        clip(2, 2) = -(far + near) / (far - near);
        clip(2, 3) = -2 * far * near / (far - near);
        clip(3, 2) = -1;
    }
    return clip * eye;
}

/// A square of skin, 0.2 m wide, in the plane z = 0.
Scene square_scene() {
    Scene scene;
    scene.rest.resize(4, 3);
    scene.rest << -0.1, -0.1, 0, 0.1, -0.1, 0, 0.1, 0.1, 0, -0.1, 0.1, 0;
    Surface skin;
    skin.triangles.resize(2, 3);
    skin.triangles << 0, 1, 2, 0, 2, 3;
    scene.surfaces.push_back(skin);
    return scene;
}

std::size_t pixel_at(int x, int y) { return static_cast<std::size_t>(y * kPictureWidth + x); }

void mark_hairline(std::map<std::string, Vec3>& marks) {
    marks["tr"] = RoundHead::on_skin(0, 0.06);
    marks["fht_l"] = RoundHead::on_skin(0.05, 0.04);
    marks["fht_r"] = RoundHead::on_skin(-0.05, 0.04);
}

TEST(SurfacePasses, BrowsAndTheScalpBeyondTheHairlineArePartsOfTheirOwn) {
    RoundHead head;
    auto& marks = head.scene.landmarks;
    mark_hairline(marks);
    for (const int side : {1, -1}) {
        const std::string s = side > 0 ? "_l" : "_r";
        double x = 0.012;
        for (const char* id : {"bm", "bc", "bp", "bl"})
            marks[id + s] = RoundHead::on_skin(side * (x += 0.008), 0.040);
    }
    const SurfacePasses passes(head.scene, camera_ahead(true), kPictureWidth, kPictureHeight);
    const std::vector<std::uint16_t> parts = passes.parts(passes.look(head.scene.rest));
    const auto at = [&](double x, double y) {  // 0.4 m are 80 px
        return static_cast<Part>(
            parts[pixel_at(60 + static_cast<int>(200 * x), 40 - static_cast<int>(200 * y))]);
    };
    EXPECT_EQ(at(0, 0.085), Part::kHair);
    EXPECT_EQ(at(0, 0.045), Part::kSkin);
    EXPECT_EQ(at(0.03, 0.040), Part::kBrowLeft);
    EXPECT_EQ(at(-0.03, 0.040), Part::kBrowRight);

    head.scene.appearance.scalp_hair = 0;
    const SurfacePasses shaved(head.scene, camera_ahead(true), kPictureWidth, kPictureHeight);
    const std::vector<std::uint16_t> bare = shaved.parts(shaved.look(head.scene.rest));
    EXPECT_EQ(std::count(bare.begin(), bare.end(), static_cast<std::uint16_t>(Part::kHair)), 0);
}

TEST(SurfacePasses, LocksOfHairAreHairAndHideWhatLiesBehindThem) {
    RoundHead head;
    auto& marks = head.scene.landmarks;
    mark_hairline(marks);
    marks["op"] = Vec3(0, 0.02, -0.098);
    marks["go_l"] = RoundHead::on_skin(0.06, -0.06);
    marks["bm_l"] = RoundHead::on_skin(0.02, 0.02);
    head.scene.appearance.hair_style = "bob";
    const auto passes_over = [&](SurfacePasses::Over over = SurfacePasses::Over::kLocksToo) {
        return SurfacePasses(head.scene, camera_ahead(true), kPictureWidth, kPictureHeight, over);
    };
    const auto pixel = [](double x, double y) {  // 0.4 m are 80 px
        return pixel_at(60 + static_cast<int>(200 * x), 40 - static_cast<int>(200 * y));
    };
    const SurfacePasses free = passes_over();
    const SeenSurface seen = free.look(head.scene.rest);
    const std::vector<std::uint16_t> parts = free.parts(seen);
    const auto part = [&](double x, double y) { return static_cast<Part>(parts[pixel(x, y)]); };
    // The hair hangs beside the head, where there is no skin.
    EXPECT_EQ(part(0.095, -0.045), Part::kHair);
    EXPECT_TRUE(free.shows_lock(seen, pixel(0.095, -0.045)));
    EXPECT_EQ(part(0, 0.045), Part::kSkin);
    EXPECT_FALSE(free.shows_lock(seen, pixel(0, 0.045)));
    const SurfacePasses bare = passes_over(SurfacePasses::Over::kSkinAlone);
    EXPECT_EQ(bare.parts(bare.look(head.scene.rest))[pixel(0.095, -0.045)], 0);
    // It is nearer than the skin on top of the head, faces the camera, and turns with the head.
    const auto depth = [&](const SurfacePasses& of, double x, double y) {
        return static_cast<double>(of.depth(of.look(head.scene.rest))[pixel(x, y)]);
    };
    EXPECT_LT(depth(free, 0, 0.085), depth(bare, 0, 0.085) - 0.002);
    const std::vector<float> normals = free.normals(seen);
    std::size_t locks = 0, towards = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (free.shows_lock(seen, i)) {
            ++locks;
            towards += normals[3 * i + 2] > -0.3F;
        }
    EXPECT_GT(locks, 300u);
    EXPECT_GT(static_cast<double>(towards), 0.9 * static_cast<double>(locks));
    Points moved = head.scene.rest;
    moved.col(0).array() += 0.01;  // 2 px to the right
    const std::vector<float> flow = free.flow(seen, free.look(moved));
    EXPECT_NEAR(flow[3 * pixel(0.095, -0.045)], 2, 1e-3);
    // A fringe hides the forehead.
    head.scene.appearance.fringe = 1;
    const SurfacePasses fringed = passes_over();
    EXPECT_EQ(fringed.parts(fringed.look(head.scene.rest))[pixel(0, 0.045)],
              static_cast<std::uint16_t>(Part::kHair));
}

TEST(SurfacePasses, ASquareAMetreAwayIsThatDeepAndFacesTheCamera) {
    for (const bool orthographic : {false, true}) {
        const SurfacePasses passes(square_scene(), camera_ahead(orthographic), kPictureWidth,
                                   kPictureHeight);
        const SeenSurface seen = passes.look(square_scene().rest);
        const std::vector<std::uint16_t> parts = passes.parts(seen);
        // 0.2 m of 0.4 m, that is 80 px: 40 x 40 pixels
        EXPECT_EQ(std::count(parts.begin(), parts.end(), 1), 40 * 40);
        const std::vector<float> depth = passes.depth(seen), normals = passes.normals(seen);
        EXPECT_NEAR(depth[pixel_at(60, 40)], orthographic ? 0.9 : 1.0, 1e-6);
        EXPECT_NEAR(depth[pixel_at(45, 25)], orthographic ? 0.9 : 1.0, 1e-6) << "not along the ray";
        EXPECT_TRUE(std::isinf(depth[pixel_at(5, 5)]));
        EXPECT_NEAR(normals[3 * pixel_at(60, 40) + 2], 1, 1e-6);
        EXPECT_EQ(normals[3 * pixel_at(5, 5) + 2], 0);
    }
}

TEST(SurfacePasses, FlowIsTheMotionOfTheMeshInPixels) {
    const SurfacePasses passes(square_scene(), camera_ahead(false), kPictureWidth, kPictureHeight);
    const Points rest = square_scene().rest;
    Points moved = rest;
    moved.col(0).array() += 0.01;   // 2 px to the right
    moved.col(1).array() -= 0.015;  // 3 px down
    const std::vector<float> flow = passes.flow(passes.look(rest), passes.look(moved));
    for (const auto& [x, y] : {std::pair{60, 40}, {42, 22}, {78, 58}}) {
        EXPECT_NEAR(flow[3 * pixel_at(x, y)], 2, 1e-4);
        EXPECT_NEAR(flow[3 * pixel_at(x, y) + 1], 3, 1e-4);
        EXPECT_EQ(flow[3 * pixel_at(x, y) + 2], 1);
    }
    EXPECT_EQ(flow[3 * pixel_at(5, 5)], 0);
    EXPECT_EQ(flow[3 * pixel_at(5, 5) + 2], 1) << "background that stays in sight";
    EXPECT_EQ(flow[3 * pixel_at(81, 50) + 2], 0) << "background that the square comes to cover";

    // Towards the camera: from 1 m to 0.5 m everything moves to twice its distance from the middle
    Points nearer = rest;
    nearer.col(2).array() += 0.5;
    const std::vector<float> grown = passes.flow(passes.look(rest), passes.look(nearer));
    EXPECT_NEAR(grown[3 * pixel_at(70, 40)], 10.5, 1e-3);
    EXPECT_NEAR(grown[3 * pixel_at(70, 40) + 1], 0.5, 1e-3);
}

TEST(SurfacePasses, FlowTellsWhatBecomesHidden) {
    // A second square, smaller, passes in front of the first
    Scene scene = square_scene();
    const Points back = scene.rest;
    scene.rest.conservativeResize(8, 3);
    scene.rest.bottomRows(4) = 0.4 * back;
    scene.rest.bottomRows(4).col(2).array() += 0.05;
    scene.rest.bottomRows(4).col(0).array() -= 0.2;
    Surface front;
    front.material = Material::kTongue;
    front.triangles = scene.surfaces[0].triangles.array() + 4;
    scene.surfaces.push_back(front);
    const SurfacePasses passes(scene, camera_ahead(false), kPictureWidth, kPictureHeight);
    Points moved = scene.rest;
    moved.bottomRows(4).col(0).array() += 0.2;
    const SeenSurface before = passes.look(scene.rest), after = passes.look(moved);
    const std::vector<float> flow = passes.flow(before, after);
    EXPECT_EQ(flow[3 * pixel_at(60, 40) + 2], 0) << "behind the small square";
    EXPECT_EQ(flow[3 * pixel_at(45, 25) + 2], 1) << "still seen";
    EXPECT_EQ(passes.parts(after)[pixel_at(60, 40)], static_cast<std::uint16_t>(Part::kTongue));
}

TEST(DeepPicture, IsThePictureWithMoreBits) {
    const Scene scene = RoundHead().scene;
    for (const bool transparent : {false, true}) {
        ViewOptions options;
        options.width_px = options.height_px = 64;
        options.background.transparent = transparent;
        options.supersampling = 1;  // the mean of bytes has more bits, one sample has its own
        options.deep = true;
        OffscreenView view(scene, options);
        Pose pose;
        pose.positions = scene.rest;
        const Image image = view.draw(pose);
        ASSERT_EQ(image.deep.size(), image.rgba.size());
        int between = 0;
        for (std::size_t i = 0; i < image.rgba.size(); ++i) {
            EXPECT_NEAR(image.deep[i] / 257.0, image.rgba[i], 1.0);
            between += image.deep[i] % 257 != 0;
        }
        EXPECT_GT(between, 2000) << "values that 8 bits do not have";
    }
}

TEST(SurfacePasses, CoverWhatThePictureShows) {
    const Scene scene = RoundHead().scene;
    ViewOptions options;
    options.width_px = options.height_px = 96;
    options.background.transparent = true;
    OffscreenView view(scene, options);
    Pose pose;
    pose.positions = scene.rest;
    const Image image = view.draw(pose);
    const SurfacePasses passes(scene, view.clip_from_world(), 96, 96);
    const SeenSurface seen = passes.look(scene.rest);
    const std::vector<std::uint16_t> parts = passes.parts(seen);
    int differ = 0, covered = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        covered += parts[i] != 0;
        differ += (parts[i] != 0) != (image.rgba[4 * i + 3] > 127);
    }
    EXPECT_GT(covered, 1000);
    EXPECT_LE(differ, covered / 100) << "pixels on the outline";

    // Where a pixel's place is drawn is where the pixel is
    const std::vector<float> still = passes.flow(seen, seen);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_NEAR(still[3 * i], 0, 1e-3);
        EXPECT_NEAR(still[3 * i + 1], 0, 1e-3);
    }
}

}  // namespace
}  // namespace risorius::render
