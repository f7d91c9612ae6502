// The standard anatomy every head is rigged from, in the frame and size of one average adult head:
// 109 landmarks, soft-tissue thickness, attachment stiffness, and the mimetic muscles as bands in landmark terms.
//
// Frame: origin midway between the tragia, x to the subject's left, y up, z forward, Frankfurt horizontal. m, N, Pa/m.
// Sources: rigs/standard/*.json, each with its own.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::rig {

struct AtlasLandmark {
    std::string id;
    std::string name;
    Vec3 position;  ///< m
    bool core = true;
    std::string region;  ///< brow, eye, nose, lip, cheek...
};

/// A thickness or stiffness sample: a landmark, or a point given beside one.
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
        0.5;  ///< ratio of the tissue thickness, 1 = bone; < 0: on the mucosa, taken as it is
};

/// A sheet of parallel fibres along a path, left side; a band that names right landmarks crosses the midline.
struct MuscleBand {
    std::string muscle;
    double width_m;
    double force_n;         ///< isometric force of this side, shared by the muscle's bands
    double strength = 1.0;  ///< calibration: activation 1 shortens as it should
    double shortens_to =
        0.72;  ///< mean fibre length / rest length at activation 1, the muscle alone
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

    const AtlasLandmark* landmark(const std::string& id) const;  ///< null when unknown
};

std::vector<AtlasLandmark> read_atlas_landmarks(JsonCursor json);
std::vector<ThicknessSample> read_thickness(JsonCursor json);
std::vector<AttachmentSample> read_attachments(JsonCursor json);
std::vector<MuscleBand> read_muscle_bands(JsonCursor json);

/// "ch_l" -> "ch_r" and back; midline ids are their own mirror.
std::string mirrored_landmark(const std::string& id);
/// The band of the right side.
MuscleBand mirrored(const MuscleBand& band);

}  // namespace risorius::rig
