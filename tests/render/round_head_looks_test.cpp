// SPDX-License-Identifier: MIT
// What skin, lips, hair, eyes, lids and teeth of the round head look like.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "render/round_head.h"
#include "render/small_pictures.h"

namespace risorius::render {
namespace {

/// Tests that leave the head as it is share a view and its picture.
class RoundHeadLooks : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        plain_view = std::make_unique<OffscreenView>(plain_head.scene, large());
        plain_image = plain_view->draw(plain_head.pose);
    }
    static void TearDownTestSuite() { plain_view.reset(); }

    static ViewOptions large() { return {.width_px = 384, .height_px = 384, .camera = "front"}; }
    static double plain_brightness(const Vec3& place) {
        return brightness_of(mean_colour(plain_image, plain_view->project(place), 1));
    }
    static const RoundHead plain_head;
    static std::unique_ptr<OffscreenView> plain_view;
    static Image plain_image;
};
const RoundHead RoundHeadLooks::plain_head;
std::unique_ptr<OffscreenView> RoundHeadLooks::plain_view;
Image RoundHeadLooks::plain_image;

TEST_F(RoundHeadLooks, LipsAreRedderThanTheCheek) {
    const auto redness = [&](const Vec3& p) {
        const std::array<double, 3> c = mean_colour(plain_image, plain_view->project(p), 4);
        return c[0] / (c[1] + 1);
    };
    EXPECT_GT(redness(RoundHead::on_skin(0, -0.047)),
              1.08 * redness(RoundHead::on_skin(-0.045, -0.035)));
}

TEST_F(RoundHeadLooks, NobodySeesThroughTheHeadPastAnEye) {
    // Skin stands 16 mm off the axis of the left eye, whose ball has 12.
    RoundHead head;
    const Eye& eye = head.scene.eyes[0];
    Triangles& skin = head.scene.surfaces[0].triangles;
    long kept = 0;
    for (long f = 0; f < skin.rows(); ++f) {
        Vec3 middle = Vec3::Zero();
        for (int k = 0; k < 3; ++k) middle += head.scene.rest.row(skin(f, k)).transpose() / 3;
        if (middle.z() < 0 || (middle - eye.centre).head<2>().norm() > 0.016)
            skin.row(kept++) = skin.row(f);
    }
    skin.conservativeResize(kept, 3);
    ViewOptions options = large();
    options.background.transparent = true;
    const auto beside_the_ball = [&] {
        OffscreenView view(head.scene, options);
        const Image image = view.draw(head.pose);
        const Vec2 p = view.project(eye.centre - Vec3(0, 1.1 * eye.radius_m, 0));
        const std::uint8_t* pixel = image.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()));
        return std::array<int, 2>{pixel[3], pixel[0] + pixel[1] + pixel[2]};
    };
    EXPECT_EQ(beside_the_ball()[0], 0) << "without lids nobody knows where the eye is open to";
    head.scene.landmarks["en_l"] = RoundHead::on_skin(0.014, 0.02);
    head.scene.landmarks["ex_l"] = RoundHead::on_skin(0.046, 0.02);
    head.scene.landmarks["ps_l"] = RoundHead::on_skin(0.03, 0.036);
    head.scene.landmarks["pi_l"] = RoundHead::on_skin(0.03, 0.004);
    const auto [opacity, sum] = beside_the_ball();
    EXPECT_EQ(opacity, 255);
    EXPECT_LT(sum, 3 * 60) << "it is dark in there";
}

TEST_F(RoundHeadLooks, HairOfSomeLengthStandsOffTheScalpAndOnlyThere) {
    RoundHead head;
    head.scene.landmarks["tr"] = RoundHead::on_skin(0, 0.06);
    head.scene.landmarks["fht_l"] = RoundHead::on_skin(0.05, 0.04);
    head.scene.landmarks["fht_r"] = RoundHead::on_skin(-0.05, 0.04);
    ViewOptions options = small();
    options.background.transparent = true;
    options.width_px = options.height_px = 64;
    options.supersampling = 1;
    /// Beside the crown and beside the chin
    const auto opacities = [&] {
        OffscreenView view(head.scene, options);
        const Image image = view.draw(head.pose);
        std::array<int, 2> sum{0, 0};
        for (const int end : {0, 1}) {
            const Vec2 p = view.project(Vec3(0, (end == 0 ? 1 : -1) * (kHeadRadius_m + 0.006), 0));
            for (int dx = -2; dx <= 2; ++dx)
                sum[static_cast<std::size_t>(end)] +=
                    image.pixel(static_cast<int>(p.x()) + dx, static_cast<int>(p.y()))[3];
        }
        return sum;
    };
    EXPECT_EQ(opacities(), (std::array<int, 2>{0, 0}));
    head.scene.appearance.hair_length_mm = 15;
    const std::array<int, 2> hairy = opacities();
    EXPECT_GT(hairy[0], 2 * 255);
    EXPECT_EQ(hairy[1], 0);
}

TEST_F(RoundHeadLooks, TheWhiteOfTheEyeIsBrighterThanTheIrisAndThatThanThePupil) {
    const Vec3 eye = plain_head.scene.eyes[0].centre;
    // Below the middle, away from the mirrored lamps
    const auto at = [&](double x, double y) { return plain_brightness(eye + Vec3(x, y, 0.0105)); };
    const double white = at(0.0, -0.0083), iris = at(0.0, -0.0038), pupil = at(0.0, 0.0);
    EXPECT_GT(white, iris);  // where the cornea gathers light on a blue one
    EXPECT_GT(iris, 1.25 * pupil);

    // The white is not the same paint for everybody: people with dark skin have a darker one.
    RoundHead dark;
    dark.scene.appearance.skin_tone = Vec3(0.42, 0.29, 0.22);
    ViewOptions same_light = small();
    same_light.light.meter = Meter::kCard;
    OffscreenView view(dark.scene, same_light);
    const Vec2 place = view.project(eye + Vec3(0.0, -0.0083, 0.0105));
    const Image picture = view.draw(dark.pose);
    const std::uint8_t* there =
        picture.pixel(static_cast<int>(place.x()), static_cast<int>(place.y()));
    EXPECT_LT(there[0] + there[1] + there[2], 0.97 * 3 * white);
}

TEST_F(RoundHeadLooks, TheIrisIsBrighterOnTheSideAwayFromTheLamp) {
    const Vec3 eye = plain_head.scene.eyes[0].centre;
    const auto at = [&](double x, double y) { return plain_brightness(eye + Vec3(x, y, 0.0105)); };
    // The key light comes from the subject's right and above; the mirrored lamps lie on that side.
    EXPECT_GT(at(0.0030, -0.0024), 1.2 * at(-0.0036, -0.0014));
}

TEST_F(RoundHeadLooks, ThePupilTurnsWithTheEye) {
    Pose pose = plain_head.pose;
    const Eye& eye = plain_head.scene.eyes[0];
    const Mat3 turn = Eigen::AngleAxisd(0.45, Vec3::UnitY()).toRotationMatrix();
    for (Eigen::Index i = 0; i < plain_head.scene.rest.rows(); ++i) {
        const Vec3 arm = plain_head.scene.rest.row(i).transpose() - eye.centre;
        if (arm.norm() < eye.radius_m + 1e-6)
            pose.positions.row(i) = (eye.centre + turn * arm).transpose();
    }
    pose.eye_rotation[0] = turn;
    const Image turned = plain_view->draw(pose);
    // The pupil lies behind the surface, so look along its direction at the depth of the iris.
    const Vec3 pupil = eye.centre + turn * Vec3(0, 0, 0.0104);
    const double there = brightness_of(mean_colour(turned, plain_view->project(pupil), 1));
    const double ahead = brightness_of(
        mean_colour(turned, plain_view->project(eye.centre + Vec3(-0.002, -0.003, 0.0104)), 1));
    EXPECT_LT(there, 0.6 * ahead);
}

TEST_F(RoundHeadLooks, ALidThatHasUnrolledIsNotShadedByTheCreaseItCameFrom) {
    // A groove across the skin above the left eye, gone when the eye is shut
    RoundHead head;
    for (const auto& [id, y] : {std::pair{"ps_l", 0.026}, {"pi_l", 0.014}})
        head.scene.landmarks[id] = RoundHead::on_skin(0.03, y);
    head.scene.landmarks["en_l"] = RoundHead::on_skin(0.018, 0.02);
    head.scene.landmarks["ex_l"] = RoundHead::on_skin(0.042, 0.02);
    const Points flat = head.scene.rest;
    const Vec3 groove = RoundHead::on_skin(0.03, 0.040);
    for (Eigen::Index v = 0; v < flat.rows(); ++v)
        if (std::abs(flat(v, 1) - groove.y()) < 0.003 && std::abs(flat(v, 0) - 0.03) < 0.015 &&
            flat.row(v).norm() > 0.999 * kHeadRadius_m && flat(v, 2) > 0)
            head.scene.rest.row(v) *= 0.86;
    Pose shut;
    shut.positions = flat;
    // The margins meet
    const auto nearest = [&](const Vec3& p) {
        Eigen::Index best = 0;
        for (Eigen::Index v = 0; v < flat.rows(); ++v)
            if ((flat.row(v).transpose() - p).norm() < (flat.row(best).transpose() - p).norm())
                best = v;
        return best;
    };
    shut.positions.row(nearest(RoundHead::on_skin(0.03, 0.026))) =
        flat.row(nearest(RoundHead::on_skin(0.03, 0.014)));

    OffscreenView as_at_rest(head.scene, small());
    const auto brightness_at = [&](OffscreenView& view) {
        return brightness_of(mean_colour(view.draw(shut), view.project(groove), 1));
    };
    const double shaded = brightness_at(as_at_rest);
    head.scene.shut = flat;
    OffscreenView told(head.scene, small());
    EXPECT_GT(brightness_at(told), shaded + 10);
    Pose open;
    open.positions = head.scene.rest;
    EXPECT_EQ(fingerprint(told.draw(open)), fingerprint(as_at_rest.draw(open)));
}

// Sheets that stand for lashes would else throw a dark band on the lid below them.
TEST_F(RoundHeadLooks, LashesTakeNoSkyFromTheSkin) {
    const Vec3 cheek = RoundHead::on_skin(0.03, -0.015);
    RoundHead head;
    const auto first = static_cast<int>(head.scene.rest.rows());
    head.scene.rest.conservativeResize(first + 4, 3);
    for (int k = 0; k < 4; ++k)
        head.scene.rest.row(first + k) =
            (1.05 * cheek + 0.02 * Vec3(k % 2 == 0 ? -1 : 1, k < 2 ? -1 : 1, 0)).transpose();
    Surface lashes;
    lashes.material = Material::kLashes;
    lashes.triangles.resize(2, 3);
    lashes.triangles << first, first + 1, first + 3, first, first + 3, first + 2;
    head.scene.surfaces.push_back(lashes);
    head.pose.positions = head.scene.rest;
    head.pose.positions.bottomRows(4).rowwise() -= Eigen::RowVector3d(0, 0, 0.3);  // out of sight
    OffscreenView view(head.scene, large());
    const double shaded = brightness_of(mean_colour(view.draw(head.pose), view.project(cheek), 1));
    EXPECT_NEAR(shaded / plain_brightness(cheek), 1, 0.01);
}

TEST_F(RoundHeadLooks, AClosedSurfaceHidesTheTeeth) {
    RoundHead without;
    without.scene.surfaces.pop_back();
    EXPECT_EQ(fingerprint(OffscreenView(without.scene, large()).draw(without.pose)),
              fingerprint(plain_image));
}

TEST_F(RoundHeadLooks, AMouthThatOpensLetsLightOnTheTeeth) {
    // Teeth in front of the skin, so that only the light changes with the lips.
    RoundHead head;
    for (Eigen::Index i = 0; i < head.scene.rest.rows(); ++i)
        if ((head.scene.rest.row(i).transpose() - Vec3(0, -0.045, 0.06)).norm() < 0.0125)
            head.scene.rest(i, 2) += 0.04;
    head.pose.positions = head.scene.rest;
    OffscreenView view(head.scene, small());
    const Vec2 place = view.project(Vec3(0, -0.045, 0.111));
    const double closed = brightness_of(mean_colour(view.draw(head.pose), place, 2));
    const Eigen::Index lower = [&] {
        Eigen::Index best = 0;
        (head.scene.rest.rowwise() - head.scene.landmarks.at("li").transpose())
            .rowwise()
            .squaredNorm()
            .minCoeff(&best);
        return best;
    }();
    head.pose.positions(lower, 1) -= 0.03;
    const double open = brightness_of(mean_colour(view.draw(head.pose), place, 2));
    EXPECT_GT(open, closed + 20);
}

}  // namespace
}  // namespace risorius::render
