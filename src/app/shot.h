// What a video or a still shows: the script's own view and whatever the options put in its place.
#pragma once

#include <string>
#include <vector>

#include "app/animate.h"
#include "media/video_writer.h"
#include "render/offscreen_view.h"
#include "track/script.h"

namespace risorius::app {

struct Shot {
    track::ScriptHeader script;
    int frames = 0;
    double first_s = 0;  ///< 0 but for a still and a turntable
    render::ViewOptions view;

    std::vector<double> times_s;  ///< of every frame where they are not even
    bool still_time = false;      ///< all frames show first_s

    double time_s(int frame) const {
        if (!times_s.empty()) return times_s[static_cast<std::size_t>(frame)];
        return still_time ? first_s : first_s + static_cast<double>(frame) / script.fps;
    }
    media::VideoOptions video;
    std::string background_text() const;  ///< as a script writes it
};

/// Refuses now what would only fail after minutes. Throws Error naming the option or the script.
Shot plan_shot(const AnimateOptions& options);

}  // namespace risorius::app
