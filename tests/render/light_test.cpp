// SPDX-License-Identifier: MIT
// Laws of light: exposure on a grey card, no energy made or lost, and what presets promise.

#include "risorius/render/detail/light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/round_head.h"
#include "risorius/core/error.h"
#include "risorius/render/detail/environment.h"
#include "risorius/render/detail/lights.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

double linear(double byte) {
    const double s = byte / 255;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// A round head behind a card that looks straight ahead and covers its middle.
RoundHead with_card(double reflectance) {
    RoundHead head;
    const auto first = static_cast<int>(head.scene.rest.rows());
    head.scene.rest.conservativeResize(first + 4, 3);
    head.scene.rest.bottomRows(4) << -0.03, -0.03, 0.13, 0.03, -0.03, 0.13, 0.03, 0.03, 0.13, -0.03,
        0.03, 0.13;
    Surface card;
    card.material = Material::kMatte;
    card.reflectance = reflectance;
    card.triangles.resize(2, 3);
    card.triangles << first, first + 1, first + 2, first, first + 2, first + 3;
    head.scene.surfaces.push_back(card);
    head.pose.positions = head.scene.rest;
    return head;
}

ViewOptions lit_by(const std::string& preset, double exposure_ev = 0) {
    ViewOptions options{.width_px = 128, .height_px = 128, .supersampling = 1};
    options.light.preset = preset;
    options.light.exposure_ev = exposure_ev;
    return options;
}

TEST(Light, AGreyCardOf18PercentComesOutAs18PercentUnderEveryPreset) {
    const RoundHead head = with_card(0.18);
    for (const std::string& preset : light_names()) {
        OffscreenView view(head.scene, lit_by(preset));
        const Vec2 middle = view.project(Vec3(0, 0, 0.13));
        const Image image = view.draw(head.pose);
        const std::uint8_t* p =
            image.pixel(static_cast<int>(middle.x()), static_cast<int>(middle.y()));
        // One step of a byte is 1.7 % here, so the nearest byte is within 1 % or the card is off.
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(linear(p[k]), 0.18, 0.0018) << preset << " " << k;
    }
}

/// Linear green of the card before a head of this skin.
double of_card(const Vec3& skin_tone, Meter meter, const std::string& preset = "studio",
               std::optional<Surroundings> surroundings = std::nullopt) {
    RoundHead head = with_card(0.12);
    head.scene.appearance.skin_tone = skin_tone;
    ViewOptions options = lit_by(preset);
    options.light.meter = meter;
    options.light.surroundings = std::move(surroundings);
    OffscreenView view(head.scene, options);
    const Vec2 at = view.project(Vec3(0, 0, 0.13));
    return linear(
        view.draw(head.pose).pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[1]);
}

TEST(Light, DarkSkinGetsMoreExposureUnlessTheLightIsForACard) {
    const Vec3 darkest(0.20, 0.14, 0.11), dark(0.45, 0.31, 0.25), light(0.80, 0.60, 0.50);
    for (const std::string& preset : light_names()) {
        EXPECT_NEAR(of_card(light, Meter::kSkin, preset), 0.12, 0.0012) << preset;
        EXPECT_NEAR(of_card(darkest, Meter::kCard, preset), 0.12, 0.0012) << preset;
        EXPECT_NEAR(of_card(darkest, Meter::kSkin, preset), std::exp2(0.8) * 0.12, 0.003) << preset;
    }
    const double between = of_card(dark, Meter::kSkin);
    EXPECT_GT(between, 1.2 * 0.12);
    EXPECT_LT(between, 1.7 * 0.12);
    const Surroundings even{8, 4, std::vector<float>(96, 1.0F)};
    EXPECT_NEAR(of_card(darkest, Meter::kSkin, "studio", even), 0.12, 0.0012)
        << "a picture of the surroundings is as it was taken";
}

TEST(Light, DarkSkinGetsMoreFill) {
    const LightPlan card = plan_light({}, 0.0);
    LightPlan plan = card;
    EXPECT_EQ(suit_skin(Vec3(0.80, 0.60, 0.50), plan), 0.0);
    EXPECT_EQ(plan.fill.card, card.fill.card);
    EXPECT_NEAR(suit_skin(Vec3(0.20, 0.14, 0.11), plan), 0.8, 1e-12);
    EXPECT_NEAR(plan.fill.card.x() / card.fill.card.x(), 1.8, 1e-12);
    EXPECT_EQ(plan.key.card, card.key.card);
    for (std::size_t i = 0; i < plan.surroundings.rgb.size(); ++i)
        EXPECT_NEAR(plan.surroundings.rgb[i], 1.8 * card.surroundings.rgb[i], 1e-5);
}

TEST(Light, AStopMoreDoublesTheLightOfACard) {
    const RoundHead head = with_card(0.12);
    const auto shines = [&](double ev) {
        OffscreenView view(head.scene, lit_by("studio", ev));
        const Vec2 at = view.project(Vec3(0, 0, 0.13));
        return linear(
            view.draw(head.pose).pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[1]);
    };
    EXPECT_NEAR(shines(1) / shines(0), 2.0, 0.03);
}

TEST(Light, InAWhiteFurnaceAWhiteBallVanishesAndSkinAddsNothing) {
    // Even light from all around, half of white so that nothing is rolled off
    RoundHead head;
    head.scene.appearance.skin_tone = head.scene.appearance.lip_tone =
        head.scene.appearance.hair_tone = Vec3(1, 1, 1);
    head.scene.appearance.freckles = 0;
    for (Surface& surface : head.scene.surfaces)
        if (surface.material != Material::kSkin) surface.triangles.resize(0, 3);
    const auto brightness = [&](Material material) {
        head.scene.surfaces.front().material = Material::kSkin;
        Scene scene = head.scene;
        if (material == Material::kMatte) {
            Surface ball = scene.surfaces.front();
            ball.material = Material::kMatte;
            ball.reflectance = 1;
            scene.surfaces.push_back(ball);
            scene.surfaces.front().triangles.conservativeResize(1, 3);  // next to none
        }
        ViewOptions options = lit_by("even", -1.2);
        options.background.transparent = true;
        const Image image = OffscreenView(scene, options).draw(head.pose);
        double low = 9, high = 0;
        for (int y = 0; y < image.height_px; ++y)
            for (int x = 0; x < image.width_px; ++x) {
                const std::uint8_t* p = image.pixel(x, y);
                if (p[3] < 255) continue;
                low = std::min(low, linear(p[1]));
                high = std::max(high, linear(p[1]));
            }
        return std::pair(low / std::exp2(-1.2), high / std::exp2(-1.2));
    };
    const auto [matte_low, matte_high] = brightness(Material::kMatte);
    EXPECT_NEAR(matte_low, 1.0, 0.01);
    EXPECT_NEAR(matte_high, 1.0, 0.01);
    // White skin under this light: blood spots and pores take some of it, nothing adds to it.
    const auto [skin_low, skin_high] = brightness(Material::kSkin);
    EXPECT_LT(skin_high, 1.01);
    EXPECT_GT(skin_low, 0.70);
}

TEST(Light, IrradianceOfACosineSkyIsThatOfTheIntegral) {
    // Radiance 1 + z from direction (x, y, z): a matt white surface with normal n shines with 1 + 2/3 n_z.
    const Irradiance light =
        irradiance_of(sampled([](const Vec3& d) -> Vec3 { return Vec3::Constant(1 + d.z()); }, 64));
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 0.6, -0.8)})
        EXPECT_NEAR(irradiance_at(light, n)[0], 1 + 2.0 / 3 * n.z(), 2e-3);
}

TEST(Light, ALampTakenOutOfTheSurroundingsLeavesTheLightAsItWas) {
    const Vec3 sun = Vec3(0.5, 0.6, 0.62).normalized();
    Surroundings map = sampled(
        [&](const Vec3& d) -> Vec3 {
            return Vec3(0.5, 0.6, 0.8) + (d.dot(sun) > 0.995 ? Vec3(90, 80, 60) : Vec3(0, 0, 0));
        },
        64);
    const Vec3 before = irradiance_at(irradiance_of(map), sun);
    const Lamp lamp = take_brightest(map);
    EXPECT_GT(lamp.direction.dot(sun), 0.999);
    const Vec3 after = irradiance_at(irradiance_of(map), sun) + lamp.card;
    // Harmonics up to the second order hold 94 % of a small lamp that is faced.
    EXPECT_NEAR(after[1] / before[1], 1.0, 0.10);
    EXPECT_GT(lamp.card[0], lamp.card[2]);
}

TEST(Light, ExposureTurnsWithTheCameraSoThatASetOfViewsIsExposedAlike) {
    const LightPlan front = plan_light({}, 0.0), side = plan_light({}, std::numbers::pi / 2);
    EXPECT_LT((exposure_for(front, 0) - exposure_for(side, 0)).norm(), 1e-4);
}

TEST(Light, SurroundingsLightTheSideTheyAreBrightOnAndTurnWithTheirAngle) {
    RoundHead head;
    // Columns run from behind over the subject's right, front (the middle) and left.
    Surroundings from_left{16, 8, std::vector<float>(16 * 8 * 3, 0.1F)};
    for (std::size_t y = 2; y < 6; ++y)
        for (std::size_t x = 11; x < 14; ++x)
            for (std::size_t k = 0; k < 3; ++k) from_left.rgb[3 * (16 * y + x) + k] = 5.0F;
    ViewOptions options = lit_by("studio");
    options.light.surroundings = from_left;
    const auto sides = [&](double turn_deg) {
        options.light.turn_deg = turn_deg;
        OffscreenView view(head.scene, options);
        const Image image = view.draw(head.pose);
        const auto at = [&](double x) {
            const Vec2 p = view.project(RoundHead::on_skin(x, -0.02));
            return linear(image.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()))[1]);
        };
        return std::pair(at(0.07), at(-0.07));
    };
    const auto [left, right] = sides(0);
    EXPECT_GT(left, 3 * right);
    const auto [turned_left, turned_right] = sides(-180);
    EXPECT_LT(turned_left, 1.5 * turned_right);
}

TEST(Light, NoneThatComesInAtAnOpeningGoesOutThroughTheBack) {
    // A hollow head in front of a card, closed and with an opening towards the key light
    const auto shadow_of = [](bool open) {
        RoundHead head = with_card(0.5);
        head.scene.rest.bottomRows(4) << -1, -1, -0.14, 1, -1, -0.14, 1, 1, -0.14, -1, 1, -0.14;
        head.pose.positions = head.scene.rest;
        std::erase_if(head.scene.surfaces, [](const Surface& surface) {
            return surface.material != Material::kSkin && surface.material != Material::kMatte;
        });
        Triangles& skin = head.scene.surfaces.front().triangles;
        const Vec3 opening = Vec3(-0.5, 0.5, 0.75).normalized();
        Eigen::Index kept = 0;
        for (Eigen::Index f = 0; f < skin.rows(); ++f) {
            const Vec3 p = head.scene.rest.row(skin(f, 0)).transpose();
            if (!open || p.normalized().dot(opening) < std::cos(0.6))
                skin.row(kept++) = skin.row(f);
        }
        skin.conservativeResize(kept, 3);
        OffscreenView view(head.scene, lit_by("studio"));
        return std::pair(view.draw(head.pose), view.project(Vec3(kHeadRadius_m * 1.1, 0, 0)));
    };
    const auto [closed, rim] = shadow_of(false);
    const Image open = shadow_of(true).first;
    const double radius = rim.x() - 64;
    int beside = 0, darkest = 255, lightest = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            if (std::hypot(x - 64, y - 64) < radius + 2) continue;
            const int a = closed.pixel(x, y)[1], b = open.pixel(x, y)[1];
            EXPECT_NEAR(a, b, 3) << x << " " << y;
            darkest = std::min(darkest, a);
            lightest = std::max(lightest, a);
            ++beside;
        }
    EXPECT_GT(beside, 1000);
    EXPECT_GT(lightest, darkest + 40) << "a shadow lies on the card";
}

TEST(Light, WrongLightIsNamed) {
    const auto message = [](const LightOptions& options) -> std::string {
        try {
            plan_light(options, 0.0);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(message([] {
                  LightOptions o;
                  o.preset = "disco";
                  return o;
              }()),
              "light/preset: expected one of \"studio\", \"soft\", \"dramatic\", \"outdoor\", "
              "\"portrait\", \"even\", found \"disco\"");
    EXPECT_EQ(message([] {
                  LightOptions o;
                  o.exposure_ev = 11;
                  return o;
              }()),
              "light/exposure_ev: expected [-10, 10], found 11.000000");
}

}  // namespace
}  // namespace risorius::render
