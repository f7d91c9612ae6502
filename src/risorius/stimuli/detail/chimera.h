// SPDX-License-Identifier: MIT
/// \file
/// Chimeric clips: the upper half of one face over the lower half of another [Calder2000]. The seam is a
/// line across the picture, half-way between nasion and subnasale of the upper half's first frame. Over `kSoft` of the width of the face the
/// one half goes over into the other, in sRGB; beside the lower half, where it is shifted, is the background.
#pragma once

#include <string>
#include <vector>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/image.h"
#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/stimuli/detail/seen_motion.h"

namespace risorius::stimuli {

/// Combines the frames of two halves.
class Chimera {
  public:
    /// `upper`: the table of the upper half; `lower`: the frames of the lower one. Throws Error naming the clip when the rig has no such
    /// landmarks.
    Chimera(const ClipPlan& plan, const animate::FrameRows& upper, std::vector<Image> lower);

    /// Puts the lower half of a frame into the picture of the upper one, and measures the seam.
    void combine(int frame, Image& upper);

    /// Returns the seam for the sidecar: `row_px`, `height_px`, `offset_px`, and `difference`, the root mean square difference of
    /// relative luminance between the two faces in the rows that they share: mean over the frames, and the largest.
    Json json() const;

    /// Returns the landmarks that the lower or the upper half shows. `upper`: the table of the upper half.
    LandmarkChoice landmarks(const animate::FrameRows& upper, bool of_lower) const;

    /// Returns the table of the upper half with landmarks below the seam from that of the lower one.
    animate::FrameRows rows(const animate::FrameRows& upper, const animate::FrameRows& lower) const;

  private:
    bool is_lower(const animate::FrameRows& upper, const std::string& id) const;
    double weight_of_lower(int y) const;
    void measure(const Image& upper, const Image& lower);

    std::vector<Image> lower_;
    std::array<std::uint8_t, 4> background_{};  ///< beside a lower half that is shifted
    double row_px_ = 0, height_px_ = 0;
    int offset_px_ = 0;
    std::vector<double> differences_;
};

}  // namespace risorius::stimuli
