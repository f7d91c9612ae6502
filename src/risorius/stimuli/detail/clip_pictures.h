// The pictures of a film on their way into a clip: matched, shown as the control wants it, measured, marked.
#pragma once

#include <optional>
#include <vector>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/image.h"
#include "risorius/media/luminance.h"
#include "risorius/media/phase_scramble.h"
#include "risorius/media/sha256.h"
#include "risorius/media/tone.h"
#include "risorius/media/video_writer.h"
#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

/// Whether the control's pictures wait for the last frame of the film.
bool shows_other_order(design::ControlKind kind);
bool shows_part(design::ControlKind kind);

class ClipPictures {
  public:
    ClipPictures(const ClipPlan& plan, media::VideoWriter& video);

    /// In the order of the film.
    void take(Image image);
    /// What had to wait for all that is known in the end.
    void finish(const animate::FrameRows& rows, const std::vector<int>& order);

    /// A few frames over the length of the clip, side by side.
    Image strip() const;
    std::string sha256() { return hash_.finish(); }

    /// Of every frame as it is shown, without marks; empty when the film's own measures are right.
    const std::vector<media::PictureMeasures>& measures() const { return measures_; }

  private:
    void write(Image image);

    const ClipPlan& plan_;
    design::ControlKind kind_;
    std::optional<media::ToneCurve> tone_;
    media::VideoWriter& video_;
    bool later_, measured_;
    std::optional<media::PhaseScrambler> phases_;
    media::LuminanceMeter meter_;
    std::vector<media::PictureMeasures> measures_;
    int written_ = 0;
    std::vector<Image> held_, thumbs_;
    media::Sha256 hash_;
};

/// A row for every frame as it is shown.
std::string events_table(const animate::FrameRows& rows, const std::vector<int>& order,
                         const std::vector<media::PictureMeasures>& measures, const ClipPlan& plan);

}  // namespace risorius::stimuli
