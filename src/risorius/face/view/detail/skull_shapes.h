// SPDX-License-Identifier: MIT
/// \file
/// The bones of the head as signed distance fields in the standard head. They say what a bone is where the skin says nothing of it.
///
/// Frame: the head frame of the standard head, mm (rigs/standard/landmarks.json). Left and right are symmetric.
/// Numbers: rigs/standard/skull_shapes.json.
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::face {

/// Simple bodies of the left side that the bones are joined from, mm.
struct SkullShapes {
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
    /// One triangle, or two: a, b, c and a, c, d.
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
    std::vector<Vec3>
        body_top;        ///< top of the body of the mandible over each knot of `lower_border`
    double body_radius;  ///< half the thickness of the body of the mandible

    /// The opening of the orbit: a rounded square about `front` that runs in a cone to `back`.
    struct Orbit {
        Vec3 front, back;
        double apex;                     ///< half the width and height at `back`
        double half_width, half_height;  ///< added to `apex` from `back` to `front`
        double squareness;               ///< exponent of the outline; 2: an ellipse
        double tilt;                     ///< the outline falls so much per mm to the side
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
    /// Heights between which the sockets of the teeth stand.
    struct Heights {
        double low, high;
    } upper_sockets, lower_sockets;
    double braincase_floor;  ///< y

    /// How far the joints between two bodies are rounded, named after the body that is joined.
    struct Rounding {
        double braincase_floor, skull_base, mastoid_root, mastoid, nasal_process, alveolar_process,
            cheek_buttress, cheekbone, maxilla, zygomatic_arch, hard_palate, pterygoid_plate,
            nasal_spine, nasal_bone, body, chin, coronoid_process, condyle_neck, condyle, ramus;
    } rounding;
};

/// Throws Error on an unknown or missing key or a value out of range.
SkullShapes read_skull_shapes(const JsonCursor& json);
/// Those of the data folder, read once.
const SkullShapes& standard_skull_shapes();

/// Signed distances to one bone, mm, negative inside. The outer side of a bone is where the tissue over it is as thick as measured, so
/// `outer` and `vault` reach beyond it and are cut off by the thickness.
struct BoneFields {
    double vault;   ///< the braincase
    double temple;  ///< the hollow of the temple in the braincase; positive outside of the hollow
    double outer;   ///< everything else that lies under the skin
    double carved;  ///< orbits, nose, ear canals; positive outside of these hollows
    double inner;   ///< what no skin bounds: tooth sockets, the septum of the nose
};

BoneFields skull_fields(const SkullShapes& shapes, const Vec3& p_mm);
BoneFields mandible_fields(const SkullShapes& shapes, const Vec3& p_mm);

/// Whether a point can be near the nasal bones.
bool near_nasal_bone(const Vec3& p_mm);
/// Signed distance to the nasal bones, the thin roof of the nose, for a point at this depth under the tissue, mm.
double nasal_bone_field(const SkullShapes& shapes, const Vec3& p_mm, double depth_under_tissue_mm);

/// Smooth union and intersection of two fields: min and max, rounded where they differ by less than `round`.
double smooth_union(double a, double b, double round);
double smooth_cut(double a, double b, double round);

}  // namespace risorius::face
