// What films of the same face can share: the face, the scene made of it and the view with all that it has baked.
//
// A film leaves no trace in it that the next one would show: a face starts anew, and views hold nothing of a frame.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "risorius/face/face.h"
#include "risorius/face/view/skull.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/scene/rig_files.h"

namespace risorius::animate {

class Studio {
  public:
    /// Each of these keeps what it made last and makes it anew when it is asked for another one.
    const scene::RigFiles& rig(const std::filesystem::path& file);
    face::Face& face(const face::Quality& quality);  ///< of the rig asked for last
    /// The scene of that face, and `count` views of it; the first one is made, others when they are needed.
    const render::Scene& scene(const render::ViewOptions& view, int count);
    render::OffscreenView& view() { return *views_[0]; }
    /// One for each thread that draws.
    render::OffscreenView& view(int worker);
    /// Of the scene, when its bones are shown.
    const std::optional<face::Skull>& skull() const { return skull_; }

  private:
    std::optional<scene::RigFiles> files_;
    std::string quality_;
    std::unique_ptr<face::Face> face_;
    std::optional<render::Scene> scene_;
    std::optional<face::Skull> skull_;
    render::ViewOptions options_;
    std::vector<std::unique_ptr<render::OffscreenView>> views_;
};

}  // namespace risorius::animate
