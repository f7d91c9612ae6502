// SPDX-License-Identifier: MIT
/// \file
/// Measures the pictures of a video and draws the sync marks on them.
#pragma once

#include <optional>
#include <vector>

#include "risorius/animate/render_request.h"
#include "risorius/core/image.h"
#include "risorius/media/luminance.h"
#include "risorius/media/sync_marks.h"
#include "risorius/track/script.h"

namespace risorius::animate {

class MarkedPictures {
  public:
    MarkedPictures(const SyncMarks& marks, const track::ScriptDescription& script, int fps);

    /// Measures a picture before it is marked. Pictures must come in order.
    media::PictureMeasures measure(const Image& image) { return meter_.measure(image); }
    /// Whether the square for the photodiode is white in a frame.
    bool lit(int frame) const;
    void mark(int frame, Image& image) const;

  private:
    SyncMarks marks_;
    std::optional<media::Corner> photodiode_, counter_;
    std::vector<int> event_frames_;  ///< first frame at or after the start of each event, ascending
    media::LuminanceMeter meter_;
};

}  // namespace risorius::animate
