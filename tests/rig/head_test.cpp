// SPDX-License-Identifier: MIT
// A placed head knows each of its vertices: what is skin, what turns with an eye, what goes with the jaw.
#include "risorius/rig/head.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "rig/heads.h"

namespace risorius::rig {
namespace {

std::set<int> vertices_of(const geom::PolygonMesh& mesh, const std::string& group) {
    std::set<int> out;
    const int index = mesh.group_index(group);
    for (int f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_group[f] == index)
            out.insert(mesh.corner_vertex.begin() + mesh.face_begin[f],
                       mesh.corner_vertex.begin() + mesh.face_begin[f + 1]);
    return out;
}

int count(const Head& head, Carrier carrier) {
    return static_cast<int>(std::count(head.carrier.begin(), head.carrier.end(), carrier));
}

TEST(AdultHead, EveryPartIsCarriedByWhatItBelongsTo) {
    const std::map<std::string, Carrier> expected{
        {"skin", Carrier::kSkin},         {"mouth", Carrier::kSkin},
        {"eye_l", Carrier::kEyeLeft},     {"eye_r", Carrier::kEyeRight},
        {"teeth_upper", Carrier::kSkull}, {"teeth_lower", Carrier::kMandible},
        {"gums_upper", Carrier::kSkull},  {"gums_lower", Carrier::kMandible},
        {"tongue", Carrier::kTongue},     {"lashes_l", Carrier::kLashes},
        {"lashes_r", Carrier::kLashes}};
    for (const auto& [group, carrier] : expected) {
        const std::set<int> members = vertices_of(adult().mesh, group);
        EXPECT_FALSE(members.empty()) << group;
        for (int v : members) ASSERT_EQ(adult_placed().carrier[v], carrier) << group << " " << v;
    }
    for (int v : vertices_of(adult().mesh, "teeth_lower"))
        ASSERT_EQ(adult_placed().jaw_fraction[v], 1.0);
    for (int v : vertices_of(adult().mesh, "teeth_upper"))
        ASSERT_EQ(adult_placed().jaw_fraction[v], 0.0);
}

TEST(AdultHead, EyesAreSpheresOfHumanSizeLookingForward) {
    for (int side = 0; side < 2; ++side) {
        const EyeGeometry& eye = adult_placed().eyes[side];
        ASSERT_TRUE(eye.present);
        EXPECT_NEAR(eye.radius_m, 11.5e-3, 0.2e-3);
        EXPECT_NEAR(eye.centre.x(), (side == 0 ? 1 : -1) * 31.5e-3, 0.5e-3);
        EXPECT_GT(eye.forward.z(), 0.9);
        // The cornea stands out in front of the globe, and only there.
        EXPECT_GT(eye.profile_at(0), eye.radius_m + 0.3e-3);
        EXPECT_LT(eye.profile_at(0), eye.radius_m + 2.5e-3);
        EXPECT_NEAR(eye.profile_at(1.3), eye.radius_m, 0.15e-3);
        for (double angle = 0; angle < 1.57; angle += 0.1)
            EXPECT_GE(eye.profile_at(angle), eye.radius_m - 1e-9);
    }
    EXPECT_NEAR(adult_placed().eyes[0].radius_m, adult_placed().eyes[1].radius_m, 1e-6);
}

TEST(AdultHead, TheProfileEnclosesTheWholeEye) {
    for (int side = 0; side < 2; ++side) {
        const EyeGeometry& eye = adult_placed().eyes[side];
        double out = 0;
        for (int v : vertices_of(adult().mesh, side == 0 ? "eye_l" : "eye_r")) {
            const Vec3 r = adult_placed().vertices.row(v).transpose() - eye.centre;
            const double angle = std::atan2(r.cross(eye.forward).norm(), r.dot(eye.forward));
            if (angle < 1.5) out = std::max(out, r.norm() - eye.profile_at(angle));
        }
        EXPECT_LT(out, 0.15e-3) << "the eye stands out of its own profile";
    }
}

TEST(AdultHead, UpperTeethAreBehindTheLips) {
    const Head& head = adult_placed();
    EXPECT_TRUE(head.has_teeth);
    const double lip = head.landmark("sto").z();
    EXPECT_LT(head.teeth_front_m, lip);
    EXPECT_GT(head.teeth_front_m, lip - 12e-3);
}

TEST(AdultHead, WithoutEyesAndTeethTheyAreEstimated) {
    RigDescription rig = adult().rig;
    for (const char* role : {"eye_l", "eye_r", "teeth_upper", "teeth_lower"}) rig.parts.erase(role);
    const Head head = place_head(rig, adult().mesh, "adult");
    EXPECT_FALSE(head.has_teeth);
    for (int side = 0; side < 2; ++side) {
        EXPECT_FALSE(head.eyes[side].present);
        EXPECT_LT((head.eyes[side].centre - adult_placed().eyes[side].centre).norm(), 6e-3);
        EXPECT_EQ(head.eyes[side].profile_m.size(), 91u);
    }
    EXPECT_NEAR(head.teeth_front_m, adult_placed().teeth_front_m, 5e-3);
}

TEST(AdultHead, SeamsAreWeldedAndLipsAreNot) {
    const Head& head = adult_placed();
    for (std::size_t v = 0; v < head.welded.size(); ++v) {
        EXPECT_EQ(head.welded[head.welded[v]], head.welded[v]);
        EXPECT_LT(
            (head.vertices.row(static_cast<long>(v)) - head.vertices.row(head.welded[v])).norm(),
            2e-6);
    }
    const int upper = adult().vertex("stos"), lower = adult().vertex("stoi");
    EXPECT_NE(head.welded[upper], head.welded[lower]);
}

TEST(AdultHead, TheSameHeadIsFoundHoweverItsMeshLies) {
    // Moved, turned and in other units, the head is the same in its own frame.
    TestHead moved = adult();
    const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    moved.mesh.positions = 0.1 * (moved.mesh.positions * turn.transpose());
    moved.mesh.positions.rowwise() += Vec3(40, -3, 12).transpose();
    moved.rig.metres_per_unit = 0.01;
    const Head head = place_head(moved.rig, moved.mesh, "moved");
    EXPECT_NEAR(head.size, adult_placed().size, 1e-9);
    EXPECT_LT((head.vertices - adult_placed().vertices).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(head.carrier, adult_placed().carrier);
}

TEST(AdultHead, ASmallerHeadIsTheSameHeadSmaller) {
    TestHead child = adult();
    child.rig.metres_per_unit *= 0.8;
    const Head head = place_head(child.rig, child.mesh, "child");
    EXPECT_NEAR(head.size, 0.8 * adult_placed().size, 1e-9);
    EXPECT_LT((head.vertices - 0.8 * adult_placed().vertices).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(head.mm(10), 0.8 * adult_placed().mm(10), 1e-9);
}

/// Leaves out ten landmarks that are not required and says how far off they are found, m: mean and worst.
std::pair<double, double> completion_error(const TestHead& test) {
    const std::vector<std::string> left_out{"bp_l",  "mc_l",  "nl2_l", "zy_r",  "gn",
                                            "pjm_r", "cph_l", "or_r",  "fml_l", "mar_r"};
    const Head whole = place_head(test.rig, test.mesh, "whole");
    RigDescription rig = test.rig;
    for (const std::string& id : left_out) EXPECT_EQ(rig.landmarks.erase(id), 1u) << id;
    const Head head = place_head(rig, test.mesh, "part");
    EXPECT_EQ(head.warped_landmarks.size(), whole.warped_landmarks.size() + 10);
    double sum = 0, worst = 0;
    for (const std::string& id : left_out) {
        // The two frames differ by what the ten landmarks weighed; compare in the mesh's own.
        const Points here = head.frame.to_mesh(Points(head.landmark(id).transpose())),
                     there = whole.frame.to_mesh(Points(whole.landmark(id).transpose()));
        const double off = test.rig.metres_per_unit * (here - there).norm();
        sum += off / 10;
        worst = std::max(worst, off);
    }
    return {sum, worst};
}

TEST(MissingLandmarks, AreFoundWithinMillimetresOnTheAdult) {
    const auto [mean, worst] = completion_error(adult());
    EXPECT_LT(mean, 2e-3);
    EXPECT_LT(worst, 5e-3);
    RecordProperty("mean_mm", std::to_string(1e3 * mean));
}

TEST(Head, RefusesAPairWhoseSidesAreSwapped) {
    RigDescription rig = adult().rig;
    std::swap(rig.landmarks["ch_l"], rig.landmarks["ch_r"]);
    try {
        place_head(rig, adult().mesh, "swapped");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "swapped:/landmarks/ch_l: expected a point on the subject's left of \"ch_r\", "
                     "found one on its right");
    }
}

TEST(MissingLandmarks, LieOnTheSkin) {
    RigDescription rig = adult().rig;
    for (const char* id : {"mc_l", "zy_r", "gn"}) rig.landmarks.erase(id);
    const Head head = place_head(rig, adult().mesh, "part");
    EXPECT_EQ(head.warped_landmarks, (std::vector<std::string>{"gn", "zy_r", "mc_l"}));
    for (const std::string& id : head.warped_landmarks) {
        double min = 1;
        for (long f = 0; f < head.skin.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                min = std::min(
                    min,
                    (head.vertices.row(head.skin(f, k)).transpose() - head.landmark(id)).norm());
        EXPECT_LT(min, 5e-4) << id;  // a vertex, or beside it on the surface
    }
}

TEST(MissingLandmarks, TheRequiredTwentyAreEnough) {
    RigDescription rig = adult().rig;
    const std::set<std::string> required(required_landmarks().begin(), required_landmarks().end());
    std::erase_if(rig.landmarks, [&](const auto& item) { return !required.count(item.first); });
    ASSERT_EQ(rig.landmarks.size(), 20u);
    const Head head = place_head(rig, adult().mesh, "sparse");
    EXPECT_EQ(head.landmarks.size(), 109u);
    double sum = 0;
    for (const auto& [id, p] : head.landmarks)
        sum += (head.frame.to_mesh(Points(p.transpose())).row(0).transpose() -
                adult_placed()
                    .frame.to_mesh(Points(adult_placed().landmark(id).transpose()))
                    .row(0)
                    .transpose())
                   .norm() *
               rig.metres_per_unit;
    EXPECT_LT(sum / 109, 5e-3);
}

TEST(MeasuredHeads, TheScannedMeanHeadIsPlaced) {
    const auto test = ict_head();
    if (!test) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const Head head = place_head(test->rig, test->mesh, "ict");
    EXPECT_NEAR(head.size, 1.0, 0.03);  // the atlas was measured on this head
    EXPECT_LT(head.frame.residual_m, 5e-3);
    for (int side = 0; side < 2; ++side) {
        ASSERT_TRUE(head.eyes[side].present);
        EXPECT_NEAR(head.eyes[side].radius_m, 14.8e-3, 0.5e-3);
        EXPECT_NEAR(std::abs(head.eyes[side].centre.x()), 31.2e-3, 1e-3);
    }
    // One group holds gums of both jaws and the tongue.
    EXPECT_GT(count(head, Carrier::kTongue), 50);
    double up = 0, down = 0;
    int ups = 0, downs = 0;
    for (int v : vertices_of(test->mesh, "gums_tongue")) {
        EXPECT_NE(head.carrier[v], Carrier::kNone);
        EXPECT_GE(head.jaw_fraction[v], 0.0);
        EXPECT_LE(head.jaw_fraction[v], 1.0);
        if (head.carrier[v] == Carrier::kSkull) up += head.vertices(v, 1), ++ups;
        if (head.carrier[v] == Carrier::kMandible) down += head.vertices(v, 1), ++downs;
    }
    ASSERT_GT(ups, 50);
    ASSERT_GT(downs, 50);
    EXPECT_GT(up / ups, down / downs + 8e-3) << "upper gums are not above the lower ones";
    const auto [mean, worst] = completion_error(*test);
    EXPECT_LT(mean, 4e-3);
    EXPECT_LT(worst, 10e-3);
}

TEST(MeasuredHeads, TeethOfOneGroupPartAtTheBite) {
    const auto test = ict_head();
    if (!test) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const Head head = place_head(test->rig, test->mesh, "ict");
    double up = 0, down = 0;
    int upper = 0, lower = 0;
    for (int v : vertices_of(test->mesh, "teeth")) {
        if (head.carrier[v] == Carrier::kSkull) up += head.vertices(v, 1), ++upper;
        if (head.carrier[v] == Carrier::kMandible) down += head.vertices(v, 1), ++lower;
    }
    EXPECT_GT(upper, 100);
    EXPECT_GT(lower, 100);
    EXPECT_NEAR(static_cast<double>(upper) / (upper + lower), 0.5, 0.2);
    EXPECT_GT(up / upper, down / lower + 6e-3) << "upper teeth are not above the lower ones";
}

TEST(MeasuredHeads, TheModelledHeadIsPlaced) {
    const auto test = makehuman_head();
    if (!test) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const Head head = place_head(test->rig, test->mesh, "makehuman");
    EXPECT_NEAR(head.size, 1.0, 0.15);
    EXPECT_LT(head.frame.residual_m, 8e-3);
    for (int side = 0; side < 2; ++side) {
        ASSERT_TRUE(head.eyes[side].present);
        EXPECT_GT(head.eyes[side].radius_m, 10e-3);
        EXPECT_LT(head.eyes[side].radius_m, 16e-3);
    }
    EXPECT_GT(count(head, Carrier::kMandible), 50);
    EXPECT_GT(count(head, Carrier::kSkull), 50);
    const auto [mean, worst] = completion_error(*test);
    EXPECT_LT(mean, 5e-3);
    EXPECT_LT(worst, 12e-3);
}

}  // namespace
}  // namespace risorius::rig
