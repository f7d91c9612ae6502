// SPDX-License-Identifier: MIT
/// \file
/// Environment light for shaders: irradiance on a matt surface (spherical harmonics), and reflections in glossy surfaces.
///
/// Sources: Ramamoorthi and Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps; Karis 2013, Real Shading
/// in Unreal Engine 4 (surroundings are blurred in advance by the lobe of each roughness).
#pragma once

#include <array>
#include <functional>

#include "risorius/core/types.h"
#include "risorius/render/detail/gl.h"
#include "risorius/render/detail/light.h"

namespace risorius::render {

/// Radiance that arrives from a unit direction in the head frame.
using Radiance = std::function<Vec3(const Vec3& from)>;

/// Samples `radiance` into a map of `height` rows and twice as many columns.
Surroundings sampled(const Radiance& radiance, int height);
/// Returns the unit direction from the head to the centre of a cell.
Vec3 cell_direction(const Surroundings& map, int row, int column);
/// Returns the solid angle of each cell of a row, sr.
double cell_solid_angle(const Surroundings& map, int row);
/// A lamp in the surroundings.
struct Lamp {
    Vec3 direction = Vec3::UnitZ();
    /// Irradiance of a card that faces the lamp, over pi: the radiance of the card if it is white
    Vec3 card = Vec3::Zero();
};
/// Removes the brightest lamp from the map and returns it.
Lamp take_brightest(Surroundings& map);

/// Coefficients c such that the radiance of a matt white surface with normal (x, y, z) is, per colour channel, c0 + c1 x + c2 y +
/// c3 z + c4 xy + c5 yz + c6 (3 z^2 - 1) + c7 xz + c8 (x^2 - y^2).
using Irradiance = std::array<Vec3, 9>;
Irradiance irradiance_of(const Surroundings& map);
Vec3 irradiance_at(const Irradiance& irradiance, const Vec3& normal);

/// Roughness of each layer of the mirror texture, for the GGX reflection model, whose parameter alpha is the square of the
/// roughness.
constexpr std::array<double, 4> kMirrorRoughness{0.08, 0.25, 0.45, 0.70};

/// Makes a texture array for reflections: 64 x 32 cells, one layer for each value of kMirrorRoughness. `exposure`: factor per
/// channel, see exposure_for(). The context must be current.
GLuint mirror_texture(const Surroundings& map, const Vec3& exposure);

}  // namespace risorius::render
