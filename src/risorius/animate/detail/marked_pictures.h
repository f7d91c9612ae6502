// Pictures on their way from the view to the file: measured as they are, then given the marks that were asked for.
#pragma once

#include <optional>
#include <vector>

#include "risorius/animate/animate.h"
#include "risorius/core/image.h"
#include "risorius/media/luminance.h"
#include "risorius/media/sync_marks.h"
#include "risorius/track/script.h"

namespace risorius::animate {

class MarkedPictures {
  public:
    MarkedPictures(const SyncMarks& marks, const track::ScriptDescription& script, int fps);

    /// Of every picture in order.
    media::PictureMeasures measure(const Image& image) { return meter_.measure(image); }
    /// Whether the photodiode's square is white in a frame.
    bool lit(int frame) const;
    void mark(int frame, Image& image) const;

  private:
    SyncMarks marks_;
    std::optional<media::Corner> photodiode_, counter_;
    std::vector<int>
        event_frames_;  ///< the first frame at or after the begin of an event, ascending
    media::LuminanceMeter meter_;
};

}  // namespace risorius::animate
