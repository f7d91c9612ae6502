// SPDX-License-Identifier: MIT
// What a person reads who has written a muscle's experiment wrongly, and how activation follows what a file says.
#include <gtest/gtest.h>

#include "figures/samples.h"
#include "risorius/figures/detail/muscle_drive.h"
#include "risorius/muscle/activation.h"

namespace risorius::figures {
namespace {

std::string message_of_change(const char* id, const char* pointer, const char* value) {
    Json json = sample(id);
    json[Json::json_pointer(pointer)] = Json::parse(value);
    return message_of([&] { check_experiment(JsonCursor::from_json(json, "mine.json")); });
}

TEST(MuscleFiles, WhatIsWrongWithLengthsAndRunsIsNamed) {
    EXPECT_EQ(message_of_change("11a", "/lengths", "[0.8, 0.7]"),
              "mine.json:/lengths/1: expected more than the length before it, found 0.7");
    EXPECT_EQ(message_of_change("11a", "/lengths", "[]"),
              "mine.json:/lengths: expected at least one length, found []");
    EXPECT_EQ(message_of_change("11a", "/runs/1/name", R"("cells")"),
              "mine.json:/runs/1/name: expected a name of its own, found \"cells\" again");
    EXPECT_EQ(message_of_change("11a", "/runs", "[]"),
              "mine.json:/runs: expected at least one run, found []");
    EXPECT_EQ(message_of_change("11a", "/runs/1/change/moduli/bulk_pa", "-1"),
              "mine.json (differences):/muscle/moduli/bulk_pa: expected [0, inf), found -1");
    EXPECT_EQ(message_of_change("11a", "/muscle/grid", "null"),
              "mine.json (cells):/muscle/grid: expected an array, found null");
    EXPECT_EQ(
        message_of_change("11a", "/muscle/insertion", R"("free")"),
        "mine.json (differences):/muscle: expected a straight belly between two plates, found "
        "another");
    EXPECT_EQ(message_of_change("10", "/pictures/0/run", R"("cell")"),
              "mine.json:/pictures/0/run: expected one of \"cells\", found \"cell\"");
    EXPECT_EQ(message_of_change("pennation", "/runs/1/at", R"("5")"),
              "mine.json:/runs/1/at: expected a number, found \"5\"");
}

TEST(MuscleFiles, WhatIsWrongWithTimesIsNamed) {
    EXPECT_EQ(message_of_change("11b", "/phases/1/until_s", "0.0005"),
              "mine.json:/phases/1/until_s: expected more than 0.001, where it begins, found "
              "0.0005");
    EXPECT_EQ(message_of_change("11b", "/length/1", "[0.1, 1]"),
              "mine.json:/length/1/0: expected more than 0.2, the time before it, found 0.1");
    EXPECT_EQ(message_of_change("11b", "/length/1", "[0.3]"),
              "mine.json:/length/1: expected [time in s, value], found [0.3]");
    EXPECT_EQ(message_of_change("11b", "/release_s", "2"),
              "mine.json:/release_s: expected [0, 0.5], found 2");
    EXPECT_EQ(message_of_change("twitch", "/runs/0/drive/excitation", "[[0, 1]]"),
              "mine.json:/runs/0/drive/excitation: expected none beside \"pulses\", found [[0,1]]");
    EXPECT_EQ(message_of_change("twitch", "/shows/0/quantity", R"("force")"),
              "mine.json:/shows/0/quantity: expected one of \"tension\" \"activation\" "
              "\"fibre-length\" \"volume\", found \"force\"");
}

TEST(MuscleFiles, WhatIsWrongWithSpeedsAndCurvesIsNamed) {
    EXPECT_EQ(message_of_change("force-velocity", "/speeds", "[-0.1, 0, 0.1]"),
              "mine.json:/speeds/1: expected a number that is not 0, found 0");
    EXPECT_EQ(message_of_change("isotonic", "/loads_f0", "[]"),
              "mine.json:/: expected \"speeds\", \"loads_f0\" or both, found none of them");
    EXPECT_EQ(message_of_change("isotonic", "/loads_f0", "[0.3, 0.2]"),
              "mine.json:/loads_f0/1: expected more than the number before it, found 0.2");
    EXPECT_EQ(message_of_change("muscle-curves", "/sets/1/name", R"("zajac")"),
              "mine.json:/sets/1/name: expected a name of its own, found \"zajac\" again");
    EXPECT_EQ(message_of_change("muscle-curves", "/sets/1/curves", R"("thelen")"),
              "mine.json:/sets/1/curves: expected one of \"zajac\" \"thelen2003\" "
              "\"millard2013\", found \"thelen\"");
    EXPECT_EQ(message_of_change("isotonic", "/muscle/musculotendon/tendon", R"("rigid")"),
              "mine.json (muscle):/muscle/musculotendon/tendon: expected \"elastic\", for rigid "
              "ones feel no motion, found \"rigid\"");
}

JsonCursor drive(const char* text) { return JsonCursor::from_json(Json::parse(text), "mine.json"); }

TEST(MuscleDrive, ActivationFollowsEveryPulse) {
    const Drive pulses = read_drive(
        drive(R"({"pulses": {"first_s": 0.01, "rate_hz": 50, "count": 2, "width_s": 0.005}})"),
        0.1);
    const muscle::ActivationTimes times;
    const double after = muscle::advance_activation(0, 1, times, 0.005);
    const double before_second = muscle::advance_activation(after, 0, times, 0.015);
    EXPECT_EQ(pulses.activation(0.01), 0);
    EXPECT_NEAR(pulses.activation(0.015), after, 1e-9);
    EXPECT_NEAR(pulses.activation(0.03), before_second, 1e-4) << "pieces of 0.25 ms";
    EXPECT_GT(pulses.activation(0.035), after) << "the second begins above rest";
    ASSERT_TRUE(pulses.pulses);
    EXPECT_DOUBLE_EQ(pulses.pulses->start_s(1), 0.03);
}

TEST(MuscleDrive, ActivationIsHeldAndLengthIsStraightBetweenItsTimes) {
    const Drive direct = read_drive(drive(R"({"activation": [[0.1, 0.5], [0.2, 1]]})"), 1);
    EXPECT_EQ(direct.activation(0.05), 0);
    EXPECT_EQ(direct.activation(0.15), 0.5);
    EXPECT_EQ(direct.activation(3), 1);
    const auto course = read_course(drive("[[0.2, 1], [0.3, 0.5]]"), {0, 2});
    EXPECT_EQ(course(0), 1);
    EXPECT_NEAR(course(0.25), 0.75, 1e-12);
    EXPECT_EQ(course(1), 0.5);
}

}  // namespace
}  // namespace risorius::figures
