#include "risorius/animate/studio.h"

#include "risorius/scene/scene_from_rig.h"

namespace risorius::animate {

const scene::RigFiles& Studio::rig(const std::filesystem::path& file) {
    if (!files_ || files_->file != file) {
        views_.clear();
        scene_.reset();
        face_.reset();
        files_.emplace(scene::read_rig_files(file));
    }
    return *files_;
}

face::Face& Studio::face(const face::Quality& quality) {
    if (!face_ || quality_ != quality.name) {
        views_.clear();
        scene_.reset();
        face_ = std::make_unique<face::Face>(files_->rig, files_->mesh, quality, files_->place());
        quality_ = quality.name;
    }
    return *face_;
}

const render::Scene& Studio::scene(const render::ViewOptions& view, int count) {
    const auto wanted = static_cast<std::size_t>(count);
    if (scene_ && options_ == view && !views_.empty()) {
        if (views_.size() < wanted) views_.resize(wanted);
        return *scene_;
    }
    views_.clear();
    scene_.emplace(scene::scene_from_rig(face_->head(), files_->rig, files_->mesh));
    scene::add_wrinkles(face_->wrinkle_lines(), *scene_);
    if (view.show == render::Show::kMuscles)
        scene_->muscles = scene::muscles_for_view(face_->muscle_surfaces());
    skull_.reset();
    if (view.show == render::Show::kSkull) {
        skull_ = face::estimate_skull(face_->head(), files_->rig);
        scene_->bones = scene::bones_for_view(*skull_);
    }
    // The first one here, as others need it; each of those on the thread that draws with it
    views_.resize(wanted);
    views_[0] = std::make_unique<render::OffscreenView>(*scene_, view);
    options_ = view;
    return *scene_;
}

render::OffscreenView& Studio::view(int worker) {
    std::unique_ptr<render::OffscreenView>& own = views_[static_cast<std::size_t>(worker)];
    if (!own) own = std::make_unique<render::OffscreenView>(*scene_, *views_[0]);
    return *own;
}

}  // namespace risorius::animate
