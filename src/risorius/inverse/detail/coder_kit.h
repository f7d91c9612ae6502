// SPDX-License-Identifier: MIT
/// \file
/// A kit for coders of FACS. Clips without names show single units at full and half intensity, common combinations, and faces that do
/// nothing, in a random order. Coders write down what they see; code_agreement.h compares it with what was shown.
///
///   kit/clips/clip_001.mp4 ...  neutral, the units, neutral again: 0.5 s each; 384 x 384 pixels, 30 frames per second
///   kit/sheet.tsv               clip, codes (empty: for the coder), note
///   kit/README.txt              what the coder is asked to do
///   key.tsv                     clip, codes: what was shown; not for coders
///
/// Codes are written as usual: units joined by "+", with L or R before the number for one side, and A to E behind it for the intensity,
/// such as "1C+2C", "R12B" or "0" for a face that does nothing. The units of a clip have intensity 1 (E) or .5 (C).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/render/scene.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/facs.h"

namespace risorius::inverse {

/// A clip of the kit.
struct KitClip {
    std::vector<std::string> units;  ///< ids of the table; empty: a face that does nothing
    double intensity = 1;
    std::string codes() const;  ///< "1E+2E", "0"
};

/// Returns the clips for these units and the combinations of them, in the order of the seed.
std::vector<KitClip> kit_clips(const track::FacsTable& facs, const std::vector<std::string>& units,
                               std::uint64_t seed);

/// Writes kit/ and key.tsv into the folder, and returns the names of the files.
std::vector<std::string> write_coder_kit(face::Face& face, const rig::RigDescription& rig,
                                         const render::Scene& scene,
                                         const std::vector<KitClip>& clips,
                                         const std::filesystem::path& folder,
                                         const ProgressMonitor& monitor);

}  // namespace risorius::inverse
