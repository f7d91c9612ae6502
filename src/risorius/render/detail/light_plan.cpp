// SPDX-License-Identifier: MIT
// Preset lights, and the exposure of any light.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/render/detail/lights.h"
#include "risorius/render/detail/names_of.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr int kPresetHeight = 32;

struct LampRecipe {
    /// Relative to the camera; in mirrored views away from the side that the face looks to.
    double aside_deg, up_deg;
    Vec3 card;
};

// Relative light of a card that faces each lamp. Surroundings: from straight up, level, straight down.
struct Preset {
    const char* name;
    LampRecipe key, fill, rim;
    Vec3 zenith, horizon, nadir;
};

const Vec3 kWarm(1.00, 0.955, 0.90), kCool(0.90, 0.95, 1.00), kNone(0, 0, 0);

const Preset kPresets[] = {
    {"studio",
     {-40, 32, 1.30 * kWarm},
     {46, 6, 0.26 * kCool},
     {142, 32, 0.80 * kCool},
     {0.40, 0.41, 0.42},
     {0.17, 0.17, 0.175},
     {0.14, 0.125, 0.115}},
    {"soft",
     {-24, 40, 0.60 * kWarm},
     {30, 4, 0.36 * kCool},
     {150, 35, 0.30 * kCool},
     {0.75, 0.76, 0.78},
     {0.42, 0.42, 0.42},
     {0.34, 0.32, 0.30}},
    {"dramatic",
     {-62, 36, 1.60 * kWarm},
     {60, 0, 0.05 * kCool},
     {138, 28, 1.10 * kCool},
     {0.12, 0.12, 0.13},
     {0.06, 0.06, 0.065},
     {0.04, 0.036, 0.034}},
    {"outdoor",
     {-35, 42, 2.00 * Vec3(1.0, 0.93, 0.82)},
     {60, 0, kNone},
     {150, 30, kNone},
     {0.42, 0.60, 0.95},
     {0.62, 0.68, 0.72},
     {0.30, 0.27, 0.22}},
    // A weaker key, a broad fill and a strong rim: the form of dark skin shows as well as that of light skin.
    {"portrait",
     {-32, 30, 1.00 * kWarm},
     {50, 0, 0.50 * kCool},
     {140, 20, 0.90 * kCool},
     {0.40, 0.41, 0.42},
     {0.22, 0.22, 0.225},
     {0.16, 0.145, 0.135}},
    {"even", {0, 0, kNone}, {0, 0, kNone}, {0, 0, kNone}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
};

Vec3 direction(double azimuth_rad, double elevation_deg) {
    const double e = elevation_deg * std::numbers::pi / 180;
    return {std::cos(e) * std::sin(azimuth_rad), std::sin(e), std::cos(e) * std::cos(azimuth_rad)};
}

const Preset& preset_named(const std::string& name) {
    std::string known;
    for (const Preset& preset : kPresets) {
        if (preset.name == name) return preset;
        known.append(known.empty() ? "\"" : ", \"").append(preset.name).append("\"");
    }
    throw Error("light/preset", "one of " + known, "\"" + name + "\"");
}

/// The map rotated about the vertical, to the nearest cell.
Surroundings turned(const Surroundings& map, double turn_deg) {
    const int by = static_cast<int>(std::lround(turn_deg / 360 * map.width));
    Surroundings out = map;
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const int from = ((column - by) % map.width + map.width) % map.width;
            for (int k = 0; k < 3; ++k)
                out.rgb[static_cast<std::size_t>(3 * (row * map.width + column) + k)] =
                    map.rgb[static_cast<std::size_t>(3 * (row * map.width + from) + k)];
        }
    return out;
}

}  // namespace

const std::vector<std::string>& light_names() {
    static const std::vector<std::string> names = names_of(kPresets);
    return names;
}

LightPlan plan_light(const LightOptions& options, double camera_azimuth_rad) {
    if (!(std::abs(options.exposure_ev) <= 10))
        throw Error("light/exposure_ev", "[-10, 10]", std::to_string(options.exposure_ev));
    if (!(std::abs(options.turn_deg) <= 360))
        throw Error("light/turn_deg", "[-360, 360]", std::to_string(options.turn_deg));
    LightPlan plan;
    if (options.surroundings) {
        plan.surroundings = turned(*options.surroundings, options.turn_deg);
        plan.key = take_brightest(plan.surroundings);
        return plan;
    }
    const Preset& preset = preset_named(options.preset);
    // The key stands on the side that the face looks to, so that it models cheek and nose. It is mirrored with the camera.
    const double side = camera_azimuth_rad < -0.02 ? -1 : 1;
    const double turn = options.turn_deg * std::numbers::pi / 180;
    const auto lamp = [&](const LampRecipe& recipe) {
        const double aside = side * recipe.aside_deg * std::numbers::pi / 180;
        return Lamp{direction(camera_azimuth_rad + aside + turn, recipe.up_deg), recipe.card};
    };
    plan.key = lamp(preset.key);
    plan.fill = lamp(preset.fill);
    plan.rim = lamp(preset.rim);
    plan.surroundings = sampled(
        [&](const Vec3& from) -> Vec3 {
            const double h = from.y();
            const Vec3& end = h > 0 ? preset.zenith : preset.nadir;
            return preset.horizon + (end - preset.horizon) * std::abs(h);
        },
        kPresetHeight);
    plan.forward = direction(camera_azimuth_rad, 0);
    return plan;
}

double suit_skin(const Vec3& skin_tone, LightPlan& plan) {
    constexpr double kMoreFill = 0.8, kMoreExposure_ev = 0.8;
    const double dark = skin_darkness(linear_from_srgb(skin_tone));
    plan.fill.card *= 1 + kMoreFill * dark;
    for (float& radiance : plan.surroundings.rgb)
        radiance *= static_cast<float>(1 + kMoreFill * dark);
    return kMoreExposure_ev * dark;
}

Vec3 exposure_for(const LightPlan& plan, double exposure_ev) {
    Vec3 card = irradiance_at(irradiance_of(plan.surroundings), plan.forward);
    for (const Lamp* lamp : {&plan.key, &plan.fill, &plan.rim})
        card += lamp->card * std::max(lamp->direction.dot(plan.forward), 0.0);
    if (card.minCoeff() <= 0)
        throw Error("light/surroundings", "light of every colour on the face", "none");
    return (std::exp2(exposure_ev) * card.cwiseInverse()).eval();
}

}  // namespace risorius::render
