// SPDX-License-Identifier: MIT
// The standard anatomy is complete, the same on both sides, and speaks of landmarks that exist.
#include "risorius/rig/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "rig/heads.h"

namespace risorius::rig {
namespace {

const Atlas& atlas() { return adult().rig.atlas; }

TEST(Atlas, HasItsHundredAndNineLandmarksOnce) {
    std::set<std::string> ids;
    int core = 0, midline = 0;
    for (const AtlasLandmark& landmark : atlas().landmarks) {
        EXPECT_TRUE(ids.insert(landmark.id).second) << landmark.id << " is there twice";
        core += landmark.core;
        midline += mirrored_landmark(landmark.id) == landmark.id;
    }
    EXPECT_EQ(ids.size(), 109u);
    EXPECT_EQ(core, 87);
    EXPECT_EQ(midline, 23);
}

TEST(Atlas, LeftAndRightMirrorEachOther) {
    for (const AtlasLandmark& landmark : atlas().landmarks) {
        EXPECT_EQ(mirrored_landmark(mirrored_landmark(landmark.id)), landmark.id);
        const AtlasLandmark* other = atlas().landmark(mirrored_landmark(landmark.id));
        ASSERT_NE(other, nullptr) << landmark.id << " has no other side";
        const Vec3& p = landmark.position;
        EXPECT_LT((Vec3(-p.x(), p.y(), p.z()) - other->position).norm(), 1e-9) << landmark.id;
        if (landmark.id.ends_with("_l")) {
            EXPECT_GT(p.x(), 0) << landmark.id;
        }
        EXPECT_EQ(landmark.core, other->core) << landmark.id;
    }
}

TEST(Atlas, OriginLiesBetweenTheTragia) {
    const Vec3 middle =
        0.5 * (atlas().landmark("t_l")->position + atlas().landmark("t_r")->position);
    EXPECT_LT(middle.norm(), 1e-9);
}

TEST(Atlas, EveryTableSpeaksOfLandmarksThatExist) {
    for (const ThicknessSample& sample : atlas().thickness)
        EXPECT_NE(atlas().landmark(sample.landmark), nullptr) << sample.landmark;
    for (const AttachmentSample& sample : atlas().attachments)
        EXPECT_NE(atlas().landmark(sample.landmark), nullptr) << sample.landmark;
    for (const MuscleBand& band : atlas().bands)
        for (const BandPoint& point : band.points)
            EXPECT_NE(atlas().landmark(point.landmark), nullptr)
                << band.muscle << " at " << point.landmark;
    for (const std::string& id : required_landmarks())
        EXPECT_NE(atlas().landmark(id), nullptr) << id;
}

TEST(Atlas, AttachmentsAreTheSameOnBothSides) {
    std::map<std::string, AttachmentSample> by_id;
    for (const AttachmentSample& sample : atlas().attachments) by_id[sample.landmark] = sample;
    EXPECT_EQ(by_id.size(), atlas().attachments.size());
    for (const auto& [id, sample] : by_id) {
        const auto other = by_id.find(mirrored_landmark(id));
        ASSERT_NE(other, by_id.end()) << id;
        EXPECT_EQ(sample.normal_pa_per_m, other->second.normal_pa_per_m) << id;
        EXPECT_EQ(sample.tangential_pa_per_m, other->second.tangential_pa_per_m) << id;
    }
}

TEST(Atlas, EveryMimeticMuscleHasBandsAndNothingElseHas) {
    std::set<std::string> mimetic, banded;
    for (const Muscle& muscle : adult().rig.muscles.muscles)
        if (muscle.group == "mimetic") mimetic.insert(muscle.id);
    for (const MuscleBand& band : atlas().bands) {
        banded.insert(band.muscle);
        EXPECT_GT(band.force_n, 0) << band.muscle;
        EXPECT_GT(band.strength, 0) << band.muscle;
        EXPECT_GE(band.points.size(), 2u) << band.muscle;
    }
    EXPECT_EQ(mimetic.size(), 28u);
    EXPECT_EQ(banded, mimetic);
}

TEST(Atlas, OnlyTheUnpairedMusclesOfTheMouthCrossTheMidline) {
    std::set<std::string> crossing, unpaired;
    for (const MuscleBand& band : atlas().bands)
        if (band.crosses_midline()) crossing.insert(band.muscle);
    for (const Muscle& muscle : adult().rig.muscles.muscles)
        if (!muscle.paired) unpaired.insert(muscle.id);
    EXPECT_EQ(crossing, unpaired);
    EXPECT_EQ(crossing.size(), 4u);
}

TEST(Atlas, MusclesOfTheJawMoveWithItOnlyBelowTheMouth) {
    for (const MuscleBand& band : atlas().bands)
        if (band.origin == Body::kMandible) {
            EXPECT_LT(atlas().landmark(band.points.front().landmark)->position.y(),
                      atlas().landmark("sto")->position.y())
                << band.muscle;
        }
}

TEST(MuscleTable, HasItsFortyFourMusclesInFourGroups) {
    std::map<std::string, int> groups;
    for (const Muscle& muscle : adult().rig.muscles.muscles) ++groups[muscle.group];
    EXPECT_EQ(groups,
              (std::map<std::string, int>{{"mimetic", 28}, {"lid", 2}, {"jaw", 8}, {"hyoid", 6}}));
}

TEST(MuscleTable, GivesOneColumnPerSide) {
    const MuscleTable& table = adult().rig.muscles;
    const track::ChannelTable channels = table.channels();
    EXPECT_EQ(channels.column_count(), 2 * 44 - 4);
    EXPECT_EQ(table.activation_s().size(), channels.column_count());
    EXPECT_EQ(table.deactivation_s().size(), channels.column_count());
    const int left = channels.column("masseter_deep", Side::kLeft);
    EXPECT_EQ(channels.column("masseter_deep", Side::kRight), left + 1);
    EXPECT_DOUBLE_EQ(table.activation_s()[left + 1], 0.030);
    EXPECT_DOUBLE_EQ(table.deactivation_s()[left + 1], 0.060);
}

TEST(MuscleTable, OnlyTheLidLevatorCanLoseTone) {
    std::vector<std::string> tonic;
    for (const Muscle& muscle : adult().rig.muscles.muscles)
        if (muscle.tonic) tonic.push_back(muscle.id);
    EXPECT_EQ(tonic, std::vector<std::string>{"levator_palpebrae_superioris"});
    const track::ChannelTable channels = adult().rig.channels();
    EXPECT_EQ(channels.column_min().minCoeff(), -1.0);
    EXPECT_EQ((channels.column_min().array() < 0).count(), 2);
}

}  // namespace
}  // namespace risorius::rig
