// SPDX-License-Identifier: MIT
/// \file
/// Description of what is drawn: surfaces, each of one material, over one shared vertex array, and what the materials need to
/// know about the head. Everything in a Scene is constant; a Pose holds what changes from frame to frame.
///
/// A fold, in the names of this folder, is a wrinkle of the skin that is finer than the mesh. The shaders draw it from a phase
/// (where it lies) and a depth (how far the skin is pushed in).
///
/// Head frame, m: origin between the tragia, x to the subject's left, y up, z forward.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

/// What a surface is made of.
enum class Material {
    kSkin,
    kEye,
    kCornea,
    kTeeth,
    kGums,
    kTongue,
    kMouth,
    kLashes,
    kMatte  ///< a card for light measurements: a diffuse reflector
};

/// Triangles of one material.
struct Surface {
    Material material = Material::kSkin;
    Triangles triangles;        ///< F x 3, into the shared vertices
    TexCoords texcoords;        ///< 3F x 2, one row per triangle corner, or 0 rows
    int eye = -1;               ///< for kEye and kCornea: 0 left, 1 right
    double reflectance = 0.18;  ///< of kMatte; all such surfaces of a scene have the same
    /// Index into the textures of the scene, not used by kMatte, kCornea and kLashes; -1: generated colours
    int texture = -1;
};

/// An eyeball.
struct Eye {
    Vec3 centre = Vec3::Zero();  ///< centre of rotation, m, at rest
    double radius_m = 0.0;
    double iris_radius_m = 0.00595;
    double pupil_radius_m = 0.0018;
    Vec3 forward = Vec3::UnitZ();  ///< optical axis at rest
};

/// Appearance that is generated for any head from its landmarks.
struct Appearance {
    Vec3 skin_tone{0.80, 0.60, 0.50};  ///< sRGB 0..1, mean of the cheek
    Vec3 lip_tone{0.72, 0.42, 0.40};
    Vec3 hair_tone{0.22, 0.15, 0.10};  ///< brows, lashes, stubble on the scalp
    Vec3 iris_tone{0.35, 0.50, 0.60};
    double freckles = 0.15;    ///< 0..1
    double scalp_hair = 0.6;   ///< 0..1, short hair painted above the hairline
    double hairline_mm = 0.0;  ///< upward shift of the hairline on the forehead from its landmark
    double temples_mm = 0.0;   ///< further recession at the temples
    /// Hair on the scalp that stands off the skin; 0: cropped, painted only
    double hair_length_mm = 0.0;
    double beard_length_mm = 0.0;  ///< the same for the beard
    double beard = 0.0;            ///< 0..1: from none over a shadow to the growth of a few days
    /// 0..1, young to old: spots, less redness, paler lips, dry skin, grey hair
    double age = 0.0;
    unsigned seed = 1;
    /// A name of hair_style_names(): locks over the scalp; "shaven" has none
    std::string hair_style = "shaven";
    double lock_length = 1.0;  ///< length of the locks as a multiple of the style's
    double lock_wave = 0.0;    ///< 0..1, waves beside those of the style
    /// 0..1, how far the locks of bob and short_parted cover the forehead; 1: to the brows
    double fringe = 0.0;
    /// Place of the parting as a multiple of the style's; below 0: on the other side
    double parting = 1.0;
    std::string hairline_form = "even";  ///< a name of hairline_form_names()
    double age_lines = 0.0;              ///< 0..1, strength of the lines that come with age
    std::optional<double> grey_hair;     ///< 0..1, share of white hairs; unset: as comes with age
    /// A name of beard_form_names(): where a beard grows, and whether it is cut at the skin ("stubble") or trimmed
    std::string beard_form = "stubble";
    double brow_density = 1.0;  ///< hairs of the brows as a multiple of the usual number
    double brow_width = 1.0;    ///< height of the brows as a multiple of the usual one
    /// 0..2, what the skin mirrors as a multiple of the usual: powdered to oily
    double skin_gloss = 1.0;
    /// 0..2, how much of what `seed` draws beside the tones is seen: shade around the eyes, redness, lips, brows, lashes, moles
    double complexion = 0.0;
    double mottling = 0.0;         ///< 0..1, how uneven the colour of the skin is
    std::string garment = "none";  ///< a name of garment_names(): what the shoulders wear
    Vec3 garment_tone{0.30, 0.32, 0.36};
};

/// A muscle below the skin: a closed surface.
struct Muscle {
    std::string name;
    int side = -1;        ///< 0 left, 1 right, -1 across the midline
    Triangles triangles;  ///< F x 3, into the vertices of Muscles, counter-clockwise from outside
};

/// Muscles over a vertex array of their own; drawn with Show::kMuscles.
struct Muscles {
    std::vector<Muscle> parts;
    Points rest;                 ///< M x 3, m, head frame
    TexCoords fibre;             ///< M x 2, along and across the fibres at rest, m
    std::vector<double> tendon;  ///< M, 0 muscle, 1 tendon
};

/// Skull and mandible over a vertex array of their own; drawn with Show::kSkull.
struct Bones {
    Points rest;               ///< B x 3, m, head frame
    Triangles triangles;       ///< counter-clockwise from outside
    std::vector<double> open;  ///< B, 0..1: fraction of the surroundings that the vertex sees
};

/// Everything that stays the same from frame to frame.
struct Scene {
    Points rest;  ///< V x 3, m, head frame
    /// V x 3, or no rows: positions with closed eyes, used to shade the part of the lids that unrolls from the crease
    Points shut;
    std::vector<Surface> surfaces;
    /// sRGB; alpha is ignored. Texture coordinates (0, 0) are the lower left corner
    std::vector<Image> textures;
    std::map<std::string, Vec3> landmarks;  ///< rest, m; ids of rigs/standard/landmarks.json
    std::array<Eye, 2> eyes;                ///< left, right
    Appearance appearance;
    /// V x 3, or no rows for skin without wrinkles. Column k: phase of the k-th of up to three sets of wrinkles
    Points fold_phase;
    Muscles muscles;  ///< empty unless they are shown
    Bones bones;      ///< empty unless they are shown
};

/// Whether the skin is coloured by a texture of the mesh, which then also shows brows, beard and scalp hair.
bool has_own_skin(const Scene& scene);

/// A quantity that colours the skin, with a scale in the upper left corner of the picture.
struct SkinValues {
    std::string name, unit;  ///< "error", "mm"
    /// Range of the scale; values outside are clamped, see value_colour.h
    double from = 0, to = 1;
    std::vector<double> at;  ///< V; NaN is drawn grey
};

/// What changes from frame to frame.
struct Pose {
    Points positions;  ///< V x 3, m, world; equal to the head frame at rest
    /// Rotation from the rest pose of the eye to the world
    std::array<Mat3, 2> eye_rotation{Mat3::Identity(), Mat3::Identity()};
    double jaw_open = 0.0;  ///< 0..1; gives the gap of the lips on a head without lip landmarks
    /// V x 3, m, depth of the three sets of wrinkles of Scene::fold_phase; no rows: no wrinkles
    Points fold_depth;
    /// M x 3, m; this and activations are read only when muscles are shown
    Points muscle_positions;
    std::vector<double> activations;   ///< per muscle of the scene, 0..1
    Points bone_positions;             ///< B x 3, m; read only when bones are shown
    std::optional<SkinValues> values;  ///< values of this frame; any view shows them
};

}  // namespace risorius::render
