// SPDX-License-Identifier: MIT
/// \file
/// The contents of a rig file: its mesh, the roles of the mesh's groups, the landmarks, and the anatomy that moves the face.
/// The format is described in rigs/README.md; field names are the JSON keys.
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
#include "risorius/rig/detail/solid_muscles.h"
#include "risorius/rig/muscle_table.h"
#include "risorius/track/channels.h"
#include "risorius/track/facs.h"

namespace risorius::rig {

/// The role of a group of mesh faces. `teeth` and `gums_tongue` groups hold upper and lower pieces together: each connected piece is
/// assigned to the skull or the mandible by its position.
const std::vector<std::string_view>& part_roles();

struct Landmark {
    int vertex = -1;          ///< of the mesh file, or -1 when xyz is given
    Vec3 xyz = Vec3::Zero();  ///< mesh units
};

/// Motion of the mandible: a rotation about the hinge axis plus a slide of the condyles that grows with the opening.
struct JawDescription {
    Vec3 hinge_mm{0, -4, 13};  ///< head frame at atlas size, on the axis through both condyles
    double open_deg = 25.3;    ///< rotation at jaw_open = 1
    Vec3 open_slide_mm{0, -4.8, 3.4};  ///< at jaw_open = 1
    Vec3 forward_mm{0, -2.7, 8.6};     ///< at jaw_forward = 1
    double side_mm = 8.0;              ///< at jaw_side = 1, to the subject's left
};

struct EyesDescription {
    double gaze_limit_deg = 50;
    double iris_radius_mm = 5.95;
    double pupil_radius_mm = 1.8;
    double upper_lid_per_gaze_down = 0.75;  ///< lid angle per gaze angle, ratio
    double upper_lid_per_gaze_up = 0.48;
    double lower_lid_per_gaze_down = 0.29;
    double lower_lid_per_gaze_up = 0.19;
    double lids_per_gaze_aside = 0.25;
    double wide_deg = 11.5;  ///< upper lid raised by a fully active levator
    double lid_closed_fraction =
        0.96;  ///< fraction of the lid fissure that the upper lid travels; the lower lid travels the rest
};

/// How activation follows excitation, for every muscle. The laws are those of muscle/activation.h, the times those of the muscle table.
struct ActivationDescription {
    std::string law = "thelen2003";  ///< or "smooth"
    double steepness =
        10;  ///< of the smooth law: how sharply it changes between rising and falling activation
};

/// Soft tissue between skin and bone. Defaults: face formulation, calibrated on measured expressions.
struct TissueDescription {
    double deep_shear_pa = 910;
    double superficial_shear_pa = 1950;
    double bulk_pa = 22000;
    double density_kg_m3 = 1000;
    double damping_s = 0.008;       ///< stiffness-proportional damping
    double contact_pa_per_m = 5e6;  ///< deep tissue against bone and teeth, lip against lip
    double lid_shear_ratio = 0.12;  ///< lid tissue against the rest
    double lip_shear_ratio =
        0.2;  ///< shear stiffness of lip tissue / that of other tissue; soft lips follow a dropping jaw only at their corners
    double modiolus_shear_ratio = 3.8;
    double crease_shear_ratio = 0.1;  ///< superficial tissue and skin beside the nasolabial fold
    double malar_shear_ratio = 3;     ///< fat pad of the cheekbone, and the skin over it
    double fibre_passive_strain =
        1.5;                   ///< strain at which a relaxed fibre pulls with its isometric force
    double force_scale = 1.5;  ///< factor on the force of every muscle, in addition to its strength
};

struct SkinDescription {
    double membrane_n_per_m = 11.4;
    double bending_n_m = 2.9e-5;
    double lid_membrane_ratio = 0.012;
    double wrinkles =
        1.0;  ///< fraction of the folding that the compressed skin could do; 0: no folds
};

/// Factors of this head, relative to the standard head: how far orbicularis oris turns and pushes the lips, and how much of the mouth
/// pressure of the standard action units puffs the cheeks. [0.05, 4]
struct LipsDescription {
    double upper_turn = 1, lower_turn = 1, upper_push = 1, lower_push = 1, puff = 1;
};

/// Appearance generated for heads without textures of their own; colours sRGB 0..1.
struct AppearanceDescription {
    std::string textures =
        "mesh";  ///< "mesh": pictures of the mesh's materials where it has them; "generated": never
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
};

struct RigDescription {
    std::string name;
    std::filesystem::path mesh_file;
    double metres_per_unit = 1.0;
    std::map<std::string, std::vector<std::string>> parts;  ///< role -> mesh groups
    std::map<std::string, Landmark> landmarks;
    Atlas atlas;  ///< landmarks, thickness, attachments, muscle bands
    MuscleTable muscles;
    std::vector<SolidMuscle> solids;  ///< muscles that are not bundles of fibres
    LipsDescription lips;
    JawDescription jaw;
    EyesDescription eyes;
    ActivationDescription activation;
    TissueDescription tissue;
    SkinDescription skin;
    track::FacsTable facs;
    track::Expressions expressions;
    AppearanceDescription appearance;
    std::vector<std::string> notes;                  ///< keys of the file that have new names
    std::vector<std::filesystem::path> table_files;  ///< files that the rig file names

    const SolidMuscle* solid(const std::string& muscle) const;  ///< null for a bundle of fibres
    track::ChannelTable channels() const { return muscles.channels(); }
};

/// Throws Error that names file, place, the expected and the found value.
RigDescription read_rig(const std::filesystem::path& file);

/// How `fit` writes a rig: with its own copies of the standard tables, or with the paths of those in `standard_folder`. The file is written
/// under another name first and then renamed, so that no incomplete file is left.
struct RigWriteOptions {
    std::filesystem::path standard_folder;  ///< where muscles.json, facs.json, ... are
    bool inline_tables = true;
};
void write_rig(const RigDescription& rig, const std::filesystem::path& file,
               const RigWriteOptions& options);

/// Landmark files: {"format": "risorius-landmarks", "version": 1, "landmarks": {id: {"vertex": n} | {"xyz": [..]}}}.
std::map<std::string, Landmark> read_landmarks(const std::filesystem::path& file);
std::map<std::string, Landmark> read_landmark_table(JsonCursor table);

}  // namespace risorius::rig
