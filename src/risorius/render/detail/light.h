// SPDX-License-Identifier: MIT
/// \file
/// The lighting of a picture: lamps, surroundings and exposure.
///
/// Exposure and white balance depend only on the light: a grey card of 18 % reflectance at the face, turned to the camera, has a
/// linear value of 0.18 in every picture. Below kStraightTo the picture is linear in light.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace risorius::render {

/// Radiance from all directions as a latitude-longitude map. Rows start straight up. Columns start straight behind and run over
/// the subject's right to the front (the middle) and the left. Only ratios count.
struct Surroundings {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< 3 per cell, linear
    bool operator==(const Surroundings&) const = default;
};

struct LightOptions {
    std::string preset = "studio";             ///< one of light_names(); moves with the camera
    std::optional<Surroundings> surroundings;  ///< replaces the preset; fixed to the head frame
    double turn_deg = 0;  ///< rotation of all light about the vertical, towards the subject's left
    double exposure_ev = 0;  ///< added to the exposure of the grey card, stops, -10..10
    bool operator==(const LightOptions&) const = default;
};

/// Linear light above this fraction of white is compressed, so that highlights keep their shape.
constexpr double kStraightTo = 0.5;

/// "studio", "soft", "dramatic", "outdoor", "even"
const std::vector<std::string>& light_names();

}  // namespace risorius::render
