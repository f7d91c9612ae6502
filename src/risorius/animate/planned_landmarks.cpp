// SPDX-License-Identifier: MIT
#include "risorius/animate/planned_landmarks.h"

#include "risorius/core/error.h"
#include "risorius/face/head_pose.h"

namespace risorius::animate {

namespace {

rig::Head head_of(const RenderJob& job) {
    const scene::RigFiles& files = job.rig->files;
    return rig::place_head(files.rig, files.mesh, files.place());
}

render::Framing framing_of(const rig::Head& head, const render::ViewOptions& view) {
    Vec3 min = Vec3::Constant(1e9), max = Vec3::Constant(-1e9);
    for (Eigen::Index i = 0; i < head.skin.size(); ++i) {
        const Vec3 vertex = head.vertices.row(head.skin.data()[i]).transpose();
        min = min.cwiseMin(vertex);
        max = max.cwiseMax(vertex);
    }
    return {head.landmarks, min, max, view};
}

}  // namespace

PlannedLandmarks::PlannedLandmarks(const RenderJob& job)
    : rig_(job.rig), head_(head_of(job)), framing_(framing_of(head_, job.view)) {}

double PlannedLandmarks::distance_px(const std::string& a, const std::string& b,
                                     const track::Drive& drive) const {
    const Rigid moved = face::head_pose(head_, drive);
    const auto at_px = [&](const std::string& id) {
        const auto found = head_.landmarks.find(id);
        if (found == head_.landmarks.end())
            throw Error(rig_->files.place(), "a rig with the landmark " + id, "none");
        return framing_.project(moved * found->second);
    };
    return (at_px(a) - at_px(b)).norm();
}

}  // namespace risorius::animate
