// SPDX-License-Identifier: MIT
/// \file
/// What is seen to move in a clip, measured on the landmarks of its frames in the order in which they are shown.
///
///   q_i(t)    position of landmark i in the head's frame: a rigid fit on landmarks of the skull takes the motion of the head off
///   q'_i(t)   the same in the twin, which plays only head, gaze, blinks and idle motion of the script
///   d_i(t)    |(q_i(t) - q_i(0)) - (q'_i(t) - q'_i(0))|; 0 is the first frame that is shown
///   s(t)      the largest d_i of all landmarks that lie on neither skull nor neck
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "risorius/animate/frame_rows.h"
#include "risorius/animate/landmark_run.h"
#include "risorius/core/json_cursor.h"

namespace risorius::stimuli {

/// Landmarks that are looked at; default: all of the face.
class LandmarkChoice {
  public:
    LandmarkChoice() = default;
    explicit LandmarkChoice(std::set<std::string> ids) : ids_(std::move(ids)) {}
    bool has(const std::string& id) const { return !ids_ || ids_->count(id) > 0; }
    std::string name() const;  ///< the ids, with spaces between them; empty for all

  private:
    std::optional<std::set<std::string>> ids_;
};

/// Frames are numbers of shown frames. None has a value in a clip that stands still.
struct SeenMotion {
    std::optional<double> seen_mm;  ///< the maximum of s
    std::string landmark;           ///< whose it is
    /// The maximum of s of the same expression, settled at full intensity
    std::optional<double> full_mm;
    std::optional<int> onset;  ///< the first frame with s > min(0.3 mm, 5 % of its maximum)
    std::optional<int> apex;   ///< the first frame with 99 % of the maximum
    std::optional<int>
        offset;  ///< the first frame after the apex with s below the limit of the onset
    std::vector<double> way_mm;                ///< s of each shown frame
    std::optional<double> velocity_peak_mm_s;  ///< largest rise of s from frame to frame
    /// The first frame in which a landmark of the skull has moved by 0.3 mm, the smaller aperture of the twin's lids is below 80 % of
    /// that in the first frame, or an eye has turned by 1 degree
    std::optional<int> head_onset, blink_onset, gaze_onset;
};

/// Measures a clip. `rows`: its frames in the order of the script, with landmarks; `order`: for each shown frame, its row. `twin`: empty
/// when the script has none.
SeenMotion seen_motion(const animate::FrameRows& rows,
                       const std::optional<animate::LandmarkFrames>& twin,
                       const std::vector<int>& order, int fps, const LandmarkChoice& choice = {});

/// What is seen to move in a clip whose parts move as `a` and `b` do: the larger s of the two in each frame. What is not a matter of s
/// is that of `a`.
SeenMotion seen_together(const SeenMotion& a, const SeenMotion& b, const std::vector<int>& order,
                         int fps);

/// What a picture shows of a movement.
struct SeenPicture {
    int frame = 0;         ///< of the script
    double seen_mm = 0;    ///< s in this frame, mm; 0 is the first frame of the script
    std::string landmark;  ///< whose it is; empty when nothing moves
};

/// Chooses the frame of a picture: the given one, or the first with 99 % of the maximum of s; the first frame when nothing moves.
/// `twin` as above.
SeenPicture seen_picture(const animate::LandmarkFrames& frames,
                         const std::optional<animate::LandmarkFrames>& twin,
                         std::optional<int> frame, const LandmarkChoice& choice = {});

/// Returns s of the second of two frames, mm.
double largest_way_mm(const animate::LandmarkFrames& frames, const LandmarkChoice& choice = {});

/// Returns the measures for the sidecar; null where one does not exist. `pixel_onset`: the first frame whose pixels change.
Json json_of(const SeenMotion& motion, std::optional<int> pixel_onset);

}  // namespace risorius::stimuli
