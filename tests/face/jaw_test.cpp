// SPDX-License-Identifier: MIT
// The mandible moves as one body; teeth, chin and lower lip go with it, the skull stays.
#include "risorius/face/anatomy/detail/jaw.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "face/adult_face.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"

namespace risorius::face {
namespace {

using track::Kinematic;

const rig::Head& head() { return rig::adult_placed(); }
const Jaw& jaw() {
    static const Jaw one(head(), rig::adult().rig.jaw);
    return one;
}
Face& face() {
    static Face one = adult_face();
    return one;
}
std::set<int> vertices_of(const std::string& group) {
    const geom::PolygonMesh& mesh = rig::adult().mesh;
    std::set<int> out;
    for (int f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_group[f] == mesh.group_index(group))
            out.insert(mesh.corner_vertex.begin() + mesh.face_begin[f],
                       mesh.corner_vertex.begin() + mesh.face_begin[f + 1]);
    return out;
}

TEST(Jaw, AtRestDoesNotMove) {
    EXPECT_TRUE(jaw().motion(0, 0, 0).isApprox(Rigid::Identity(), 1e-15));
}

TEST(Jaw, FloorOfTheMouthBulgesBelowTheMandibleOnly) {
    for (const char* above : {"li", "sl", "pg", "mc_l", "mar_l"})
        EXPECT_TRUE(jaw().floor_bulge(head().landmark(above)).isZero(0.0)) << above;
    const Vec3 throat = jaw().floor_bulge(head().landmark("cer"));
    EXPECT_LT(throat.y(), -0.2);
    EXPECT_NEAR(throat.x(), 0, 1e-3);
    EXPECT_NEAR(jaw().chin_back(jaw().motion(0, 0, 0)), 0, 1e-12);
    EXPECT_GT(jaw().chin_back(jaw().motion(1, 0, 0)), head().mm(20));
    EXPECT_LT(jaw().chin_back(jaw().motion(0, 1, 0)), 0);
}

TEST(Jaw, OpeningSinksTheFloorOfTheMouth) {
    // Measured on another head: 21 mm down, 14 mm back
    const FacePose open = equilibrium_pose(face(), with_kinematic(Kinematic::kJawOpen, 1));
    const int throat = rig::adult().vertex("cer");
    const Vec3 moved = (open.vertices.row(throat) - head().vertices.row(throat)).transpose();
    EXPECT_LT(moved.y(), -head().mm(10));
    EXPECT_LT(moved.z(), -head().mm(6));
    EXPECT_GT(moved.z(), -head().mm(25));
}

TEST(Jaw, OpeningLowersTheChinAndBringsItBack) {
    const Vec3 chin = head().landmark("pg");
    const Vec3 moved = jaw().motion(1, 0, 0) * chin - chin;
    EXPECT_LT(moved.y(), -25e-3);
    EXPECT_LT(moved.z(), -10e-3);
    EXPECT_NEAR(moved.x(), 0, 1e-12);
    // The condyles themselves slide forwards and down.
    const Vec3 condyle = 1e-3 * head().size * rig::adult().rig.jaw.hinge_mm;
    const Vec3 slide = jaw().motion(1, 0, 0) * condyle - condyle;
    EXPECT_LT((slide - 1e-3 * head().size * rig::adult().rig.jaw.open_slide_mm).norm(), 1e-12);
}

TEST(Jaw, IncisorsPartByThreeToFiveCentimetresAtMost) {
    double lowest = 1, front = -1;
    Vec3 incisor = Vec3::Zero();
    for (int v : vertices_of("teeth_lower")) front = std::max(front, head().vertices(v, 2));
    for (int v : vertices_of("teeth_lower")) {
        const Vec3 p = head().vertices.row(v).transpose();
        if (p.z() > front - 2e-3 && std::abs(p.x()) < lowest) lowest = std::abs(p.x()), incisor = p;
    }
    const double gap = (jaw().motion(1, 0, 0) * incisor - incisor).norm();
    EXPECT_GT(gap, 30e-3);
    EXPECT_LT(gap, 55e-3);
}

TEST(Jaw, GoesToTheSideByWhatTheRigSays) {
    const Vec3 chin = head().landmark("pg");
    const Vec3 left = jaw().motion(0, 0, 1) * chin - chin,
               right = jaw().motion(0, 0, -1) * chin - chin;
    const double wanted = head().mm(rig::adult().rig.jaw.side_mm);
    EXPECT_NEAR(left.x(), wanted, 0.05 * wanted);
    EXPECT_NEAR(right.x(), -wanted, 0.05 * wanted);
    EXPECT_NEAR(left.y(), 0, 1e-12);
}

TEST(Jaw, GoesForwardByWhatTheRigSays) {
    const Vec3 chin = head().landmark("pg");
    EXPECT_LT(
        (jaw().motion(0, 1, 0) * chin - chin - 1e-3 * head().size * rig::adult().rig.jaw.forward_mm)
            .norm(),
        1e-12);
}

TEST(Jaw, ChinAndLowerLipGoWithItNoseAndCheekboneDoNot) {
    for (const char* id : {"pg", "gn", "sl", "li", "pjm_l"})
        EXPECT_GT(jaw().weight(head().landmark(id)), 0.98) << id;
    for (const char* id : {"prn", "sn", "n", "ls", "ma_l", "zy_l", "g"})
        EXPECT_LT(jaw().weight(head().landmark(id)), 0.02) << id;
}

TEST(Jaw, ItsWeightChangesGraduallyOverTheCheek) {
    const Vec3 cheek = head().landmark("mc_l");
    double before = jaw().weight(cheek + Vec3(0, 40e-3, 0)), largest = 0;
    for (double y = 40e-3; y > -40e-3; y -= 0.5e-3) {
        const double now = jaw().weight(cheek + Vec3(0, y, 0));
        EXPECT_GE(now, -1e-12);
        EXPECT_LE(now, 1 + 1e-12);
        largest = std::max(largest, std::abs(now - before));
        before = now;
    }
    EXPECT_LT(largest, 0.06) << "the change is abrupt";
}

TEST(Jaw, LipsAreOnTheirOwnSideOfTheBite) {
    const std::array<EyeLids, 2> lids{EyeLids(head(), 0, 0.96), EyeLids(head(), 1, 0.96)};
    const Shell shell = build_shell(head(), jaw(), lids, {800});
    const std::vector<double> heights = bite_heights(head(), jaw(), shell);
    ASSERT_EQ(heights.size(), shell.vertex.size());
    const auto height_at = [&](const char* id) {
        double min = 1, found = 0;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const double d =
                (head().vertices.row(shell.vertex[i]).transpose() - head().landmark(id)).norm();
            if (d < min) min = d, found = heights[i];
        }
        return found;
    };
    for (const char* id : {"ls", "ulc_l", "ulc_r", "sn"}) EXPECT_GT(height_at(id), 2e-3) << id;
    for (const char* id : {"li", "llc_l", "llc_r", "pg"}) EXPECT_LT(height_at(id), -2e-3) << id;
}

/// The jaw open by so much, found once for all tests of a process.
struct OpenJaw {
    FacePose pose;
    double volume_m3;
    int inverted_tets;
};
const OpenJaw& opened(double open) {
    static std::map<double, OpenJaw> known;
    if (!known.contains(open)) {
        FacePose pose = equilibrium_pose(face(), with_kinematic(Kinematic::kJawOpen, open));
        known[open] = {std::move(pose), face().diagnostics().tissue_volume_m3(),
                       face().diagnostics().inverted_tets()};
    }
    return known[open];
}

TEST(JawOpening, CarriesTheLowerTeethRigidlyAndLeavesTheUpper) {
    const FacePose& pose = opened(0.8).pose;
    const Rigid motion = jaw().motion(0.8, 0, 0);
    for (const char* group : {"teeth_lower", "gums_lower"})
        for (int v : vertices_of(group))
            ASSERT_LT((motion * Vec3(head().vertices.row(v).transpose()) -
                       Vec3(pose.vertices.row(v).transpose()))
                          .norm(),
                      1e-12)
                << group;
    for (const char* group : {"teeth_upper", "gums_upper", "eye_l", "eye_r"})
        for (int v : vertices_of(group))
            ASSERT_LT((head().vertices.row(v) - pose.vertices.row(v)).norm(), 1e-15) << group;
    EXPECT_DOUBLE_EQ(pose.jaw_open, 0.8);
}

TEST(JawOpening, OpensTheMouth) {
    const FacePose& pose = opened(0.8).pose;
    EXPECT_GT((at(pose.vertices, "stos") - at(pose.vertices, "stoi")).norm(), 20e-3);
    const Points u = moved_mm(face(), pose);
    EXPECT_LT(at(u, "li").y(), -15);
    EXPECT_GT(at(u, "ls").y(), -6) << "the upper lip is dragged down";
    EXPECT_LT(at(u, "prn").norm(), 2);
    EXPECT_LT(at(u, "n").norm(), 0.5);
    // The skin of the chin goes with its bone, stretched a little behind it.
    const Vec3 chin = head().landmark("pg");
    EXPECT_LT((at(pose.vertices, "pg") - jaw().motion(0.8, 0, 0) * chin).norm(), 6.8e-3);
}

TEST(JawOpening, TakesNoVolumeFromTheTissue) {
    // It was 3 % before what lies under the mandible hardly gave way in volume, and the hyoid went back
    EXPECT_NEAR(opened(1).volume_m3 / opened(0).volume_m3, 1, 0.023);
}

TEST(JawOpening, InvertsNoTissue) {
    for (double open : {0.2, 0.5, 0.8}) EXPECT_EQ(opened(open).inverted_tets, 0) << open;
}

TEST(JawOpening, IsTheSameOnBothSides) {
    const Points u = moved_mm(face(), opened(0.5).pose);
    for (const char* id : {"ch", "mar", "mc", "llc", "pjm"}) {
        const Vec3 l = at(u, std::string(id) + "_l"), r = at(u, std::string(id) + "_r");
        EXPECT_LT((Vec3(-l.x(), l.y(), l.z()) - r).norm(), 0.6) << id;
    }
}

TEST(JawOpening, TheTongueLiesInTheLowerJaw) {
    const FacePose& pose = opened(0.8).pose;
    double tip = -1;
    Vec3 rest = Vec3::Zero(), now = Vec3::Zero();
    for (int v : vertices_of("tongue"))
        if (head().vertices(v, 2) > tip) {
            tip = head().vertices(v, 2);
            rest = head().vertices.row(v).transpose();
            now = pose.vertices.row(v).transpose();
        }
    EXPECT_LT(now.y() - rest.y(), -10e-3);
}

double tongue_tip_m(const FacePose& pose, int axis) {
    double max = -1;
    for (int v : vertices_of("tongue")) max = std::max(max, pose.vertices(v, axis));
    return max;
}

TEST(JawOpening, LetsTheTongueOutWhichShutTeethHoldBack) {
    const double rest = tongue_tip_m(equilibrium_pose(face(), neutral()), 2);
    const track::Drive shut = with_kinematic(Kinematic::kTongueOut, 1.0);
    EXPECT_LT(tongue_tip_m(equilibrium_pose(face(), shut), 2), rest + 6e-3);
    const FacePose open = equilibrium_pose(face(), with_kinematic(Kinematic::kJawOpen, 0.4, shut));
    const double range = 1e-3 * rig::adult().rig.facs.ranges.tongue_out_mm;
    EXPECT_GT(tongue_tip_m(open, 2), rest + 0.5 * range);
    EXPECT_LT(tongue_tip_m(open, 2), rest + range);
    // Over the lower lip, not through it
    const double lip = at(open.vertices, "stoi").y();
    for (int v : vertices_of("tongue")) {
        const Vec3 p = open.vertices.row(v).transpose();
        const Vec3 from_lip = p - at(open.vertices, "stoi");
        if (std::abs(from_lip.z()) < 2e-3 && std::abs(p.x()) < 4e-3) {
            EXPECT_GT(p.y(), lip - 2e-3);
        }
    }
}

TEST(JawOpening, TheTongueLiftsItsTip) {
    const track::Drive open = with_kinematic(Kinematic::kJawOpen, 0.5);
    const auto foremost_y = [&](const FacePose& pose) {
        double z = -1, y = 0;
        for (int v : vertices_of("tongue"))
            if (head().vertices(v, 2) > z) {
                z = head().vertices(v, 2);
                y = pose.vertices(v, 1);
            }
        return y;
    };
    const double level = foremost_y(opened(0.5).pose);
    EXPECT_GT(foremost_y(equilibrium_pose(face(), with_kinematic(Kinematic::kTongueUp, 1.0, open))),
              level + 6e-3);
    EXPECT_LT(
        foremost_y(equilibrium_pose(face(), with_kinematic(Kinematic::kTongueUp, -1.0, open))),
        level - 3e-3);
}

}  // namespace
}  // namespace risorius::face
