// SPDX-License-Identifier: MIT
/// \file
/// Loads on a body besides its weight: springs, force generators and obstacles, as experiment files describe them.
///
///   "springs": [{"at": [1, 1, 0], "tied_to_m": [4, 4, -1], "stiffness_n_per_m": 10, "rest_length_m": 0}]
///   "pulses": [{"at": [0.5, 0.5, 0], "direction": [0, 0, 1], "shape": "sine", "amplitude_n": 2, "frequency_hz": 3}]
///   "obstacles": [{"plane": {"point_m": [0, 0, -1], "normal": [0, 0, 1]}, "contact": {"friction": 0.5}},
///                 {"sphere": {"centre_m": [0, 0, 0], "radius_m": 1}},
///                 {"capsule": {"start_m": [0, 0, 0], "end_m": [1, 0, 0], "radius_m": 0.2}}]
///
/// "at" gives material coordinates, each in [0, 1], so it is the same point of the body at any resolution.
#pragma once

#include <memory>
#include <vector>

#include "risorius/contact/contact_law.h"
#include "risorius/contact/obstacle.h"
#include "risorius/core/json_cursor.h"
#include "risorius/tissue/force_generators.h"
#include "risorius/tissue/point_springs.h"

namespace risorius::softbody {

/// An entry of "springs".
struct SpringDescription {
    Vec3 at;                     ///< material coordinates
    tissue::PointSpring spring;  ///< spring.at is set when the body is built
};

/// An entry of "pulses".
struct PulseDescription {
    Vec3 at;                           ///< material coordinates
    tissue::ForceGenerator generator;  ///< generator.at is set when the body is built
};

/// An entry of "obstacles".
struct ObstacleDescription {
    std::shared_ptr<const contact::Obstacle> obstacle;
    contact::ContactMaterial contact;
};

/// Read lists of loads. `axes` is the number of material axes of the body. Throw Error for wrong values.
std::vector<SpringDescription> read_springs(const JsonCursor& json, int axes);
std::vector<PulseDescription> read_pulses(const JsonCursor& json, int axes);
ObstacleDescription read_obstacle(const JsonCursor& json);
std::vector<ObstacleDescription> read_obstacles(const JsonCursor& json);
/// Reads the fields of ContactMaterial. Fields that are left out have their default values. Throws Error for wrong values.
contact::ContactMaterial read_contact(const JsonCursor& json);

}  // namespace risorius::softbody
