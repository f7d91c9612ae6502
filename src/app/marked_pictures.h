// Pictures on their way from the view to the file: measured as they are, then given the marks that were asked for.
#pragma once

#include <optional>
#include <vector>

#include "app/animate.h"
#include "core/image.h"
#include "media/luminance.h"
#include "media/sync_marks.h"
#include "track/script.h"

namespace risorius::app {

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

}  // namespace risorius::app
