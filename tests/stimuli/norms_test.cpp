// SPDX-License-Identifier: MIT
// Norms of a set from ratings: hit rates, confusion and agreement, against numbers of the literature and by definition.
#include "risorius/stimuli/detail/norms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "message_of.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/stimuli/batch.h"
#include "stimuli/batch_fixture.h"

namespace risorius::stimuli {
namespace {

TEST(Norms, IntervalOfAShareIsThatOfWilson) {
    // Newcombe 1998, Statistics in Medicine 17, 857-872, table I, method 3: 81 of 263, and 0 of 20
    const Share some{81, 263}, none{0, 20};
    EXPECT_NEAR(some.low(), 0.2553, 5e-5);
    EXPECT_NEAR(some.high(), 0.3662, 5e-5);
    EXPECT_NEAR(none.low(), 0, 1e-12);
    EXPECT_NEAR(none.high(), 0.1611, 5e-5);
}

TEST(Norms, KappaIsThatOfFleiss) {
    // Fourteen raters, ten subjects, five categories: the example of the literature, kappa .210
    const int counts[10][5] = {{0, 0, 0, 0, 14}, {0, 2, 6, 4, 2}, {0, 0, 3, 5, 6}, {0, 3, 9, 2, 0},
                               {2, 2, 8, 1, 1},  {7, 7, 0, 0, 0}, {3, 2, 6, 3, 0}, {2, 5, 3, 2, 2},
                               {6, 5, 2, 1, 0},  {0, 2, 2, 3, 7}};
    std::vector<Rating> ratings;
    for (int clip = 0; clip < 10; ++clip)
        for (int answer = 0; answer < 5; ++answer)
            for (int i = 0; i < counts[clip][answer]; ++i)
                ratings.push_back({"", std::to_string(clip), std::to_string(answer), {}});
    const Norms norms = norms_of(Ratings{ratings, {}}, {});
    ASSERT_TRUE(norms.kappa.has_value());
    EXPECT_NEAR(*norms.kappa, 0.210, 5e-4);
}

TEST(Norms, ReliabilityIsThatOfShroutAndFleiss) {
    // Shrout, Fleiss 1979, table 2: six targets, four judges; ICC(2,4) is .62
    const double scores[6][4] = {{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                 {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};
    std::vector<Rating> ratings;
    for (int target = 0; target < 6; ++target)
        for (int judge = 0; judge < 4; ++judge)
            ratings.push_back({"judge " + std::to_string(judge),
                               std::to_string(target),
                               "",
                               {{"valence", scores[target][judge]}}});
    // A judge who leaves a target out does not count
    ratings.push_back({"other", "0", "", {{"valence", 100}}});
    EXPECT_NEAR(norms_of(Ratings{ratings, {}}, {}).icc.at("valence"), 0.62, 5e-3);
    EXPECT_EQ(norms_of(Ratings{ratings, {}}, {}).icc.count("arousal"), 0u);
}

TEST(Norms, LikingForAnAnswerDoesNotPay) {
    // Says fear to everything: all fear is hit, and half of what is called fear is none
    std::vector<Rating> ratings;
    for (int i = 0; i < 10; ++i) {
        ratings.push_back({"", "fear", "fear", {}});
        ratings.push_back({"", "joy", "fear", {}});
    }
    const Norms norms = norms_of(Ratings{ratings, {}}, {{"fear", "fear"}, {"joy", "joy"}});
    EXPECT_EQ(norms.clips.at("fear").hits.value(), 1);
    EXPECT_NEAR(*norms.unbiased_hit_rate("fear"), 10.0 * 10 / (10 * 20), 1e-12);
    EXPECT_EQ(*norms.unbiased_hit_rate("joy"), 0);
    EXPECT_EQ(norms.confusion_table(), "right\tfear\nfear\t10\njoy\t10\n");
}

TEST(Norms, CountRedDotsAndLeaveOutPracticeAndCatchTrials) {
    const TemporaryFolder folder;
    // As experiment.py writes its rows, and as the page does, which has several rows for a trial
    std::ofstream(folder / "all.csv")
        << "participant,kind,task,stim_id,answer,correct,false_alarm\n"
           "1,practice,,a,fear,0,0\n1,trial,,a,joy,1,0\n1,trial,,b,joy,0,1\n1,catch,,a,,1,0\n"
           "1,catch,,b,,0,1\n"
           "2,trial,clip,a,,,0\n2,trial,answer,a,joy,true,\n"
           "2,catch,clip,a,,false,0\n2,catch,catch,a,,true,\n";
    const Ratings ratings = read_ratings(folder / "all.csv", {"a", "b"});
    EXPECT_EQ(ratings.given.size(), 3u);
    const Norms norms = norms_of(ratings, {{"a", "joy"}, {"b", "fear"}});
    EXPECT_EQ(norms.clips.at("a").hits.count, 2);
    EXPECT_EQ(norms.catch_table(),
              "participant\tcatch_trials\thits\tother_trials\tfalse_alarms\n"
              "1\t2\t1\t2\t2\n2\t1\t1\t1\t0\n");
    const Json all = norms.json().at("catch");
    EXPECT_EQ(all.at("trials"), 3);
    EXPECT_EQ(all.at("hits"), 2);
    EXPECT_EQ(all.at("other_trials"), 3);
    EXPECT_EQ(all.at("false_alarms"), 2);
    // A table without catch trials says nothing of them
    std::ofstream(folder / "plain.csv") << "stim_id,answer\na,joy\n";
    EXPECT_FALSE(norms_of(read_ratings(folder / "plain.csv", {"a"}), {}).json().contains("catch"));
}

class NormsOfSet : public Batch {};

TEST_F(NormsOfSet, BecomePartOfItAndStay) {
    Json json = Json::parse(text_of(design("rated.json", {0.5, 1})));
    json["clips"]["quality"] = "draft";
    json["clips"]["ending"] = "mp4";
    json["experiment"] = {{"programs", {"psychopy"}},
                          {"answers", {{"w", "0.5"}, {"s", "1"}}},
                          {"correct", "intensity"}};
    std::ofstream(folder().path() / "rated.json") << json.dump();
    const fs::path ratings = folder().path() / "ratings.csv";
    std::ofstream(ratings) << "participant,stimulus_id,answer,valence,note (free)\n"
                              "1,stim-smile0p5,0.5,3,\n1,stim-smile1,1,7,x\n"
                              "2,stim-smile0p5,1,4,\n2,stim-smile1,1,n/a,\n";
    BatchOptions options{.design = folder().path() / "rated.json",
                         .out = folder().path() / "rated",
                         .workers = 2,
                         .norms = ratings};
    EXPECT_EQ(make_batch(options).made, 2);
    const auto cell = [&](std::size_t clip, const char* column) {
        const animate::FrameRows rows =
            animate::frame_rows(text_of(options.out / "stimuli/stimuli.tsv"));
        const int at = rows.column(column);
        return at < 0 ? "no column" : rows.cells[clip][static_cast<std::size_t>(at)];
    };
    EXPECT_EQ(cell(0, "norm_hit_rate"), "0.5");
    EXPECT_EQ(cell(1, "norm_hit_rate"), "1");
    EXPECT_EQ(cell(0, "norm_valence"), "3.5");
    EXPECT_EQ(cell(1, "norm_answer"), "1");
    const Json norms = Json::parse(text_of(options.out / "norms/norms.json"));
    EXPECT_EQ(norms.at("answers").at("1").at("shown"), 2);
    // They stay in a later run without the table
    options.norms.clear();
    fs::remove(ratings);
    EXPECT_EQ(make_batch(options).kept, 2);
    EXPECT_EQ(cell(0, "norm_hit_rate"), "0.5");
    // Each file is replaced by a new one of the set, and none is taken for somebody's own.
    for (const char* correct : {"0", "1"}) {
        std::ofstream(ratings) << "participant,kind,stim_id,answer,correct,false_alarm\n"
                                  "1,trial,smile1,1,1,0\n1,catch,smile1,,"
                               << correct << ",0\n";
        options.norms = ratings;
        EXPECT_TRUE(make_batch(options).changed.empty());
    }
    EXPECT_NE(text_of(options.out / "norms/catch.tsv").find("1\t1\t1\t1\t0"), std::string::npos);
    // Ratings of other clips are refused before anything is made
    std::ofstream(ratings) << "stimulus_id,answer\nstim-none,1\n";
    options.norms = ratings;
    EXPECT_NE(
        message_of([&] { make_batch(options); }).find("expected a clip of the set, found \"none\""),
        std::string::npos);
}

}  // namespace
}  // namespace risorius::stimuli
