// SPDX-License-Identifier: MIT
// The lining of the mouth stays behind the skin, however the lips turn.
#include "risorius/face/skin/detail/mouth_lining.h"

#include <gtest/gtest.h>

#include "face/adult_face.h"
#include "risorius/geom/closest_point.h"

namespace risorius::face {
namespace {

TEST(MouthLining, DoesNotMoveAtRest) {
    const rig::Head head = rig::place_head(rig::adult().rig, rig::adult().mesh, "adult");
    const MouthLining lining(head);
    EXPECT_GT(lining.points(), 50);
    Points vertices = head.vertices;
    lining.stay_behind(vertices);
    EXPECT_EQ(vertices, head.vertices);
}

TEST(MouthLining, DoesNotComeThroughTheChinWhenLipsFunnel) {
    Face face = adult_face();
    track::Drive funnel = with_unit("AU22");
    funnel.excitation = (funnel.excitation + with_unit("AU25").excitation).cwiseMin(1.0);
    const FacePose pose = equilibrium_pose(face, funnel);
    const rig::Head& head = face.head();
    const geom::SurfaceTree rest(head.vertices, head.skin), now(pose.vertices, head.skin);
    // How far behind the skin a point lies
    const auto depth = [&](const geom::SurfaceTree& skin, const Points& at, long v) {
        const auto front = skin.closest(at.row(v).transpose());
        const auto f = head.skin.row(front->triangle);
        const Vec3 a = at.row(f[0]), b = at.row(f[1]), c = at.row(f[2]);
        return (front->point - at.row(v).transpose()).dot((b - a).cross(c - a).normalized());
    };
    int in_front = 0, behind_at_rest = 0;
    for (long f = 0; f < head.lining.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const long v = head.lining(f, k);
            const Vec3 p = head.vertices.row(v);
            // Between lip and chin, where they are one over the other
            if (std::abs(p.x()) > head.mm(18) || p.y() > head.landmark("li").y() - head.mm(3) ||
                p.z() < head.teeth_front_m - head.mm(4))
                continue;
            if (depth(rest, head.vertices, v) < head.mm(1)) continue;
            ++behind_at_rest;
            in_front += depth(now, pose.vertices, v) < 0 ? 1 : 0;
        }
    EXPECT_GT(behind_at_rest, 20);
    EXPECT_EQ(in_front, 0);
}

}  // namespace
}  // namespace risorius::face
