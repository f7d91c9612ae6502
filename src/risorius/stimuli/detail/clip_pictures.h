// SPDX-License-Identifier: MIT
/// \file
/// Turns rendered pictures into those of a clip: matches luminance, applies the control, measures and marks.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/image.h"
#include "risorius/core/sha256.h"
#include "risorius/media/luminance.h"
#include "risorius/media/mondrian.h"
#include "risorius/media/phase_scramble.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/stimuli/detail/luminance_maps.h"
#include "risorius/stimuli/detail/point_lights.h"

namespace risorius::stimuli {

class Chimera;

/// Returns whether the control changes the order of frames, so that all frames are needed before the first one is written.
bool shows_other_order(design::ControlKind kind);
/// Returns whether the control shows only a window around eyes or mouth.
bool shows_part(design::ControlKind kind);
/// Returns whether the clip is one picture, shown all the time.
bool shows_one_picture(design::ControlKind kind);

/// Returns whether all frames are needed before the first one is written.
bool needs_all_frames(const ClipPlan& plan);

/// The frames of a clip that its strip shows: five, or the only one of a picture.
int strip_frames(const ClipPlan& plan);
int strip_frame(int index, int frames);

/// Returns whether a column of a table of frames holds a coordinate of a landmark.
bool is_of_landmark(const std::string& column);

/// Returns the distance of the landmarks zy_l and zy_r in the first frame, px. Throws Error naming `place` when there are none.
double width_of_face(const animate::FrameRows& rows, const std::string& place);

/// A window with soft edges, px. Outside it, the background is shown.
struct Window {
    double left = 0, top = 0, right = 0, bottom = 0;
    void show(const std::array<std::uint8_t, 3>& outside, Image& image) const;
};

/// Processes the pictures of one clip.
class ClipPictures {
  public:
    /// `show` gets the pictures as they are shown, in order.
    ClipPictures(const ClipPlan& plan, std::function<void(const Image&)> show);

    /// Returns whether the pictures come with a transparent background: they are then put over that of the script.
    static bool has_layers(const ClipPlan& plan);

    /// Gives the table of the frames. It must be known before finish(), and before the first picture of a matched clip.
    void know(const animate::FrameRows& rows) { rows_ = &rows; }
    /// Gives the lower half of a chimeric clip. It must be known before finish().
    void combine_with(Chimera& chimera) { chimera_ = &chimera; }
    /// Adds a rendered picture, in the order of the frames.
    void add(Image image);
    /// Call this after the last picture. It writes the pictures if the control needs all frames first.
    void finish(const std::vector<int>& order);

    /// Returns the luminance of the pictures as shown, within the part that is matched; and the fraction of values that were clipped,
    /// mean over frames. Of matched clips only.
    const media::LuminanceSums& luminance() const { return luminance_; }
    /// Of clips with a map: how near its pictures come to what the map aims at.
    Json map_report() const;
    double cut_off() const { return written_ > 0 ? cut_off_ / written_ : 0; }

    /// Returns five frames, spread over the clip, side by side.
    Image strip() const;
    std::string sha256() { return hash_.finish(); }

    /// Returns the measures of each frame of the clip, without marks; empty when those of the render are still valid.
    const std::vector<media::PictureMeasures>& measures() const { return measures_; }

    /// Returns the first frame whose pictures differ from the first one by more than 1e-7, which is the mean squared difference of
    /// luminance over what is not background.
    std::optional<int> pixel_onset() const { return pixel_onset_; }

  private:
    void write(Image image, int frame);
    void change_oval(const std::vector<float>& oval, int frame, Image& image);
    void look_for_change(const Image& image);
    void match(const std::vector<float>& measured, Image& image);

    void pass(const std::vector<float>& oval, Image& image);
    void draw_mask(const std::vector<float>& oval, Image& image);

    const ClipPlan& plan_;
    design::ControlKind kind_;
    std::optional<media::ToneCurve> tone_;
    std::function<void(const Image&)> show_;
    bool later_, measured_, layered_;
    const animate::FrameRows* rows_ = nullptr;
    Chimera* chimera_ = nullptr;
    std::optional<Window> window_;
    std::optional<PointLights> dots_;
    media::Mondrian mask_;
    media::LuminanceSums luminance_;
    std::optional<MapReport> map_report_;
    double cut_off_ = 0;
    int added_ = 0;
    std::optional<media::PhaseScrambler> phases_;
    media::LuminanceMeter meter_;
    std::vector<media::PictureMeasures> measures_;
    int written_ = 0;
    std::vector<double>
        first_;  ///< luminance of the first picture; -1 where it shows the background
    std::optional<int> pixel_onset_;
    std::vector<Image> held_, thumbs_;
    Sha256 hash_;
};

/// Returns the table of the clip, with one row per frame of the clip. `first_source`: the frame of the script in the first row of
/// `rows`.
std::string events_table(const animate::FrameRows& rows, const std::vector<int>& order,
                         int first_source, const std::vector<media::PictureMeasures>& measures,
                         const ClipPlan& plan);

}  // namespace risorius::stimuli
