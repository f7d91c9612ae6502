// SPDX-License-Identifier: MIT
/// \file
/// The lighting of a picture: lamps, surroundings and exposure.
///
/// White balance depends only on the light, and so does the exposure where the light is not set for dark skin: a grey card of 18 %
/// reflectance that stands at the face and is turned to the camera has a linear value of 0.18 then. Below kStraightTo, pixel
/// values (sRGB decoded) are proportional to light.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace risorius::render {

/// Radiance from all directions as a latitude-longitude map. The first row is straight up and the last one straight down. Columns
/// start straight behind the head and run over the subject's right to the front (the middle column) and on to the left. The unit
/// is arbitrary, because the exposure depends on the light.
struct Surroundings {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< 3 per cell (red, green, blue), linear, row by row
    bool operator==(const Surroundings&) const = default;
};

/// What the lamps and the exposure of a preset are set for.
enum class Meter {
    kSkin,  ///< dark skin gets a stronger fill and more exposure, skin as light as the adult's nothing
    kCard  ///< the same for every face
};

struct LightOptions {
    std::string preset = "studio";             ///< one of light_names(); moves with the camera
    std::optional<Surroundings> surroundings;  ///< replaces the preset; fixed to the head frame
    /// Rotation of all light about the vertical axis, positive towards the subject's left
    double turn_deg = 0;
    double exposure_ev = 0;      ///< added to the exposure, stops, -10..10
    Meter meter = Meter::kSkin;  ///< without effect on `surroundings`
    bool operator==(const LightOptions&) const = default;
};

/// Linear light above this fraction of white is compressed, so that highlights keep their shading.
constexpr double kStraightTo = 0.5;

/// The names of the presets: "studio", "soft", "dramatic", "outdoor", "portrait", "even".
const std::vector<std::string>& light_names();

}  // namespace risorius::render
