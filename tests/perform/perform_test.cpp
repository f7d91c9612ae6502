// SPDX-License-Identifier: MIT
// Pictures of a rendered face as those of a camera: what drives them is found again. What needs the weights of the face network is
// skipped where tools/web/fetch_weights.sh has not fetched them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "face/adult_face.h"
#include "paths.h"
#include "risorius/perform/detail/corrected_readout.h"
#include "risorius/perform/detail/one_euro.h"
#include "risorius/perform/performer.h"
#include "risorius/perform/rig_reader.h"

namespace risorius::perform {
namespace {

const std::filesystem::path kWeights =
    std::filesystem::path(RISORIUS_BINARY_DIR) / "web" / "facemesh";

TEST(OneEuro, CalmsRestAndFollowsFastMotion) {
    std::mt19937 random(3);
    const auto noise = [&] { return 0.02 * ((random() >> 8) * 0x1p-23 - 1); };
    OneEuro still;
    double largest = 0, before = 0;
    for (int i = 0; i < 300; ++i) {
        const double value = still(0.5 + noise(), i / 30.0);
        if (i > 30) largest = std::max(largest, std::abs(value - before));
        before = value;
    }
    EXPECT_LT(largest, 0.008);  // of 0.04
    OneEuro fast;
    double at_200_ms = 0;
    for (int i = 0; i <= 6; ++i) at_200_ms = fast(i == 0 ? 0 : 1, i / 30.0);
    EXPECT_GT(at_200_ms, 0.85);
    OneEuro constant;
    EXPECT_EQ(constant(0.3, 1), 0.3);
    EXPECT_EQ(constant(0.7, 1), 0.3);  // the time has not moved
}

TEST(RigReader, TurnsTheCurveOfAChannelRound) {
    RigReader reader;
    reader.channels.resize(1);
    reader.curves.resize(1, RigReader::kLevels);
    // Little is read of the second half.
    for (int level = 1; level <= RigReader::kLevels; ++level) {
        const double v = static_cast<double>(level) / RigReader::kLevels;
        reader.curves(0, level - 1) = v <= 0.5 ? v : 0.5 + 0.4 * (v - 0.5);
    }
    for (const double v : {0.0, 0.1, 0.5}) EXPECT_NEAR(reader.value(0, v), v, 1e-12);
    for (const double v : {0.6, 0.8, 1.0})
        EXPECT_NEAR(reader.value(0, 0.5 + 0.4 * (v - 0.5)), v, 1e-12);
    EXPECT_EQ(reader.value(0, -0.2), 0);
    EXPECT_EQ(reader.value(0, 3), 1);
}

TEST(CorrectedReadout, ReadsWhatIsWantedAndChangesNothingElse) {
    std::mt19937 random(7);
    const auto matrix = [&](Eigen::Index rows, Eigen::Index columns) {
        Eigen::MatrixXd out(rows, columns);
        for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = (random() >> 8) * 0x1p-23 - 1;
        return out;
    };
    const Eigen::MatrixXd w = matrix(4, 30), x = matrix(30, 3), wanted = matrix(4, 3);
    const Eigen::MatrixXd corrected = corrected_readout(w, x, wanted);
    EXPECT_LT((corrected * x - wanted).norm(), 1e-10);
    Eigen::MatrixXd other = matrix(30, 1);  // what no expression shows
    other -= x * (x.transpose() * x).inverse() * (x.transpose() * other);
    EXPECT_LT((corrected * other - w * other).norm(), 1e-10);
    EXPECT_EQ(corrected_readout(w, x.leftCols(0), wanted.leftCols(0)), w);
}

TEST(FaceShape, MotionOfTheHeadIsNoChangeOfTheShape) {
    std::mt19937 random(5);
    std::vector<Vec3> rest, now;
    for (int i = 0; i < landmarks::kFacePoints; ++i)
        rest.emplace_back(random() % 200, random() % 200, random() % 100);
    const double degree = std::numbers::pi / 180;
    const Mat3 turn = (Eigen::AngleAxisd(20 * degree, Vec3::UnitY()) *
                       Eigen::AngleAxisd(-10 * degree, Vec3::UnitX()) *
                       Eigen::AngleAxisd(-5 * degree, Vec3::UnitZ()))
                          .toRotationMatrix();
    for (const Vec3& p : rest) now.push_back(1.3 * (turn * p) + Vec3(40, -20, 3));
    const Vec3 moved = turn * Vec3(0, 6, 0) * 1.3;
    now[13] += moved;  // of a lip
    SeenFace at_rest, moving;
    at_rest.points = rest;
    moving.points = now;
    const ShapeChange change = change_of(at_rest, moving);
    EXPECT_NEAR(change.head.yaw_deg, 20, 1e-9);
    EXPECT_NEAR(change.head.pitch_deg, 10, 1e-9);
    EXPECT_NEAR(change.head.roll_deg, 5, 1e-9);
    EXPECT_LT(change.moved[14].norm(), 1e-12);
    EXPECT_LT((eye_distance(rest) * change.moved[13] - Vec3(0, 6, 0)).norm(), 1e-9);
}

class RenderedFace : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (!std::filesystem::exists(kWeights / "iris.bin")) return;
        auto files = std::make_shared<scene::RigFiles>();
        files->file = rig::adult_rig_file();
        files->rig = rig::adult().rig;
        files->mesh = rig::adult().mesh;
        networks = std::make_shared<Networks>(kWeights);
        reader = std::make_shared<RigReader>(learn_rig(files, *networks));
        pictures = std::make_unique<RigPictures>(files);
    }
    static void TearDownTestSuite() {
        pictures.reset();
        reader.reset();
        networks.reset();
    }
    void SetUp() override {
        if (!reader) GTEST_SKIP() << "no weights of the networks: tools/web/fetch_weights.sh";
    }
    static double value(const std::vector<double>& read, const std::string& name) {
        for (std::size_t c = 0; c < read.size(); ++c)
            if (reader->channels[c].name == name) return read[c];
        ADD_FAILURE() << name;
        return 0;
    }
    static std::vector<double> seen(const Pose& pose) {
        const Image picture = pictures->draw(pose);
        const auto face = find_face(networks->face, picture);
        EXPECT_TRUE(face);
        const SeenFace mean =
            mean_look(*networks, picture, looks_at(networks->face, picture, face->next));
        return reader->values(change_of(reader->rest, mean));
    }
    static std::shared_ptr<Networks> networks;
    static std::unique_ptr<RigPictures> pictures;
    static std::shared_ptr<RigReader> reader;
};
std::shared_ptr<Networks> RenderedFace::networks;
std::unique_ptr<RigPictures> RenderedFace::pictures;
std::shared_ptr<RigReader> RenderedFace::reader;

TEST_F(RenderedFace, SaysWhichChannelsItShowsReliably) {
    for (const CameraChannel& one : reader->channels)
        std::printf("%-10s error %.3f elsewhere %.3f %s\n", one.name.c_str(), one.error,
                    one.false_rms, one.reliable ? "reliable" : "");
    const auto reliable = [](const char* name) {
        for (const CameraChannel& one : reader->channels)
            if (one.name == name) return one.reliable;
        return false;
    };
    for (const char* name : {"jaw_open", "AU12.l", "AU12.r", "AU2.l", "AU2.r", "AU45.l", "AU45.r"})
        EXPECT_TRUE(reliable(name)) << name;
    for (const char* name : {"AU10", "AU15", "AU18", "AU20"}) EXPECT_FALSE(reliable(name)) << name;
}

// Values between those that were learnt, alone and together
TEST_F(RenderedFace, PosesAreFoundAgain) {
    struct Case {
        Pose pose;
        double allowed;  // of what acts
    };
    constexpr double kAtRest = 0.22;
    const std::vector<Case> cases{
        {{{"AU12", 0.8}}, 0.1},
        {{{"AU12", 0.3}}, 0.1},
        {{{"jaw_open", 0.8}}, 0.1},
        {{{"jaw_open", 0.3}}, 0.1},
        {{{"AU2", 0.8}}, 0.15},
        {{{"AU45", 0.8}}, 0.2},
        {{{"AU45", 0.4}}, 0.1},
        {{{"AU45.l", 0.8}}, 0.2},
        {{{"AU12", 0.6}, {"jaw_open", 0.3}}, 0.2},
        {{{"AU1", 0.8}, {"AU2", 0.8}, {"jaw_open", 0.5}, {"head_yaw_deg", 6}}, 0.25},
    };
    for (const Case& one : cases) {
        const std::vector<double> read = seen(one.pose);
        for (const std::string name :
             {"AU12.l", "AU12.r", "jaw_open", "AU2.l", "AU2.r", "AU45.l", "AU45.r"}) {
            double asked = 0;
            for (const auto& [moved, v] : one.pose)
                if (moved == name || moved == name.substr(0, name.find('.'))) asked = v;
            std::printf("%s %.2f (%.2f)  ", name.c_str(), value(read, name), asked);
            EXPECT_NEAR(value(read, name), asked, asked > 0 ? one.allowed : kAtRest) << name;
        }
        std::printf("\n");
    }
}

TEST_F(RenderedFace, APerformerFollowsCalibratesAndTurns) {
    Performer performer(networks, reader);
    const Image rest = pictures->draw({}), smile = pictures->draw({{"AU12", 0.8}}),
                turned = pictures->draw({{"head_yaw_deg", 12}}),
                lifted = pictures->draw({{"head_pitch_deg", 8}}),
                tilted = pictures->draw({{"head_roll_deg", 10}}),
                wink = pictures->draw({{"AU45.l", 1}});
    double t_s = 0;
    const auto see = [&](const Image& picture, int times, double dt_s = 1.0 / 30) {
        Performed last;
        for (int i = 0; i < times; ++i) last = performer.see(picture, t_s += dt_s);
        return last;
    };
    EXPECT_TRUE(see(rest, 3).values.empty());  // not calibrated yet
    performer.calibrate_range(1);              // before the rest: nothing
    EXPECT_FALSE(see(rest, 1).calibrating);
    performer.calibrate();
    EXPECT_TRUE(see(rest, 10).calibrating);
    EXPECT_FALSE(see(rest, 10, 0.2).calibrating);
    ASSERT_TRUE(performer.calibrated());
    for (const auto& [name, value] : see(rest, 5).values)
        EXPECT_NEAR(value, 0, name.starts_with("head") ? 1.5 : 0.05) << name;
    const auto smiling = see(smile, 20).values;
    EXPECT_NEAR(smiling.at("AU12.l"), 0.8, 0.1);
    EXPECT_NEAR(smiling.at("AU12.r"), 0.8, 0.1);
    const HeadAngles yaw = see(turned, 10).head, pitch = see(lifted, 10).head,
                     roll = see(tilted, 10).head;
    std::printf("yaw %.1f of 12, pitch %.1f of 8, roll %.1f of 10\n", yaw.yaw_deg, pitch.pitch_deg,
                roll.roll_deg);
    EXPECT_NEAR(yaw.yaw_deg, 12, 4);
    EXPECT_NEAR(pitch.pitch_deg, 8, 4);
    EXPECT_NEAR(roll.roll_deg, 10, 2);
    const auto winking = see(wink, 20).values;
    EXPECT_GT(winking.at("AU45.l"), 0.8);
    EXPECT_LT(winking.at("AU45.r"), 0.2);
    // Without a face there are no values; the next face is found again.
    EXPECT_TRUE(see(Image(320, 240), 1).values.empty());
    EXPECT_FALSE(see(smile, 1).values.empty());
}

// A person who smiles less than the rig at its broadest: half of the rig is all of the person.
TEST_F(RenderedFace, ARangeMakesTheMostOfAPersonOne) {
    Performer performer(networks, reader);
    const Image rest = pictures->draw({}), broadest = pictures->draw({{"AU12", 0.5}}),
                less = pictures->draw({{"AU12", 0.25}});
    double t_s = 0;
    const auto see = [&](const Image& picture, int times, double dt_s = 0.1) {
        Performed last;
        for (int i = 0; i < times; ++i) last = performer.see(picture, t_s += dt_s);
        return last;
    };
    const auto smile =
        std::find_if(ranges().begin(), ranges().end(),
                     [](const Range& range) { return std::string("smile") == range.name; }) -
        ranges().begin();
    performer.calibrate();
    see(rest, 25);
    // A calm face is no smile.
    performer.calibrate_range(static_cast<std::size_t>(smile));
    see(rest, 25);
    EXPECT_EQ(performer.ranges_state()[static_cast<std::size_t>(smile)],
              Performer::RangeState::kTooSmall);
    see(broadest, 5);
    performer.calibrate_range(static_cast<std::size_t>(smile));
    EXPECT_TRUE(see(broadest, 5).calibrating);
    EXPECT_FALSE(see(broadest, 20).calibrating);
    EXPECT_EQ(performer.ranges_state()[static_cast<std::size_t>(smile)],
              Performer::RangeState::kKnown);
    EXPECT_NEAR(see(broadest, 10).values.at("AU12.l"), 1, 0.05);
    EXPECT_NEAR(see(less, 10).values.at("AU12.l"), 0.5, 0.15);
    // The face at rest forgets it.
    performer.calibrate();
    see(rest, 25);
    EXPECT_NEAR(see(broadest, 10).values.at("AU12.l"), 0.5, 0.12);
}

}  // namespace
}  // namespace risorius::perform
