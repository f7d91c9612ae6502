// Lids close, open again, and slide over the eye without entering it.
#include "sim/lids.h"

#include <gtest/gtest.h>

#include "sim/adult_face.h"

namespace risorius::sim {
namespace {

using track::Kinematic;

track::Drive gaze(double yaw_deg, double pitch_deg, track::Drive drive = neutral()) {
    drive = with_kinematic(Kinematic::kGazeYawLeft, yaw_deg, drive);
    drive = with_kinematic(Kinematic::kGazeYawRight, yaw_deg, drive);
    drive = with_kinematic(Kinematic::kGazePitchLeft, pitch_deg, drive);
    return with_kinematic(Kinematic::kGazePitchRight, pitch_deg, drive);
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
    /// How much deeper than at rest the skin around an eye reaches into the eye's surface, mm.
    static double beyond_rest_mm(const FacePose& pose) {
        double worst = 0;
        const rig::Head& head = face().head();
        const auto angle = [](const Vec3& a, const Vec3& b) {
            return std::atan2(a.cross(b).norm(), a.dot(b));
        };
        for (int side = 0; side < 2; ++side) {
            const rig::EyeGeometry& eye = head.eyes[side];
            const Vec3 looks = pose.eye_rotation[side] * eye.forward;
            for (long v = 0; v < head.vertices.rows(); ++v) {
                if (head.carrier[v] != rig::Carrier::kSkin) continue;
                const Vec3 before = head.vertices.row(v).transpose() - eye.centre,
                           now = pose.vertices.row(v).transpose() - eye.centre;
                if (before.norm() > eye.radius_m + 8e-3 || before.z() < 0) continue;
                const double at_rest = before.norm() - eye.profile_at(angle(before, eye.forward));
                const double depth = now.norm() - eye.profile_at(angle(now, looks));
                worst = std::max(worst, std::min(0.0, at_rest) - depth);
            }
        }
        return 1e3 * worst;
    }
};

TEST_F(Lids, ABlinkClosesBothEyes) {
    const FacePose open = settled(face(), neutral());
    EXPECT_GT(gap_mm(open, "_l"), 8);
    for (const char* unit : {"AU43", "AU45"}) {
        const FacePose closed = settled(face(), with_unit(unit));
        for (const char* side : {"_l", "_r"}) EXPECT_LT(gap_mm(closed, side), 0.6) << unit << side;
    }
}

TEST_F(Lids, WithoutItsLevatorALidFallsAlmostShut) {
    const FacePose pose = settled(face(), with_muscle("levator_palpebrae_superioris", -1));
    EXPECT_LT(gap_mm(pose, "_l"), 1.0);
    EXPECT_LT(gap_mm(pose, "_r"), 1.0);
}

TEST_F(Lids, OneEyeWinksAlone) {
    const FacePose pose =
        settled(face(), with_muscle("levator_palpebrae_superioris", -1, Side::kLeft));
    const FacePose open = settled(face(), neutral());
    EXPECT_LT(gap_mm(pose, "_l"), 1.0);
    EXPECT_NEAR(gap_mm(pose, "_r"), gap_mm(open, "_r"), 0.05);
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
    const FacePose wide = settled(face(), with_unit("AU5")), open = settled(face(), neutral());
    EXPECT_GT(gap_mm(wide, "_l"), gap_mm(open, "_l") + 1.5);
}

TEST_F(Lids, TheUpperLidFollowsTheGazeUpAndDown) {
    const Points down = moved_mm(face(), settled(face(), gaze(0, -30))),
                 up = moved_mm(face(), settled(face(), gaze(0, 30)));
    EXPECT_LT(at(down, "ps_l").y(), -3);
    EXPECT_LT(at(down, "pi_l").y(), -0.5);
    EXPECT_GT(at(up, "ps_l").y(), 1.5);
    EXPECT_GT(at(up, "pi_l").y(), 0.3);
    EXPECT_GT(std::abs(at(down, "ps_l").y()), std::abs(at(down, "pi_l").y()));
}

TEST_F(Lids, NoLidEntersItsEye) {
    for (const char* unit : {"AU45", "AU43", "AU5", "AU6", "AU7"})
        EXPECT_LT(beyond_rest_mm(settled(face(), with_unit(unit))), 0.2) << unit;
    for (const auto& [yaw, pitch] :
         {std::pair{0., 30.}, {0., -40.}, {40., 0.}, {-40., 0.}, {30., -25.}, {-25., 25.}}) {
        EXPECT_LT(beyond_rest_mm(settled(face(), gaze(yaw, pitch))), 0.2) << yaw << " " << pitch;
        EXPECT_LT(beyond_rest_mm(settled(face(), gaze(yaw, pitch, with_unit("AU45")))), 0.2)
            << "closed over an eye turned " << yaw << " " << pitch;
    }
}

TEST(TarsalPlates, MarginsMeetWhenClosed) {
    for (int side = 0; side < 2; ++side) {
        const EyeLids lids(rig::adult_placed(), side, 0.96);
        const LidPose closed{1.0, 1.0, 0.0, 0.0};
        const std::string suffix = side == 0 ? "_l" : "_r";
        const Vec3 up = lids.axis().cross(Vec3::UnitZ()).normalized();
        for (const auto& [upper, lower] : {std::pair{"ulm", "llm"}, {"ps", "pi"}, {"ull", "lll"}}) {
            const auto after = [&](const std::string& id, bool is_upper) {
                const Vec3 rest = rig::adult_placed().landmark(id + suffix);
                const LidMember member = lids.classify(rest, 2e-3, 4e-3, 3e-3);
                EXPECT_EQ(member.upper, is_upper) << id;
                EXPECT_GT(member.weight, 0.7) << id;
                return Vec3(rest + lids.ride(rest, is_upper, member.place, closed));
            };
            const Vec3 top = after(upper, true), bottom = after(lower, false);
            // Thirds of the upper and lower margin need not stand over each other; their heights tell.
            EXPECT_LT(std::abs((top - bottom).dot(up)), 1e-3) << upper << suffix;
        }
    }
}

TEST(TarsalPlates, TheWayIsSharedBetweenTheLids) {
    const EyeLids lids(rig::adult_placed(), 0, 0.96);
    const Vec3 top = rig::adult_placed().landmark("ps_l"),
               bottom = rig::adult_placed().landmark("pi_l");
    const double down = lids.ride(top, true, 0.5, {1, 1, 0, 0}).norm(),
                 rise = lids.ride(bottom, false, 0.5, {1, 1, 0, 0}).norm();
    EXPECT_NEAR(down / (down + rise), 0.96, 0.02);
    EXPECT_EQ(lids.ride(top, true, 0.5, {0, 0, 0, 0}).norm(), 0.0);
}

TEST(TarsalPlates, ALidKeepsItsDistanceToTheEyeCentre) {
    const EyeLids lids(rig::adult_placed(), 0, 0.96);
    for (double closure : {-0.2, 0.3, 0.7, 1.0})
        for (const Vec3& p : lids.upper_margin()) {
            const Vec3 q = p + lids.ride(p, true, 0.5, {closure, 0, 0, 0});
            EXPECT_NEAR((q - lids.centre()).norm(), (p - lids.centre()).norm(), 1e-12);
        }
}

TEST(TarsalPlates, TheCanthiHoldStill) {
    const EyeLids lids(rig::adult_placed(), 0, 0.96);
    for (const char* id : {"en_l", "ex_l"})
        EXPECT_LT(lids.classify(rig::adult_placed().landmark(id), 2e-3, 4e-3, 3e-3).weight, 0.05)
            << id;
    EXPECT_EQ(lids.classify(rig::adult_placed().landmark("bm_l"), 2e-3, 4e-3, 3e-3).weight, 0.0);
}

}  // namespace
}  // namespace risorius::sim
