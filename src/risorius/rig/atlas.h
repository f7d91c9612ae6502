// SPDX-License-Identifier: MIT
/// \file
/// The standard anatomy from which every head is rigged, in the frame and size of one average adult head: 109 landmarks, soft-tissue
/// thickness, attachment stiffness, and the muscles of expression as bands given relative to landmarks.
///
/// Frame: origin midway between the tragia, x to the subject's left, y up, z forward, Frankfurt horizontal. m, N, Pa/m.
/// Sources: rigs/standard/*.json, each with its own.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/rig/wrinkle_table.h"

namespace risorius::rig {

struct AtlasLandmark {
    std::string id;
    std::string name;
    Vec3 position;  ///< m
    bool core = true;
    std::string region;  ///< brow, eye, nose, lip, cheek...
};

/// A sample of the thickness of the tissue, at a landmark or at an offset from it.
struct ThicknessSample {
    std::string landmark;
    Vec3 offset;         ///< from the landmark, m
    double thickness_m;  ///< skin to bone
};

struct AttachmentSample {
    std::string landmark;
    double normal_pa_per_m;      ///< resistance to being lifted off the bone, per area
    double tangential_pa_per_m;  ///< resistance to sliding, per area
};

enum class Body { kSkull, kMandible, kSoft, kNeck };

struct BandPoint {
    std::string landmark;
    Vec3 offset;  ///< m, at atlas size
    double depth =
        0.5;  ///< depth / tissue thickness; 1 is the bone; < 0: the point lies on the mucosa and is used as given
};

/// A sheet of parallel fibres along a path, left side; a band that names right landmarks crosses the midline.
struct MuscleBand {
    std::string muscle;
    double width_m;
    double force_n;  ///< isometric force of this side, shared by the muscle's bands
    double strength =
        1.0;  ///< calibration factor of the force, so that activation 1 shortens the band to `shortens_to`
    double shortens_to =
        0.72;  ///< mean fibre length / rest length when this muscle alone has activation 1
    std::vector<BandPoint> points;
    Body origin = Body::kSkull;
    Body insertion = Body::kSoft;
    std::string origin_attach, insertion_attach;
    bool crosses_midline() const;
};

struct Atlas {
    std::vector<AtlasLandmark> landmarks;
    std::vector<ThicknessSample> thickness;
    std::vector<AttachmentSample> attachments;
    std::vector<MuscleBand> bands;
    std::vector<WrinklePattern> wrinkles;

    const AtlasLandmark* landmark(const std::string& id) const;  ///< null when unknown
    std::vector<std::string> landmark_ids() const;
};

std::vector<AtlasLandmark> read_atlas_landmarks(JsonCursor json);
std::vector<ThicknessSample> read_thickness(JsonCursor json);
std::vector<AttachmentSample> read_attachments(JsonCursor json);
std::vector<MuscleBand> read_muscle_bands(JsonCursor json);

/// "ch_l" -> "ch_r" and back. The id of a landmark of the midline is returned unchanged.
std::string mirrored_landmark(const std::string& id);
/// The band mirrored to the right side.
MuscleBand mirrored(const MuscleBand& band);

}  // namespace risorius::rig
