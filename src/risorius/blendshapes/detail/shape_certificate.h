// What a blend shape is worth as physics, measured on the pose it was made from and on the mesh it leaves: is tissue kept, does
// anything pass through anything, do eyes close, are both sides alike.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/shape_measures.h"
#include "risorius/core/json_cursor.h"

namespace risorius::blendshapes {

/// What a certificate has to stay within.
struct ShapeLimits {
    double volume_ratio = 0.02;     ///< change of the tissue's volume
    double penetration_m = 0.3e-3;  ///< lip in lip, skin in eye
    double lid_gap_m = 0.3e-3;      ///< left open by a blink
    double asymmetry_m = 0.2e-3;    ///< on a head that is its own mirror image
};

struct ShapeCertificate {
    double volume_change = 0;           ///< ratio, of all tissue
    double lip_depth_m = 0;             ///< deepest penetration of lip in lip, beyond that at rest
    double bone_depth_m = 0;            ///< of tissue in bone and teeth, whose surfaces are guessed
    double eye_depth_m = 0;             ///< of skin in the eyes
    std::optional<double> lid_gap_m;    ///< of shapes that shut the eye
    std::optional<double> lip_gap_m;    ///< of shapes that shut the mouth over an open jaw
    std::optional<double> asymmetry_m;  ///< of a shape, or of it and its namesake
    /// The same before both were made mirror images of each other: large where lips have buckled to one side.
    std::optional<double> asymmetry_as_solved_m;
    blendshapes::Stretch stretch;  ///< of the simulated skin
    double peak_m = 0;             ///< largest displacement
    int moved_vertices = 0;
    bool converged = true;
    int inverted_tets = 0;

    /// What is beyond its limit, in words; nothing when all is well.
    std::vector<std::string> complaints(const ShapeLimits& limits = {}) const;
    Json json() const;  ///< lengths in mm
};

}  // namespace risorius::blendshapes
