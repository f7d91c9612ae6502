// What a video or a still shows: the script's own view and whatever the options put in its place.
#pragma once

#include <string>
#include <vector>

#include "risorius/animate/animate.h"
#include "risorius/media/video_writer.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/track/script.h"

namespace risorius::animate {

struct Shot {
    track::ScriptHeader script;
    int frames = 0;
    double first_s = 0;  ///< 0 but for a still and a turntable
    render::ViewOptions view;

    std::vector<double> times_s;  ///< of every frame where they are not even
    bool still_time = false;      ///< all frames show first_s

    /// Of a frame's length, 360 deg, the shutter is open for so much, half of it before the frame's time: the picture is the mean in
    /// linear light of that many moments, at the middles of equal pieces. 0: the frame's time alone.
    double shutter_deg = 0;
    static constexpr int kShutterMoments = 9;
    int moments() const { return shutter_deg > 0 ? kShutterMoments : 1; }
    /// From the frame's time to a moment's, in frames.
    double moment_offset(int moment) const {
        return shutter_deg / 360 * (moment - (moments() - 1) / 2) / moments();
    }

    double time_s(int frame) const {
        if (!times_s.empty()) return times_s[static_cast<std::size_t>(frame)];
        return still_time ? first_s : first_s + static_cast<double>(frame) / script.fps;
    }
    media::VideoOptions video;
    std::string background_text() const;  ///< as a script writes it
};

/// Refuses now what would only fail after minutes. Throws Error naming the option or the script.
Shot plan_shot(const AnimateOptions& options);

}  // namespace risorius::animate
