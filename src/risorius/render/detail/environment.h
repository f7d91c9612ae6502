// SPDX-License-Identifier: MIT
/// \file
/// Environment light for shaders: irradiance on a matt surface (spherical harmonics), and reflections of glossy ones.
///
/// Sources: Ramamoorthi and Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps; Karis 2013, Real Shading
/// in Unreal Engine 4 (surroundings blurred beforehand by the lobe of a roughness).
#pragma once

#include <array>
#include <functional>

#include "risorius/core/types.h"
#include "risorius/render/detail/gl.h"
#include "risorius/render/detail/light.h"

namespace risorius::render {

/// Radiance from a direction, unit, frame of the head.
using Radiance = std::function<Vec3(const Vec3& from)>;

/// Cells of `radiance`, height rows and twice as many columns.
Surroundings sampled(const Radiance& radiance, int height);
/// Direction of the middle of a cell.
Vec3 cell_direction(const Surroundings& map, int row, int column);
/// Of a cell, sr.
double cell_solid_angle(const Surroundings& map, int row);
/// Removes the brightest lamp from the map: its direction, and the light of a white card that faces it, divided by pi as for Irradiance.
struct Lamp {
    Vec3 direction = Vec3::UnitZ();
    Vec3 card = Vec3::Zero();  ///< as a white card that faces it shines
};
Lamp take_brightest(Surroundings& map);

/// Coefficients such that a matt white surface with normal (x, y, z) shines with
/// c0 + c1 x + c2 y + c3 z + c4 xy + c5 yz + c6 (3 z^2 - 1) + c7 xz + c8 (x^2 - y^2).
using Irradiance = std::array<Vec3, 9>;
Irradiance irradiance_of(const Surroundings& map);
Vec3 irradiance_at(const Irradiance& irradiance, const Vec3& normal);

/// Layers of the mirror texture by roughness (of GGX, alpha is its square).
constexpr std::array<double, 4> kMirrorRoughness{0.08, 0.25, 0.45, 0.70};

/// A texture array of 64 x 32 cells, one layer per roughness. The context must be current.
GLuint mirror_texture(const Surroundings& map, const Vec3& exposure);

}  // namespace risorius::render
