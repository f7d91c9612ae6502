#include "app/two_stages.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace risorius::app {
namespace {

TEST(TwoStages, KeepTheOrderForAnyNumberOfThreads) {
    for (int threads : {1, 2, 5}) {
        std::vector<int> used;
        in_two_stages(
            200, threads, [](int i) { return i * i; },
            [&](int i, int value) {
                EXPECT_EQ(value, i * i);
                used.push_back(i);
            });
        ASSERT_EQ(used.size(), 200u);
        for (int i = 0; i < 200; ++i) EXPECT_EQ(used[static_cast<std::size_t>(i)], i);
    }
}

TEST(TwoStages, MakingNeverRunsFarAhead) {
    std::atomic<int> made{0}, used{0};
    int farthest = 0;
    in_two_stages(
        60, 2,
        [&](int i) {
            farthest = std::max(farthest, ++made - used);
            return i;
        },
        [&](int, int) {
            std::this_thread::sleep_for(std::chrono::microseconds(300));
            ++used;
        });
    EXPECT_GE(farthest, 2);
    EXPECT_LE(farthest, 6);  // four waiting, one in use, one being made
}

TEST(TwoStages, AFailureOfEitherStageEndsBothAndIsPassedOn) {
    for (int threads : {1, 2}) {
        int last_used = -1;
        const auto use = [&](int i, int) { last_used = i; };
        try {
            in_two_stages(
                1000, threads,
                [](int i) {
                    if (i == 7) throw std::runtime_error("making 7");
                    return i;
                },
                use);
            FAIL() << "no exception";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "making 7");
        }
        EXPECT_LT(last_used, 7);

        int last_made = -1;
        try {
            in_two_stages(
                1000, threads, [&](int i) { return last_made = i; },
                [](int i, int) {
                    if (i == 7) throw std::runtime_error("using 7");
                });
            FAIL() << "no exception";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "using 7");
        }
        EXPECT_LE(last_made, 7 + 6);
    }
}

TEST(TwoStages, DoNothingForNothing) {
    for (int threads : {1, 2})
        in_two_stages(
            0, threads, [](int i) { return i; }, [](int, int) { FAIL(); });
}

}  // namespace
}  // namespace risorius::app
