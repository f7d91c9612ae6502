// SPDX-License-Identifier: MIT
#include "risorius/animate/render_session.h"

#include "risorius/face/surfaces.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::animate {

face::Face& RenderSession::face(std::shared_ptr<const RigInput> rig, const face::Quality& quality) {
    if (!face_ || rig_ != rig || quality_ != quality.name) {
        views_.clear();
        scene_.reset();
        face_.reset();
        rig_ = std::move(rig);
        const scene::RigFiles& files = rig_->files;
        face_ = std::make_unique<face::Face>(files.rig, files.mesh, quality, files.place());
        quality_ = quality.name;
    }
    return *face_;
}

const render::Scene& RenderSession::scene(const render::ViewOptions& view, int views) {
    const auto wanted = static_cast<std::size_t>(views);
    if (scene_ && options_ == view && !views_.empty()) {
        if (views_.size() < wanted) views_.resize(wanted);
        return *scene_;
    }
    views_.clear();
    scene_.emplace(scene::scene_from_rig(face_->head(), rig_->files.rig, rig_->files.mesh));
    if (!view.hair) scene_->appearance.hair_style = "shaven";
    scene::add_wrinkles(face_->surfaces().wrinkle_lines(), *scene_);
    if (view.show == render::Show::kMuscles)
        scene_->muscles = scene::muscles_for_view(face_->surfaces().muscles());
    skull_.reset();
    if (view.show == render::Show::kSkull) {
        skull_ = face::estimate_skull(face_->head(), rig_->files.rig);
        scene_->bones = scene::bones_for_view(*skull_);
    }
    // The first view is made here, because the others share its data. The others are made on the threads that draw with them.
    views_.resize(wanted);
    views_[0] = std::make_unique<render::OffscreenView>(*scene_, view);
    options_ = view;
    return *scene_;
}

render::OffscreenView& RenderSession::view(int worker) {
    std::unique_ptr<render::OffscreenView>& own = views_[static_cast<std::size_t>(worker)];
    if (!own) own = std::make_unique<render::OffscreenView>(*scene_, *views_[0]);
    return *own;
}

}  // namespace risorius::animate
