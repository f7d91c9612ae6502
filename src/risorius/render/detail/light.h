// What lights a picture: lamps and surroundings, and how they are exposed.
//
// Exposure and white balance are fixed by the light alone: a grey card of 18 % held at the face towards the camera comes out as
// 18 % in linear light, whoever is in the picture and whatever they do. Up to kStraightTo the picture is linear in light.
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

/// Linear light above this share of white is rolled off, so that highlights keep their shape.
constexpr double kStraightTo = 0.5;

/// "studio", "soft", "dramatic", "outdoor", "even"
const std::vector<std::string>& light_names();

}  // namespace risorius::render
