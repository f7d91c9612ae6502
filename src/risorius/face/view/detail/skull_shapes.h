// SPDX-License-Identifier: MIT
/// \file
/// The bones of the head as signed distance fields in the standard head. They give the shape of bone where
/// it cannot be estimated from the skin.
///
/// Frame: the head frame of the standard head, mm (rigs/standard/landmarks.json). Left and right are symmetric.
/// Numbers: rigs/standard/skull_shapes.json.
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::face {

/// Simple shapes of which the bones are composed, on the left side, mm.
struct SkullShapes {
    /// A ball; a list of knots is a chain of rods.
    struct Knot {
        Vec3 at;
        double radius;
    };
    /// A rod whose radius varies linearly between its ends.
    struct Rod {
        Knot from, to;
    };
    struct Ellipsoid {
        Vec3 centre, radii;
    };
    /// One triangle with corners a, b, c, or two: a, b, c and a, c, d. It is thickened by `radius`.
    struct Plate {
        std::vector<Vec3> corners;
        double radius = 0;
    };
    std::vector<Knot> upper_rim, lower_rim, nasal_process, zygomatic_arch, upper_arch, lower_arch,
        lower_border;
    Ellipsoid braincase, skull_base, mastoid, mastoid_root, temple, maxilla, alveolar_process,
        cheekbone, hard_palate, chin;
    Rod cheek_buttress, ear_canal, nasal_spine, lower_concha, middle_concha, coronoid_process,
        condyle_neck, condyle;
    Plate pterygoid_plate, nasal_septum, ramus_lower, ramus_upper;
    /// Top of the body of the mandible over each knot of `lower_border`.
    std::vector<Vec3> body_top;
    double body_radius;  ///< half the thickness of the body of the mandible

    /// The hollow of the orbit: a cone whose section is a rounded square, from `front` to `back`.
    struct Orbit {
        Vec3 front, back;
        double apex;                     ///< half the width and height at `back`
        double half_width, half_height;  ///< added to `apex` from `back` to `front`
        double squareness;               ///< exponent of the outline; 2: an ellipse
        double tilt;                     ///< the outline falls by this many mm per mm to the side
    } orbit;
    /// The opening of the nose: a pear between two circles, from its floor upwards.
    Rod nose_opening;
    double nose_opening_back;  ///< z where the opening ends
    /// The nasal bones: a plate of even thickness under the tissue, cut by planes.
    struct NasalBone {
        double thickness;
        double lower_edge,
            edge_slope;  ///< height of the free edge in the midline; how it rises to the side
        double top, half_width, back;  ///< y, x, z where the plate ends
    } nasal_bone;
    /// Heights between which the tooth sockets lie.
    struct Heights {
        double low, high;
    } upper_sockets, lower_sockets;
    double braincase_floor;  ///< y

    /// Radius to which the joint between two shapes is rounded. It is named after the shape that is added.
    struct Rounding {
        double braincase_floor, skull_base, mastoid_root, mastoid, nasal_process, alveolar_process,
            cheek_buttress, cheekbone, maxilla, zygomatic_arch, hard_palate, pterygoid_plate,
            nasal_spine, nasal_bone, body, chin, coronoid_process, condyle_neck, condyle, ramus;
    } rounding;
};

/// Throws Error on an unknown or missing key or a value out of range.
SkullShapes read_skull_shapes(const JsonCursor& json);
/// Returns the shapes in the data folder, which are read once.
const SkullShapes& standard_skull_shapes();

/// Signed distances to the parts of skull or mandible, mm, negative inside. The outer side of a bone lies where the tissue over it is as
/// thick as measured. So `outer` and `vault` reach beyond that side, and the caller cuts them off there.
struct BoneFields {
    double vault;   ///< the braincase
    double temple;  ///< the hollow of the temple in the braincase; positive outside of the hollow
    double outer;   ///< everything else that lies under the skin
    double carved;  ///< orbits, nose, ear canals; positive outside of these hollows
    double inner;   ///< parts that no skin covers: tooth sockets, the septum of the nose
};

BoneFields skull_fields(const SkullShapes& shapes, const Vec3& p_mm);
BoneFields mandible_fields(const SkullShapes& shapes, const Vec3& p_mm);

/// Returns whether a point can be near the nasal bones.
bool near_nasal_bone(const Vec3& p_mm);
/// Returns the signed distance to the nasal bones, the thin roof of the nose, mm, for a point at this depth below the inner side of the
/// tissue.
double nasal_bone_field(const SkullShapes& shapes, const Vec3& p_mm, double depth_under_tissue_mm);

/// Return the smooth union and intersection of two fields: min and max, rounded where the fields differ by less than `round`, mm.
double smooth_union(double a, double b, double round);
double smooth_cut(double a, double b, double round);

}  // namespace risorius::face
