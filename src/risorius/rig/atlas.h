// SPDX-License-Identifier: MIT
/// \file
/// The standard anatomy that every rig starts from, in the frame and size of one average adult head: 109 landmarks, the thickness
/// of soft tissue, the stiffness of its attachments to bone, and the muscles of expression as bands between landmarks.
///
/// Frame: origin midway between the tragia, x to the subject's left, y up, z forward, Frankfurt horizontal. m, N, Pa/m.
/// Sources: see the files rigs/standard/*.json.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/rig/wrinkle_table.h"

namespace risorius::rig {

/// A landmark on the atlas head.
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

/// A sample of the stiffness with which tissue is attached to bone, at a landmark.
struct AttachmentSample {
    std::string landmark;
    /// Stiffness against being lifted off the bone: pressure per displacement
    double normal_pa_per_m;
    /// Stiffness against sliding along the bone: shear stress per displacement
    double tangential_pa_per_m;
};

/// The body that the end of a muscle band moves with.
enum class Body { kSkull, kMandible, kSoft, kNeck };

/// A point of a muscle band.
struct BandPoint {
    std::string landmark;
    Vec3 offset;  ///< m, at atlas size
    /// Depth below the skin as a fraction of the tissue thickness: 0 skin, 1 bone. Negative: the point lies on the mucosa, and
    /// its position is used as given.
    double depth = 0.5;
};

/// A muscle band: a sheet of parallel fibres along a path on the left side. A band that also names landmarks of the right side
/// crosses the midline.
struct MuscleBand {
    std::string muscle;
    double width_m;
    /// Maximum isometric force of the muscle on this side; all bands of the muscle together have it
    double force_n;
    /// Calibration factor of the force: with it, activation 1 shortens the band to `shortens_to`
    double strength = 1.0;
    /// Mean fibre length over rest length when only this muscle is active, with activation 1
    double shortens_to = 0.72;
    std::vector<BandPoint> points;
    Body origin = Body::kSkull;
    Body insertion = Body::kSoft;
    std::string origin_attach, insertion_attach;
    bool crosses_midline() const;
};

/// All tables of the standard anatomy.
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

/// Returns the id of the landmark on the other side: "ch_r" for "ch_l" and the other way round. The id of a landmark of the
/// midline is returned unchanged.
std::string mirrored_landmark(const std::string& id);
/// Returns the band mirrored to the right side.
MuscleBand mirrored(const MuscleBand& band);

}  // namespace risorius::rig
