// SPDX-License-Identifier: MIT
// Skull and mandible under the skin: as deep as the tissue over them is thick, open where a skull is, whole on any head.
#include "risorius/face/view/skull.h"

#include <gtest/gtest.h>

#include <optional>

#include "rig/heads.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/geom/closest_point.h"
#include "risorius/geom/surface_topology.h"

namespace risorius::face {
namespace {

constexpr double kSkullStep_mm = 2.5;  // coarser than what is shown

struct PlacedSkull {
    explicit PlacedSkull(const rig::Head& placed, const rig::RigDescription& rig)
        : head(placed),
          anatomy(rig),
          skull(estimate_skull(placed, rig, kSkullStep_mm)),
          skin(placed.vertices, placed.skin),
          cranium(skull.cranium.vertices, skull.cranium.triangles),
          mandible(skull.mandible.vertices, skull.mandible.triangles) {}

    const rig::Head& head;
    const rig::RigDescription& anatomy;
    Skull skull;
    geom::SurfaceTree skin, cranium, mandible;

    Vec3 on_skin(const std::string& landmark) const {
        return skin.closest(head.landmark(landmark))->point;
    }
    double thickness_mm(const std::string& landmark) const {
        return 1e3 * interpolate_thickness(head, anatomy.atlas.thickness, on_skin(landmark));
    }
    double depth_mm(const geom::SurfaceTree& bone, const std::string& landmark) const {
        return 1e3 * std::sqrt(bone.closest(on_skin(landmark))->squared_distance);
    }
};

void expect_measured_depth(const PlacedSkull& one) {
    for (const char* landmark : {"v", "op", "g", "n", "mef", "bc_l", "bc_r", "or_l", "or_r", "zy_l",
                                 "zy_r", "lor_l", "ft_r", "fml_l"})
        EXPECT_NEAR(one.depth_mm(one.cranium, landmark), one.thickness_mm(landmark), 1.0)
            << landmark;
    for (const char* landmark : {"gn", "me", "go_l", "go_r", "mmb_l", "mmb_r", "pjm_l", "ram_r"})
        EXPECT_NEAR(one.depth_mm(one.mandible, landmark), one.thickness_mm(landmark), 1.5)
            << landmark;
}

const PlacedSkull& the_adult() {
    static const PlacedSkull one(rig::adult_placed(), rig::adult().rig);
    return one;
}

TEST(Skull, LiesAsDeepUnderTheSkinAsMeasured) { expect_measured_depth(the_adult()); }

TEST(Skull, FitsAMeasuredHeadToo) {
    const auto head = rig::makehuman_head();
    if (!head) GTEST_SKIP() << "the measured head is not beside the project";
    expect_measured_depth(
        PlacedSkull(rig::place_head(head->rig, head->mesh, "makehuman"), head->rig));
}

TEST(Skull, OrbitsNoseAndTemplesAreHollow) {
    const rig::Head& head = the_adult().head;
    // From in front one looks past the rims a long way into orbits and nose, but not beside them
    const auto first_z = [&](const Vec3& from) {
        const auto hit = the_adult().cranium.cast(Vec3(from.x(), from.y(), 0.2), -Vec3::UnitZ());
        return hit ? hit->point.z() : -1;
    };
    for (const rig::EyeGeometry& eye : head.eyes) {
        EXPECT_LT(first_z(eye.centre), eye.centre.z() - eye.radius_m) << "an eye in bone";
        EXPECT_GT(first_z(eye.centre + head.mm(21) * Vec3::UnitY()), eye.centre.z());
    }
    EXPECT_LT(first_z(head.landmark("sn") + head.mm(1) * Vec3(6, 10, 0)), head.mm(78));
    EXPECT_GT(first_z(head.landmark("sn") - head.mm(6) * Vec3::UnitY()), head.mm(80));
    // Between the arch of the cheek and the temple there is room for a muscle
    const Vec3 arch = head.mm(1) * Vec3(0, 0, 36);
    const auto through =
        the_adult().cranium.cast(arch + head.mm(1) * Vec3(80, 8, 0), -Vec3::UnitX());
    ASSERT_TRUE(through);
    EXPECT_LT(through->point.x(), head.mm(55));
}

TEST(Skull, TheMandibleIsABoneOfItsOwn) {
    for (const BoneSurface* bone : {&the_adult().skull.cranium, &the_adult().skull.mandible}) {
        const geom::SurfaceEdges edges = geom::surface_edges(bone->triangles);
        int open = 0;
        for (int e = 0; e < edges.count(); ++e) open += edges.triangle_count(e) == 1;
        EXPECT_EQ(open, 0);
        EXPECT_EQ(bone->open.size(), static_cast<std::size_t>(bone->vertices.rows()));
    }
    // Its condyles lie at the hinge of the jaw, under the skull; its chin is far from that
    const rig::Head& head = the_adult().head;
    const Vec3 hinge = head.mm(1) * the_adult().anatomy.jaw.hinge_mm;
    for (const double side : {1.0, -1.0})
        EXPECT_LT(the_adult()
                      .mandible.closest(hinge + head.mm(50) * side * Vec3::UnitX())
                      ->squared_distance,
                  std::pow(head.mm(5), 2));
    EXPECT_GT(the_adult().depth_mm(the_adult().cranium, "me"), 35);
}

}  // namespace
}  // namespace risorius::face
