// SPDX-License-Identifier: MIT
/// \file
/// Matches histograms and amplitude spectra of luminance over a set, see media/luminance_map.h. The maps depend on the renders of all
/// conditions, which are kept until the set is complete.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/media/luminance_map.h"
#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// The group of a clip: clips of a group get the same map. A neutral face is the same in all conditions of a head, and so is its
/// brightness.
std::string map_group(const ClipPlan& clip, design::LuminanceMatch::OneFor one_for);

/// Makes the content of each clip depend on the renders of all conditions. Call it once, when all clips are planned.
void name_maps(BatchPlan& plan);

/// Returns whether all clips are there, so that no map is needed.
bool all_made(const BatchPlan& plan, const std::filesystem::path& folder);

/// Fits the maps and gives them to the clips. All conditions must be rendered. Throws Error when the target cannot be reached.
void fit_maps(const std::filesystem::path& folder, BatchPlan& plan);

/// Measures the shown pictures of a clip beside those before.
class MapReport {
  public:
    /// `face_px`: width of the face. `mapped`: what the clip's map aims at; null: nothing is measured.
    MapReport(const MappedLuminance* mapped, double face_px) : mapped_(mapped), face_px_(face_px) {}
    void add_before(const media::LuminancePlane& plane);
    void add_shown(const media::LuminancePlane& plane);
    Json json() const;

  private:
    const MappedLuminance* mapped_;
    double face_px_;
    int width_px_ = 0, height_px_ = 0;
    media::LuminanceDistribution shown_distribution_;
    media::RingAmplitudes before_, shown_;
};

/// The table of octaves of all clips, luminance/spectrum.tsv.
std::string spectrum_table(const std::vector<Json>& records);

}  // namespace risorius::stimuli
