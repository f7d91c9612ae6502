// SPDX-License-Identifier: MIT
/// \file
/// What is drawn: surfaces of one material each over one shared vertex array, and what the materials need to know about the head. Positions
/// change in every frame; everything here is constant.
///
/// Frame: the head frame, metres: origin between the tragia, x to the subject's left, y up, z forward.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

enum class Material {
    kSkin,
    kEye,
    kCornea,
    kTeeth,
    kGums,
    kTongue,
    kMouth,
    kLashes,
    kMatte  ///< a card that measures the light: sends back its share of it evenly
};

struct Surface {
    Material material = Material::kSkin;
    Triangles triangles;        ///< F x 3, into the shared vertices
    TexCoords texcoords;        ///< 3F x 2 per triangle corner, or 0 rows
    int eye = -1;               ///< for kEye and kCornea: 0 left, 1 right
    double reflectance = 0.18;  ///< of kMatte; those of a scene share it
    int texture =
        -1;  ///< into the scene's, for all but kMatte, kCornea and kLashes; -1: generated colours
};

struct Eye {
    Vec3 centre = Vec3::Zero();  ///< of rotation, m, at rest
    double radius_m = 0.0;
    double iris_radius_m = 0.00595;
    double pupil_radius_m = 0.0018;
    Vec3 forward = Vec3::UnitZ();  ///< rest optical axis
};

/// Appearance, generated for any head from its landmarks.
struct Appearance {
    Vec3 skin_tone{0.80, 0.60, 0.50};  ///< sRGB 0..1, average of the cheek
    Vec3 lip_tone{0.72, 0.42, 0.40};
    Vec3 hair_tone{0.22, 0.15, 0.10};  ///< brows, lashes, stubble of the scalp
    Vec3 iris_tone{0.35, 0.50, 0.60};
    double freckles = 0.15;       ///< 0..1
    double scalp_hair = 0.6;      ///< 0..1, short hair painted above the hairline
    double hairline_mm = 0.0;     ///< how much higher the hair of the forehead begins than its mark
    double temples_mm = 0.0;      ///< how much farther it recedes at the temples than between
    double hair_length_mm = 0.0;  ///< of the scalp, standing off the skin; 0: cropped, as painted
    double beard_length_mm = 0.0;  ///< likewise
    double beard = 0.0;            ///< 0..1, from none over a shadow to a few days' growth
    double age =
        0.0;  ///< 0..1, young to old: spots, thinner redness, paler lips, dry skin, grey hair
    unsigned seed = 1;
};

/// A muscle below the skin, a closed surface.
struct Muscle {
    std::string name;
    int side = -1;        ///< 0 left, 1 right, -1 across the midline
    Triangles triangles;  ///< F x 3, into the muscles' own vertices, counter-clockwise from outside
};

/// Seen with Show::kMuscles, over a vertex array of their own.
struct Muscles {
    std::vector<Muscle> parts;
    Points rest;                 ///< M x 3, m, head frame
    TexCoords fibre;             ///< M x 2, along and across the fibres at rest, m
    std::vector<double> tendon;  ///< M, 0 flesh, 1 tendon
};

/// Skull and mandible, seen with Show::kSkull, over a vertex array of their own.
struct Bones {
    Points rest;               ///< B x 3, m, head frame
    Triangles triangles;       ///< counter-clockwise from outside
    std::vector<double> open;  ///< B, 0..1: how much of the surroundings is seen
};

struct Scene {
    Points rest;  ///< V x 3, m, head frame
    Points
        shut;  ///< V x 3, or no rows: with the eyes shut, for the shade on lids that have unrolled from their crease
    std::vector<Surface> surfaces;
    std::vector<Image>
        textures;  ///< sRGB, alpha is not looked at; (0, 0) of texture coordinates is below, left
    std::map<std::string, Vec3> landmarks;  ///< rest, m; ids of rigs/standard/landmarks.json
    std::array<Eye, 2> eyes;                ///< left, right
    Appearance appearance;
    Points
        fold_phase;  ///< V x 3, or no rows for a skin that never folds: up to three sets of wrinkles at a place
    Muscles muscles;  ///< none unless they are shown
    Bones bones;      ///< likewise
};

/// Whether the skin's colour is a picture of the mesh's, which then shows brows, beard and the hair of the scalp too.
bool has_own_skin(const Scene& scene);

/// A quantity on the skin, shown as colour in place of the skin's own, with a scale in the upper left corner.
struct SkinValues {
    std::string name, unit;   ///< "error", "mm"
    double from = 0, to = 1;  ///< beyond, the colours are those of the ends; see value_colour.h
    std::vector<double> at;   ///< V; grey where it is not a number
};

/// What changes from frame to frame.
struct Pose {
    Points positions;  ///< V x 3, m, world = head frame at rest
    std::array<Mat3, 2> eye_rotation{Mat3::Identity(), Mat3::Identity()};  ///< world from rest eye
    double jaw_open = 0.0;            ///< ratio, darkens or lights the mouth
    Points fold_depth;                ///< V x 3, m, of the wrinkles along fold_phase; no rows: none
    Points muscle_positions;          ///< M x 3, m; with the next: only read when muscles are shown
    std::vector<double> activations;  ///< per muscle of the scene, ratio
    Points bone_positions;            ///< B x 3, m; only read when bones are shown
    std::optional<SkinValues> values;  ///< of this frame; any view shows them
};

}  // namespace risorius::render
