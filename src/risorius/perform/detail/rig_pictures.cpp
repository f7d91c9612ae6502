// SPDX-License-Identifier: MIT
#include "risorius/perform/detail/rig_pictures.h"

#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/face/face.h"
#include "risorius/face/quality.h"
#include "risorius/face/surfaces.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::perform {

namespace {

constexpr int kPicture_px = 320;

/// With its wrinkles: people before a camera have some as well, and the network sees them.
render::Scene scene_of(const face::Face& face, const scene::RigFiles& files) {
    render::Scene out = scene::scene_from_rig(face.head(), files.rig, files.mesh);
    scene::add_wrinkles(face.surfaces().wrinkle_lines(), out);
    return out;
}

}  // namespace

struct RigPictures::Impl {
    std::shared_ptr<const scene::RigFiles> files;
    track::ChannelTable channels;
    face::Face face;
    render::Scene scene;
    render::OffscreenView view;

    explicit Impl(std::shared_ptr<const scene::RigFiles> rig)
        : files(std::move(rig)),
          channels(files->rig.channels()),
          face(files->rig, files->mesh, face::quality_named("draft"), files->place()),
          scene(scene_of(face, *files)),
          view(scene, {.width_px = kPicture_px, .height_px = kPicture_px}) {}
};

RigPictures::RigPictures(std::shared_ptr<const scene::RigFiles> rig)
    : impl_(std::make_unique<Impl>(std::move(rig))) {}
RigPictures::~RigPictures() = default;
const scene::RigFiles& RigPictures::rig() const { return *impl_->files; }

Image RigPictures::draw(const Pose& pose) {
    Json script = json_object({{"format", "risorius-script"},
                               {"version", 1},
                               {"rig", "rig.json"},
                               {"duration_s", 1},
                               {"channels", Json::object()}});
    for (const auto& [name, value] : pose)
        script["channels"][name] = json_object({{"keys", Json::array({Json::array({0, value})})}});
    const rig::RigDescription& rig = impl_->files->rig;
    const track::Timeline timeline(track::read_script(JsonCursor::from_json(script, "camera"),
                                                      impl_->channels, rig.facs, rig.expressions),
                                   impl_->channels);
    impl_->face.start([&](double t_s) { return timeline.at(t_s); });
    return impl_->view.draw(scene::pose_for_view(impl_->face.pose()));
}

}  // namespace risorius::perform
