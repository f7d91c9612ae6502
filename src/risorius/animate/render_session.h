// SPDX-License-Identifier: MIT
/// \file
/// The objects that several renders of the same face share: the face, its scene, and the views with their baked data.
///
/// A job does not influence the next one: the face starts again from rest, and views keep nothing of a frame.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "risorius/animate/render_inputs.h"
#include "risorius/face/face.h"
#include "risorius/face/view/skull.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::animate {

/// Keeps the face, the scene and the views of the last job, and makes new ones when a job needs others.
class RenderSession {
  public:
    /// Returns the face for a rig and a quality. Throws Error when it cannot be built.
    face::Face& face(std::shared_ptr<const RigInput> rig, const face::Quality& quality);
    /// Returns the scene of that face and prepares for `views` views of it. The first view is made at once, the others by view().
    const render::Scene& scene(const render::ViewOptions& view, int views);
    render::OffscreenView& view() { return *views_[0]; }
    /// Returns the view of one of the drawing threads. Call it on that thread.
    render::OffscreenView& view(int worker);
    /// Returns the skull of the scene; empty unless its bones are shown.
    const std::optional<face::Skull>& skull() const { return skull_; }

  private:
    std::shared_ptr<const RigInput> rig_;
    std::string quality_;
    std::unique_ptr<face::Face> face_;
    std::optional<render::Scene> scene_;
    std::optional<face::Skull> skull_;
    render::ViewOptions options_;
    std::vector<std::unique_ptr<render::OffscreenView>> views_;
};

}  // namespace risorius::animate
