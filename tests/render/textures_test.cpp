// SPDX-License-Identifier: MIT
// The mesh's own pictures on skin and eyes.
#include <gtest/gtest.h>

#include <memory>

#include "risorius/core/error.h"
#include "risorius/render/offscreen_view.h"
#include "round_head.h"

namespace risorius::render {
namespace {

ViewOptions front_96() {
    ViewOptions options;
    options.width_px = options.height_px = 96;
    return options;
}

/// Texture coordinates of a surface straight from the front, x and y of [-0.1, 0.1] m to [0, 1].
void project_from_front(Scene& scene, Surface& surface) {
    surface.texture = 0;
    surface.texcoords.resize(3 * surface.triangles.rows(), 2);
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
        for (Eigen::Index k = 0; k < 3; ++k)
            surface.texcoords.row(3 * f + k) =
                (scene.rest.row(surface.triangles(f, k)).head<2>().array() + 0.1) / 0.2;
}

template <typename Colour>
Image picture(int side, Colour colour) {
    Image image(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const Vec3 c = colour(x, y);
            for (int k = 0; k < 3; ++k) image.pixel(x, y)[k] = static_cast<std::uint8_t>(c[k]);
            image.pixel(x, y)[3] = 255;
        }
    return image;
}

Vec3 mean_about(const Image& image, const Vec2& at, int reach) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx, ++count)
            for (int k = 0; k < 3; ++k)
                sum[k] +=
                    image.pixel(static_cast<int>(at.x()) + dx, static_cast<int>(at.y()) + dy)[k];
    return sum / count;
}

/// The view that drew it tells where things are.
struct Drawn {
    std::unique_ptr<OffscreenView> view;
    Image image;
};

Drawn drawn_with(RoundHead& head, const Image& texture, Material material) {
    head.scene.textures = {texture};
    for (Surface& surface : head.scene.surfaces)
        if (surface.material == material) project_from_front(head.scene, surface);
    Drawn drawn{std::make_unique<OffscreenView>(head.scene, front_96()), {}};
    drawn.image = drawn.view->draw(head.pose);
    return drawn;
}

TEST(Textures, ThePictureLiesOnTheSkinAsItsCoordinatesSay) {
    RoundHead head;
    // Red to the subject's left (x > 0), green above on the other side, blue below
    const Drawn image = drawn_with(head,
                                   picture(64,
                                           [](int x, int y) {
                                               return x >= 32  ? Vec3(220, 40, 40)
                                                      : y < 32 ? Vec3(40, 200, 40)
                                                               : Vec3(40, 40, 220);
                                           }),
                                   Material::kSkin);
    const auto at = [&](double x, double y) {
        return mean_about(image.image, image.view->project(RoundHead::on_skin(x, y)), 2);
    };
    const Vec3 red = at(0.05, -0.02), green = at(-0.03, 0.06), blue = at(-0.04, -0.04);
    EXPECT_GT(red[0], 2 * std::max(red[1], red[2]));
    EXPECT_GT(green[1], 1.5 * std::max(green[0], green[2]));
    EXPECT_GT(blue[2], 1.5 * std::max(blue[0], blue[1]));
}

TEST(Textures, AFineCheckerboardAveragesInLinearLight) {
    // Black and white by halves are a linear 0.5, which sRGB writes as 188.
    RoundHead fine, even;
    const Drawn checked = drawn_with(
        fine,
        picture(2048, [](int x, int y) -> Vec3 { return Vec3::Constant((x + y) % 2 ? 255 : 0); }),
        Material::kSkin);
    const Drawn plain = drawn_with(
        even, picture(4, [](int, int) -> Vec3 { return Vec3::Constant(188); }), Material::kSkin);
    const Vec2 at = plain.view->project(RoundHead::on_skin(-0.02, -0.02));
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(mean_about(checked.image, at, 3)[k], mean_about(plain.image, at, 3)[k],
                    2.5);  // of 255
}

TEST(Textures, AnEyeWithAPictureShowsIt) {
    RoundHead head;
    const Drawn image =
        drawn_with(head, picture(8, [](int, int) { return Vec3(30, 30, 230); }), Material::kEye);
    const Eye& eye = head.scene.eyes[0];
    const Vec3 white =
        mean_about(image.image, image.view->project(eye.centre + Vec3(0.003, -0.0075, 0.009)), 0);
    EXPECT_GT(white[2], 1.6 * white[0]);
}

TEST(Textures, ATextureWithoutCoordinatesIsRefused) {
    RoundHead head;
    head.scene.textures = {picture(4, [](int, int) -> Vec3 { return Vec3::Constant(100); })};
    head.scene.surfaces[0].texture = 0;
    head.scene.surfaces[0].texcoords.resize(0, 2);
    try {
        OffscreenView view(head.scene, front_96());
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "scene/surfaces/0/texcoords: expected " +
                      std::to_string(3 * head.scene.surfaces[0].triangles.rows()) +
                      " rows with a texture, found 0");
    }
}

}  // namespace
}  // namespace risorius::render
