// What a video or a still shows: the script's own view and whatever the options put in its place.
#pragma once

#include <string>

#include "app/animate.h"
#include "media/video_writer.h"
#include "render/offscreen_view.h"
#include "track/script.h"

namespace risorius::app {

struct Shot {
    track::ScriptHeader script;
    int frames = 0;
    double first_s = 0;  ///< 0 but for a still
    render::ViewOptions view;

    double time_s(int frame) const { return first_s + static_cast<double>(frame) / script.fps; }
    media::VideoOptions video;
    std::string background_text() const;  ///< as a script writes it
};

/// Refuses now what would only fail after minutes. Throws Error naming the option or the script.
Shot plan_shot(const AnimateOptions& options);

}  // namespace risorius::app
