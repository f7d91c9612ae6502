// SPDX-License-Identifier: MIT
/// \file
/// The content of a rig file: mesh, roles of the groups of the mesh, landmarks, and the anatomy that moves the face.
/// rigs/README.md describes the format; fields have the names of the JSON keys.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/atlas.h"
#include "risorius/rig/detail/collagen_regions.h"
#include "risorius/rig/detail/solid_muscles.h"
#include "risorius/rig/muscle_table.h"
#include "risorius/track/channels.h"
#include "risorius/track/facs.h"
#include "risorius/track/intensity_curve.h"

namespace risorius::rig {

/// The names of the roles of mesh groups. Groups of `teeth` and `gums_tongue` may hold upper and lower pieces together: the
/// position of each connected piece decides whether it belongs to the skull or the mandible.
const std::vector<std::string_view>& part_roles();

/// A landmark on the mesh of a rig.
struct Landmark {
    int vertex = -1;          ///< of the mesh file, or -1 when xyz is given
    Vec3 xyz = Vec3::Zero();  ///< mesh units
    double confidence = 1;    ///< 0..1, of a landmark that a program has placed
};

/// Motion of the mandible: a rotation about the hinge axis, and a slide of the condyles that grows with the opening.
struct JawDescription {
    /// Point on the axis through both condyles, head frame at atlas size
    Vec3 hinge_mm{0, -4, 13};
    double open_deg = 25.3;            ///< rotation at jaw_open = 1
    Vec3 open_slide_mm{0, -4.8, 3.4};  ///< at jaw_open = 1
    Vec3 forward_mm{0, -2.7, 8.6};     ///< at jaw_forward = 1
    double side_mm = 8.0;              ///< at jaw_side = 1, to the subject's left
};

/// Eyes, and how lids follow the gaze.
struct EyesDescription {
    double gaze_limit_deg = 50;
    double iris_radius_mm = 5.95;
    double pupil_radius_mm = 1.8;
    /// Ratio: turn of the lid over turn of the gaze; the same for the next four
    double upper_lid_per_gaze_down = 0.75;
    double upper_lid_per_gaze_up = 0.48;
    double lower_lid_per_gaze_down = 0.29;
    double lower_lid_per_gaze_up = 0.19;
    double lids_per_gaze_aside = 0.25;
    double upper_lid_per_brow = 0.4;  ///< ratio: the upper lid comes down per way of a lowered brow
    double lower_lid_per_cheek = 0.45;  ///< ratio: the lower lid goes up per way of a raised cheek
    double wide_deg = 11.5;  ///< turn by which a fully active levator raises the upper lid
    /// Fraction of the lid fissure that the upper lid travels when the eye closes; the lower lid travels the rest
    double lid_closed_fraction = 0.96;
};

/// How activation follows excitation in every muscle. The laws are those of muscle/activation.h; time constants come from the
/// muscle table.
struct ActivationDescription {
    std::string law = "thelen2003";  ///< "thelen2003" or "smooth"
    /// For the smooth law: sharpness of the transition between rising and falling activation
    double steepness = 10;
};

/// Soft tissue between skin and bone. The defaults were calibrated on measured expressions.
struct TissueDescription {
    double deep_shear_pa = 910;
    double superficial_shear_pa = 1950;
    double bulk_pa = 88000;
    double density_kg_m3 = 1000;
    double damping_s = 0.008;  ///< stiffness-proportional damping
    /// Stiffness of contact, pressure per depth: deep tissue on bone and teeth, lip on lip, lid on eyeball
    double contact_pa_per_m = 5e6;
    double lid_shear_ratio = 0.12;  ///< shear and bulk modulus of the lids over those of the rest
    /// Shear modulus of lip tissue over that of other tissue; soft lips follow a dropping jaw only at their corners
    double lip_shear_ratio = 0.2;
    double modiolus_shear_ratio = 3.8;
    double crease_shear_ratio = 0.1;  ///< superficial tissue and skin beside the nasolabial fold
    double malar_shear_ratio = 3;     ///< fat pad of the cheek, and the skin over it
    /// Strain at which a relaxed fibre, stretched, pulls with the maximum isometric force
    double fibre_passive_strain = 1.5;
    /// Bundles of fibres: "facial", with calibrated curves and without tendon, or "musculotendon", with the curves of the volume
    /// muscles and the tendon, pennation and length at rest of the muscle table
    std::string bundles = "musculotendon";
    double force_scale = 1.5;  ///< factor of the force of every muscle, in addition to its strength
    std::vector<CollagenRegion> collagen = {};  ///< regions that are stiffer in one direction
};

/// The skin as a membrane.
struct SkinDescription {
    double membrane_n_per_m = 11.4;
    double bending_n_m = 2.9e-5;
    double lid_membrane_ratio = 0.012;
    /// Depth of wrinkles in compressed skin over that of a young adult, 0..10: 0 no wrinkles, 3 an old face
    double wrinkles = 1.0;
};

/// Factors of this head, [0.05, 4]; all are 1 for the standard head. `turn` and `push`: how far orbicularis oris turns and pushes
/// each lip. `puff`: factor of the mouth pressure by which action units puff the cheeks.
struct LipsDescription {
    double upper_turn = 1, lower_turn = 1, upper_push = 1, lower_push = 1, puff = 1;
};

/// Appearance generated for heads without textures of their own; colours are sRGB 0..1. The fields are those of
/// render::Appearance.
struct AppearanceDescription {
    /// "mesh": textures of the mesh's materials where it has them; "generated": never
    std::string textures = "mesh";
    Vec3 skin_tone{0.80, 0.60, 0.50};
    Vec3 lip_tone{0.72, 0.42, 0.40};
    Vec3 hair_tone{0.22, 0.15, 0.10};
    Vec3 iris_tone{0.35, 0.50, 0.60};
    double freckles = 0.15;
    double scalp_hair = 0.6;
    double hairline_mm = 0.0, temples_mm = 0.0;
    double hair_length_mm = 0.0;
    double beard = 0.0;
    double beard_length_mm = 0.0;
    double age = 0.0;
    int seed = 1;
    std::string hair_style = "shaven",
                hairline_form = "even";  ///< names as in render/hair_styles.h
    double lock_length = 1.0, lock_wave = 0.0, fringe = 0.0, parting = 1.0;
    std::optional<double> grey_hair;  ///< share of white hairs; unset: as comes with age
    double age_lines = 0.0;
    std::string beard_form = "stubble";
    double brow_density = 1.0, brow_width = 1.0;
    double skin_gloss = 1.0, complexion = 0.0, mottling = 0.0;
    std::string garment = "none";  ///< names as in render/garments.h
    Vec3 garment_tone{0.30, 0.32, 0.36};
};

/// What `fit` found for an action unit on this head, so that it moves as far and as evenly as facs.json asks.
struct UnitGain {
    double muscles = 1;  ///< factor of the weights of its muscles, [0.05, 20]; weights end at 1
    track::UnitCurves curve;
    double reached = 1;  ///< fraction of the way that facs.json asks for, for reports
};

/// Returns an entry of "unit_gains".
Json unit_gain_json(const UnitGain& gain);

/// Everything that a rig file and its tables say.
struct RigDescription {
    std::string name;
    std::filesystem::path mesh_file;
    double metres_per_unit = 1.0;
    std::map<std::string, std::vector<std::string>> parts;  ///< role -> names of mesh groups
    std::map<std::string, Landmark> landmarks;
    Atlas atlas;  ///< landmarks, thickness, attachments, muscle bands
    MuscleTable muscles;
    std::vector<SolidMuscle> solids;  ///< muscles that are simulated as solids
    LipsDescription lips;
    JawDescription jaw;
    EyesDescription eyes;
    ActivationDescription activation;
    TissueDescription tissue;
    SkinDescription skin;
    track::FacsTable facs;                       ///< with the gains below
    std::map<std::string, UnitGain> unit_gains;  ///< by action unit
    track::Expressions expressions;
    AppearanceDescription appearance;
    std::vector<std::string> notes;                  ///< keys of the file that have been renamed
    std::vector<std::filesystem::path> table_files;  ///< tables that the rig file names

    /// Returns the entry of a muscle in `solids`; null for a muscle that is a bundle of fibres
    const SolidMuscle* solid(const std::string& muscle) const;
    track::ChannelTable channels() const { return muscles.channels(); }
};

/// Reads a rig file and its tables. Throws Error with file, place, and the expected and the found value.
RigDescription read_rig(const std::filesystem::path& file);
/// Reads a rig from JSON in memory. Its relative paths begin at the folder of `json.file()`.
RigDescription read_rig(const JsonCursor& json);

/// Returns a rig file with copies of its tables in place of their paths, and with the defaults of "tissue", "skin" and the anatomy
/// ("strength", "lips", "jaw", "eyes") filled in. Every number of the face is in it. Throws Error.
Json resolved_rig(const std::filesystem::path& file);

/// How a rig is written: with copies of the standard tables (inline_tables), or with the paths of the tables in
/// `standard_folder`. The file is written under a temporary name and then renamed, so that no incomplete file is left.
struct RigWriteOptions {
    std::filesystem::path standard_folder;  ///< folder of muscles.json, facs.json, ...
    bool inline_tables = true;
    /// Where the file will be, when `file` is the path that an OutputSet has given; relative paths begin there.
    std::filesystem::path place{};
};
void write_rig(const RigDescription& rig, const std::filesystem::path& file,
               const RigWriteOptions& options);

/// Reads a landmark file: {"format": "risorius-landmarks", "version": 1, "landmarks": {id: {"vertex": n} | {"xyz": [..]}}}.
/// Throws Error.
std::map<std::string, Landmark> read_landmarks(const std::filesystem::path& file);
std::map<std::string, Landmark> read_landmark_table(JsonCursor table);

}  // namespace risorius::rig
