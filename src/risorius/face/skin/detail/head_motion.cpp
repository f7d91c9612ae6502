// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/head_motion.h"

#include <algorithm>

#include "risorius/face/head_pose.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

// Atlanto-occipital joint
Vec3 pivot_of(const rig::Head& head) { return {0, head.mm(-30), head.mm(-10)}; }

}  // namespace

Rigid head_motion(const rig::Head& head, const track::Drive& drive) {
    using track::Kinematic;
    const Vec3 pivot = pivot_of(head);
    Rigid motion = Rigid::Identity();
    motion.translate(pivot + head.mm(1.0) * Vec3(drive.at(Kinematic::kHeadSide),
                                                 drive.at(Kinematic::kHeadUp),
                                                 drive.at(Kinematic::kHeadForward)));
    motion.rotate(Eigen::AngleAxisd(drive.at(Kinematic::kHeadYaw) * kRadPerDeg, Vec3::UnitY()));
    motion.rotate(Eigen::AngleAxisd(-drive.at(Kinematic::kHeadPitch) * kRadPerDeg, Vec3::UnitX()));
    // A tilt to the left lowers the left ear: a rotation about the forward axis from left to down.
    motion.rotate(Eigen::AngleAxisd(-drive.at(Kinematic::kHeadRoll) * kRadPerDeg, Vec3::UnitZ()));
    motion.translate(-pivot);
    return motion;
}

Rigid head_pose(const rig::Head& head, const track::Drive& drive) {
    return head_motion(head, drive);
}

Neck::Neck(const rig::Head& head)
    : pivot_(pivot_of(head)),
      top_m_(head.mm(-70)),
      chin_m_(head.mm(-30)),
      base_m_(std::max(head.vertices.col(1).minCoeff() + head.mm(10), head.mm(-190))),
      front_near_m_(head.mm(10)),
      front_far_m_(head.mm(60)) {}

double Neck::fraction(const Vec3& rest) const {
    // Behind the jaw the neck begins higher up than under the chin.
    const double under_chin = geom::smoothstep(front_near_m_, front_far_m_, rest.z());
    return geom::smoothstep(base_m_, top_m_ + chin_m_ * under_chin, rest.y());
}

Rigid Neck::part(const Rigid& head, double fraction) const {
    if (fraction >= 1) return head;
    Rigid part = Rigid::Identity();
    if (fraction <= 0) return part;
    part.translate(pivot_ + fraction * (head * pivot_ - pivot_));
    part.rotate(Eigen::Quaterniond::Identity().slerp(fraction, Eigen::Quaterniond(head.linear())));
    part.translate(-pivot_);
    return part;
}

}  // namespace risorius::face
