// SPDX-License-Identifier: MIT
// Lids close, open again, and slide over the eye without entering it.
#include "risorius/face/anatomy/lids.h"

#include <gtest/gtest.h>

#include "face/adult_face.h"
#include "risorius/face/anatomy/lid_measures.h"
#include "risorius/face/skin/detail/lid_pull.h"

namespace risorius::face {
namespace {

using track::Kinematic;

track::Drive gaze(double yaw_deg, double pitch_deg, track::Drive drive = neutral()) {
    drive = with_kinematic(Kinematic::kGazeYawLeft, yaw_deg, drive);
    drive = with_kinematic(Kinematic::kGazeYawRight, yaw_deg, drive);
    drive = with_kinematic(Kinematic::kGazePitchLeft, pitch_deg, drive);
    return with_kinematic(Kinematic::kGazePitchRight, pitch_deg, drive);
}

/// The largest stretch, mm, along which the eye's centre looks out between the lids.
double max_gap_mm(const rig::Head& head, const EyeLids& lids, const Points& vertices) {
    return 1e3 * max_lid_gap_m(head, lids, vertices);
}

class Lids : public testing::Test {
  protected:
    static Face& face() {
        static Face one = adult_face();
        return one;
    }
    /// Height of the upper margin over the lower one in the middle of the eye, mm.
    static double gap_mm(const FacePose& pose, const std::string& side) {
        return 1e3 * (at(pose.vertices, "ps" + side).y() - at(pose.vertices, "pi" + side).y());
    }
    /// The larger of both eyes' largest gaps.
    static double gaps_mm(const FacePose& pose) {
        double largest = 0;
        for (int side = 0; side < 2; ++side)
            largest = std::max(
                largest,
                max_gap_mm(face().head(), EyeLids(face().head(), side, 0.96), pose.vertices));
        return largest;
    }
    /// How much deeper than at rest the skin around an eye reaches into the eye's surface, mm.
    static double beyond_rest_mm(const FacePose& pose) {
        return 1e3 * depth_in_eyes_m(face().head(), pose.eye_rotation, pose.vertices);
    }
};

TEST_F(Lids, ABlinkClosesBothEyesFromCanthusToCanthus) {
    const FacePose open = equilibrium_pose(face(), neutral());
    EXPECT_GT(gap_mm(open, "_l"), 8);
    for (const char* unit : {"AU43", "AU45"}) {
        EXPECT_LT(gaps_mm(equilibrium_pose(face(), with_unit(unit))), 0.3) << unit;
        EXPECT_EQ(face().diagnostics().inverted_tets(), 0) << unit;
    }
    for (const auto& [yaw, pitch] : {std::pair{0., -30.}, {30., 20.}})
        EXPECT_LT(gaps_mm(equilibrium_pose(face(), gaze(yaw, pitch, with_unit("AU45")))), 0.3)
            << "over an eye turned " << yaw << " " << pitch;
}

TEST_F(Lids, HalfABlinkLeavesHalfTheFissure) {
    const double open = gaps_mm(equilibrium_pose(face(), neutral())),
                 half = gaps_mm(equilibrium_pose(face(), with_unit("AU45", 0.5)));
    EXPECT_GT(half, 0.3 * open);
    EXPECT_LT(half, 0.6 * open);
}

TEST_F(Lids, ABlinkLeavesTheCanthiWhereTheirTendonsHoldThem) {
    const Points moved = moved_mm(face(), equilibrium_pose(face(), with_unit("AU45")));
    for (const char* id : {"en_l", "en_r", "ex_l", "ex_r"})
        EXPECT_LT(at(moved, id).norm(), 2.0) << id;
}

TEST_F(Lids, LidsGoAlongWithAnEyeThatLooksAside) {
    const Points left = moved_mm(face(), equilibrium_pose(face(), gaze(30, 0)));
    for (const char* id : {"ps_l", "ps_r", "pi_l", "pi_r"}) EXPECT_GT(at(left, id).x(), 0.5) << id;
}

TEST_F(Lids, WithoutItsLevatorALidFallsAlmostShut) {
    const FacePose pose = equilibrium_pose(face(), with_muscle("levator_palpebrae_superioris", -1));
    EXPECT_LT(gap_mm(pose, "_l"), 1.0);
    EXPECT_LT(gap_mm(pose, "_r"), 1.0);
}

TEST_F(Lids, OneEyeWinksAlone) {
    const FacePose pose =
        equilibrium_pose(face(), with_muscle("levator_palpebrae_superioris", -1, Side::kLeft));
    const FacePose open = equilibrium_pose(face(), neutral());
    EXPECT_LT(gap_mm(pose, "_l"), 1.0);
    EXPECT_NEAR(gap_mm(pose, "_r"), gap_mm(open, "_r"), 0.05);
}

// The crease of the upper lid lies behind the line from the margin to the brow. Skin that a shut lid needs comes from it.
TEST_F(Lids, AShutLidUnfoldsItsCrease) {
    const auto depth_mm = [](const FacePose& pose, const std::string& side) {
        const Vec3 margin = at(pose.vertices, "ps" + side), brow = at(pose.vertices, "bc" + side),
                   crease = at(pose.vertices, "ucr" + side);
        const double part = (crease.y() - margin.y()) / (brow.y() - margin.y());
        return 1e3 * ((1 - part) * margin.z() + part * brow.z() - crease.z());
    };
    const FacePose open = equilibrium_pose(face(), neutral()),
                   shut = equilibrium_pose(face(), with_unit("AU45"));
    for (const char* side : {"_l", "_r"}) EXPECT_LT(depth_mm(shut, side), depth_mm(open, side));
}

TEST_F(Lids, AfterABlinkTheFaceIsAsBefore) {
    // Lids ride on their plates, so they come back to the micrometre though the tissue needs a moment.
    const track::Drive shut = with_unit("AU45");
    const DriveAt blink = [&](double t) { return t < 0.3 ? shut : neutral(); };
    face().start(always(neutral()));
    for (int i = 0; i < 15; ++i) face().step(blink);
    EXPECT_LT(gap_mm(face().pose(), "_l"), 1.5);
    for (int i = 0; i < 150; ++i) face().step(blink);
    const Points left = moved_mm(face(), face().pose());
    for (const char* id : {"ps_l", "pi_l", "ps_r", "pi_r"}) EXPECT_LT(at(left, id).norm(), 1e-3);
    EXPECT_LT(left.rowwise().norm().maxCoeff(), 0.05);
}

TEST_F(Lids, TheLevatorOpensTheEyeWide) {
    const FacePose wide = equilibrium_pose(face(), with_unit("AU5")),
                   open = equilibrium_pose(face(), neutral());
    EXPECT_GT(gap_mm(wide, "_l"), gap_mm(open, "_l") + 1.5);
}

TEST_F(Lids, TheUpperLidFollowsTheGazeUpAndDown) {
    const Points down = moved_mm(face(), equilibrium_pose(face(), gaze(0, -30))),
                 up = moved_mm(face(), equilibrium_pose(face(), gaze(0, 30)));
    EXPECT_LT(at(down, "ps_l").y(), -3);
    EXPECT_LT(at(down, "pi_l").y(), -0.5);
    EXPECT_GT(at(up, "ps_l").y(), 1.5);
    EXPECT_GT(at(up, "pi_l").y(), 0.3);
    EXPECT_GT(std::abs(at(down, "ps_l").y()), std::abs(at(down, "pi_l").y()));
}

TEST_F(Lids, NoLidEntersItsEye) {
    for (const char* unit : {"AU45", "AU43", "AU5", "AU6", "AU7"})
        EXPECT_LT(beyond_rest_mm(equilibrium_pose(face(), with_unit(unit))), 0.2) << unit;
    for (const auto& [yaw, pitch] :
         {std::pair{0., 30.}, {0., -40.}, {40., 0.}, {-40., 0.}, {30., -25.}, {-25., 25.}}) {
        EXPECT_LT(beyond_rest_mm(equilibrium_pose(face(), gaze(yaw, pitch))), 0.2)
            << yaw << " " << pitch;
        EXPECT_LT(beyond_rest_mm(equilibrium_pose(face(), gaze(yaw, pitch, with_unit("AU45")))),
                  0.2)
            << "closed over an eye turned " << yaw << " " << pitch;
    }
}

TEST_F(Lids, EachBrowUnitMovesItsOwnPartOfTheBrow) {
    const Points inner = moved_mm(face(), equilibrium_pose(face(), with_unit("AU1"))),
                 outer = moved_mm(face(), equilibrium_pose(face(), with_unit("AU2"))),
                 lowered = moved_mm(face(), equilibrium_pose(face(), with_unit("AU4")));
    EXPECT_GT(at(inner, "bm_l").y(), 3);
    EXPECT_LT(at(inner, "bl_l").y(), 0.4 * at(inner, "bm_l").y());
    EXPECT_GT(at(outer, "bp_l").y(), 3);
    EXPECT_GT(at(outer, "bl_l").y(), 1.5);
    EXPECT_LT(at(lowered, "bm_l").y(), -1.5);
    EXPECT_LT(at(lowered, "bp_l").x(), -1.5) << "corrugator draws the brow inwards";
}

TEST(TarsalPlates, MarginsAreMeasuredOnTheMesh) {
    for (int side = 0; side < 2; ++side) {
        const EyeLids lids(rig::adult_placed(), side, 0.96);
        const std::string suffix = side == 0 ? "_l" : "_r";
        const auto off_mm = [&](const std::string& id, bool upper) {
            const Vec3 p = rig::adult_placed().landmark(id + suffix);
            const double s = lids.place_of(p);
            const double margin = upper ? lids.upper_angle(s) : lids.lower_angle(s);
            return 1e3 * rig::adult_placed().eyes[side].radius_m * (lids.angle_of(p) - margin);
        };
        for (const char* id : {"ulm", "ps", "ull"}) EXPECT_NEAR(off_mm(id, true), 0, 1.5) << id;
        for (const char* id : {"llm", "pi", "lll"}) EXPECT_NEAR(off_mm(id, false), 0, 1.5) << id;
        EXPECT_NEAR(1e3 * lids.zone_m() * (lids.upper_angle(0.45) - lids.lower_angle(0.45)),
                    max_gap_mm(rig::adult_placed(), lids, rig::adult_placed().vertices), 1.0);
    }
}

LidMember on_margin(bool upper, double place) {
    return {
        .upper = upper, .place = place, .height = 0, .fraction = upper ? 1.0 : 0.0, .beyond = 0};
}

TEST(TarsalPlates, MarginsMeetWhenClosedWhereverTheySlide) {
    const EyeLids lids(rig::adult_placed(), 0, 0.96);
    for (const LidPose& pose : {LidPose{.upper_closure = 1, .lower_closure = 1},
                                LidPose{.upper_closure = 1, .lower_closure = 1, .inward = 1},
                                LidPose{.upper_closure = 1,
                                .lower_closure = 1,
                                .upper_gaze_rad = 0.1,
                                .lower_gaze_rad = 0.1,
                                .inward = 1,
                                .aside_rad = 0.1}}) {
        // Angles at which the moved margins pass a place, from margin points on either side of it
        const auto passes = [&](const std::vector<Vec3>& margin, bool upper, double place) {
            double best = 1e9, angle = 0;
            for (const Vec3& p : margin) {
                const double s = lids.place_of(p);
                const Vec3 rest = p;
                const double off =
                    (upper ? lids.upper_angle(s) : lids.lower_angle(s)) - lids.angle_of(rest);
                const Vec3 moved = rest + lids.ride(rest, on_margin(upper, s), pose);
                if (std::abs(lids.place_of(moved) - place) > best) continue;
                best = std::abs(lids.place_of(moved) - place);
                angle = lids.angle_of(moved) + off;
            }
            return angle;
        };
        for (double place : {0.2, 0.35, 0.5, 0.65, 0.8})
            EXPECT_NEAR(passes(lids.upper_margin(), true, place),
                        passes(lids.lower_margin(), false, place), 0.06)
                << place;
    }
}

TEST(TarsalPlates, TheWayIsSharedBetweenTheLids) {
    const EyeLids lids(rig::adult_placed(), 0, 0.96);
    const Vec3 top = rig::adult_placed().landmark("ps_l"),
               bottom = rig::adult_placed().landmark("pi_l");
    const LidPose closed{.upper_closure = 1, .lower_closure = 1};
    const double down = lids.ride(top, on_margin(true, 0.5), closed).norm(),
                 rise = lids.ride(bottom, on_margin(false, 0.5), closed).norm();
    EXPECT_NEAR(down / (down + rise), 0.96, 0.02);
    EXPECT_EQ(lids.ride(top, on_margin(true, 0.5), {}).norm(), 0.0);
}

TEST(TarsalPlates, ALidThatOnlyTurnsKeepsItsDistanceToTheEyeCentre) {
    const EyeLids lids(rig::adult_placed(), 0, 0.96);
    for (double closure : {0.3, 0.7, 1.0})
        for (const Vec3& p : lids.upper_margin()) {
            const Vec3 q =
                p + lids.ride(p, on_margin(true, lids.place_of(p)), {.upper_closure = closure});
            EXPECT_NEAR((q - lids.centre()).norm(), (p - lids.centre()).norm(), 1e-12);
        }
}

TEST(TarsalPlates, APlateEndsAtCreaseAndCanthi) {
    const EyeLids lids(rig::adult_placed(), 0, 0.96);
    const auto firmness = [&](const Vec3& p) {
        return EyeLids::firmness(lids.member(p), 0.4, 1.15, 0.2, 0.65);
    };
    EXPECT_EQ(firmness(rig::adult_placed().landmark("bm_l")), 0.0);
    EXPECT_GT(firmness(rig::adult_placed().landmark("ps_l")), 0.9);
    EXPECT_GT(firmness(rig::adult_placed().landmark("pi_l")), 0.9);
    const Vec3 outwards = rig::adult_placed().landmark("ex_l") + 8e-3 * lids.axis();
    EXPECT_EQ(firmness(outwards), 0.0);
    const LidPose closed{.upper_closure = 1, .lower_closure = 1, .inward = 1};
    EXPECT_LT(lids.ride(outwards, lids.member(outwards), closed).norm(), 2.5e-3);
}

class MeasuredHeads : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredHeads, ShutTheirEyes) {
    const auto test = GetParam() == std::string("ict") ? rig::ict_head() : rig::makehuman_head();
    if (!test) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    Face face(test->rig, test->mesh, {"test", 400, 6}, GetParam());
    const FacePose pose = equilibrium_pose(face, with_unit("AU45"));
    // Up and aside the eyes pull their lids furthest apart
    const FacePose aside = equilibrium_pose(face, gaze(-30, 20, with_unit("AU45")));
    for (int side = 0; side < 2; ++side) {
        const EyeLids lids(face.head(), side, 0.96);
        EXPECT_GT(max_gap_mm(face.head(), lids, face.head().vertices), 6);
        EXPECT_LT(max_gap_mm(face.head(), lids, pose.vertices), 0.3);
        EXPECT_LT(max_gap_mm(face.head(), lids, aside.vertices), 0.3);
    }
}

INSTANTIATE_TEST_SUITE_P(Lids, MeasuredHeads, testing::Values("ict", "makehuman"));

// FACS asks for a narrower eye in AU4, AU6, AU9 and AU12, by skin that brow and cheek push before them.
TEST_F(Lids, BrowAndCheekNarrowTheEye) {
    const double open_mm = gap_mm(equilibrium_pose(face(), neutral()), "_l");
    for (const char* unit : {"AU4", "AU6", "AU9", "AU12"}) {
        const double narrower_mm =
            open_mm - gap_mm(equilibrium_pose(face(), with_unit(unit)), "_l");
        EXPECT_GT(narrower_mm, 0.9) << unit;
        EXPECT_LT(narrower_mm, 4) << unit;
    }
    for (const char* unit : {"AU1", "AU2", "AU15", "AU26"})
        EXPECT_NEAR(gap_mm(equilibrium_pose(face(), with_unit(unit)), "_l"), open_mm, 0.3) << unit;
}

TEST_F(Lids, TheGradientOfTheirPullIsItsDerivative) {
    const rig::Head& head = face().head();
    const LidPullMeasure measure(head, rig::EyesDescription{});
    const Points skin = equilibrium_pose(face(), with_unit("AU4", 0.7)).vertices;
    const std::array<LidPull, 2> slope{LidPull{0.3, -1.1}, LidPull{0.7, 0.4}};
    const auto value = [&](const Points& at) {
        double sum = 0;
        const std::array<LidPull, 2> pull = measure.of(at);
        for (std::size_t side = 0; side < 2; ++side)
            sum +=
                slope[side].upper_m * pull[side].upper_m + slope[side].lower_m * pull[side].lower_m;
        return sum;
    };
    Points gradient = Points::Zero(skin.rows(), 3);
    measure.add_gradient(skin, slope, gradient);
    Points way = Points::Zero(skin.rows(), 3);
    for (long v = 0; v < way.rows(); ++v) way(v, 1) = 1e-5 * std::sin(0.7 * static_cast<double>(v));
    const double change = (value(skin + way) - value(skin - way)) / 2;
    ASSERT_GT(std::abs(change), 1e-9);
    EXPECT_NEAR(gradient.cwiseProduct(way).sum(), change, 1e-4 * std::abs(change));
}

}  // namespace
}  // namespace risorius::face
