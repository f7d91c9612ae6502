// SPDX-License-Identifier: MIT
/// \file
/// The lighting of a picture: lamps, surroundings and exposure.
///
/// Exposure and white balance depend only on the light: a grey card of 18 % at the face towards the camera is 18 % in linear light in every
/// picture. Below kStraightTo the picture is linear in light.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace risorius::render {

/// Radiance from all around, latitude by longitude: rows from straight up, columns from straight behind over the subject's
/// right, front (the middle) and left. Only ratios count.
struct Surroundings {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< 3 per cell, linear
    bool operator==(const Surroundings&) const = default;
};

struct LightOptions {
    std::string preset = "studio";             ///< light_names(); goes with the camera
    std::optional<Surroundings> surroundings;  ///< in place of the preset; stands still
    double turn_deg = 0;     ///< of the whole light about the vertical, to the subject's left
    double exposure_ev = 0;  ///< on top of what the grey card asks for, stops, -10..10
    bool operator==(const LightOptions&) const = default;
};

/// Linear light above this fraction of white is compressed, so that highlights keep their shape.
constexpr double kStraightTo = 0.5;

/// "studio", "soft", "dramatic", "outdoor", "even"
const std::vector<std::string>& light_names();

}  // namespace risorius::render
