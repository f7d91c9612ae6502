// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/ready_face.h"

namespace risorius::animate {

face::Face& ready_face(const RenderJob& job, RenderSession& session) {
    const track::ScriptHeader& header = job.script.header;
    face::Face& face = session.face(job.rig, job.quality);
    face.drive_jaw_by(header.jaw);
    face.set_gravity(header.gravity_m_s2);
    face.move(header.motion == track::Motion::kDynamic ? face::Motion::kDynamic
                                                       : face::Motion::kQuasiStatic);
    return face;
}

void flip_motion(const Points& rest, face::FacePose& pose) {
    pose.vertices.col(1) = 2 * rest.col(1) - pose.vertices.col(1);
}

}  // namespace risorius::animate
