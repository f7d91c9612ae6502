// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/reference_run.h"

#include "risorius/face/face.h"
#include "risorius/track/timeline.h"

namespace risorius::animate {

struct ReferenceRun::Impl {
    track::ChannelTable channels;
    face::Face face;
    track::Timeline timeline;
    bool started = false;

    Impl(const track::ScriptDescription& script, const scene::RigFiles& files,
         const face::Quality& quality)
        : channels(files.rig.channels()),
          face(files.rig, files.mesh, quality, files.place()),
          timeline(script, channels) {
        face.drive_jaw_by(script.header.jaw);
        face.set_gravity(script.header.gravity_m_s2);
        face.move(script.header.motion);
    }
};

ReferenceRun::ReferenceRun(const track::ScriptDescription& script, const scene::RigFiles& files,
                           const face::Quality& quality)
    : impl_(std::make_unique<Impl>(script, files, quality)) {}

ReferenceRun::~ReferenceRun() = default;

Points ReferenceRun::at(double t_s) {
    const auto drive = [this](double when_s) { return impl_->timeline.at(when_s); };
    if (!impl_->started) impl_->face.start(drive);
    impl_->started = true;
    return impl_->face.pose_at(t_s, drive).vertices;
}

}  // namespace risorius::animate
