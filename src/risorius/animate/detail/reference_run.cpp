#include "risorius/animate/detail/reference_run.h"

#include "risorius/core/error.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/timeline.h"

namespace risorius::animate {

struct ReferenceRun::Impl {
    scene::RigFiles files;
    track::ChannelTable channels;
    track::ScriptDescription script;
    face::Face face;
    track::Timeline timeline;
    bool started = false;

    Impl(const std::filesystem::path& script_file, const std::filesystem::path& rig_file,
         const std::string& quality)
        : files(scene::read_rig_files(rig_file)),
          channels(files.rig.channels()),
          script(track::read_script(script_file, channels, files.rig.facs, files.rig.expressions)),
          face(files.rig, files.mesh, face::quality_named(quality), files.place()),
          timeline(script, channels) {
        face.drive_jaw_by(script.header.jaw);
        face.set_gravity(script.header.gravity_m_s2);
        face.move(script.header.motion);
    }
};

ReferenceRun::ReferenceRun(const std::filesystem::path& script, const std::filesystem::path& rig,
                           const std::string& quality, Eigen::Index vertices)
    : impl_(std::make_unique<Impl>(script, rig, quality)) {
    if (impl_->files.mesh.vertex_count() != vertices)
        throw Error(option_name("against") + " " + script.string(),
                    "the mesh that is shown, of " + std::to_string(vertices) + " vertices",
                    "one of " + std::to_string(impl_->files.mesh.vertex_count()));
}

ReferenceRun::~ReferenceRun() = default;

Points ReferenceRun::at(double t_s) {
    const auto drive = [this](double when_s) { return impl_->timeline.at(when_s); };
    if (!impl_->started) impl_->face.start(drive);
    impl_->started = true;
    return impl_->face.pose_at(t_s, drive).vertices;
}

}  // namespace risorius::animate
