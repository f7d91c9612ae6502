// SPDX-License-Identifier: MIT
/// \file
/// The globe, and the surface that lids must not enter. Sizes: schematic eye (axial length 24.0 mm, cornea 7.8 mm). The centre of rotation
/// lies 12.5 mm behind the apex of the cornea; pupils are 63 mm apart.
#pragma once

#include "risorius/geom/polygon_mesh.h"

namespace risorius::headmodel {

/// Sclera sphere and corneal cap; both spheres meet at the limbus. Lengths in mm.
struct Globe {
    Vec3 centre{31.5, 18.2, 73.2};  ///< centre of rotation, left
    double sclera_radius = 11.5;
    double cornea_radius = 7.8;
    double cornea_centre = 4.7;  ///< in front of the centre: apex 12.5, axial length 24.0

    /// Distance from the centre to the surface at the angle whose cosine to the optical axis is given.
    double radius_at(double cosine) const;
};

/// Returns an eyeball as a mesh of rings about the optical axis, with a pole in front. `side`: +1 left, -1 right.
geom::PolygonMesh globe_mesh(const Globe& globe, double side, const std::string& group);

}  // namespace risorius::headmodel
