// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/pipeline.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace risorius::animate {
namespace {

int unchanged(int /*worker*/, int /*i*/, int value) { return value; }

TEST(ThreeStages, KeepTheOrderForAnyNumberOfWorkers) {
    for (int workers : {0, 1, 2, 5}) {
        std::vector<int> used;
        run_pipeline(
            200, workers, [](int i) { return i * i; },
            [&](int worker, int i, int value) {
                EXPECT_LT(worker, std::max(workers, 1));
                // The later ones of five are done before the first
                std::this_thread::sleep_for(std::chrono::microseconds(50 * (5 - i % 5)));
                return std::to_string(value + i);
            },
            [&](int i, const std::string& text) {
                EXPECT_EQ(text, std::to_string(i * i + i));
                used.push_back(i);
            });
        ASSERT_EQ(used.size(), 200u);
        for (int i = 0; i < 200; ++i) EXPECT_EQ(used[static_cast<std::size_t>(i)], i);
    }
}

TEST(ThreeStages, WorkersWorkAtTheSameTime) {
    std::atomic<int> working{0}, max{0};
    run_pipeline(
        40, 3, [](int i) { return i; },
        [&](int, int, int value) {
            const int now = ++working;
            for (int before = max; before < now && !max.compare_exchange_weak(before, now);) {
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            --working;
            return value;
        },
        [](int, int) {});
    EXPECT_GE(max, 2);
    EXPECT_LE(max, 3);
}

TEST(ThreeStages, MakingNeverRunsFarAhead) {
    std::atomic<int> made{0}, used{0};
    int farthest = 0;
    run_pipeline(
        60, 2,
        [&](int i) {
            farthest = std::max(farthest, ++made - used);
            return i;
        },
        unchanged,
        [&](int, int) {
            std::this_thread::sleep_for(std::chrono::microseconds(300));
            ++used;
        });
    EXPECT_GE(farthest, 2);
    EXPECT_LE(farthest, 2 + kMaxWaiting + 1);  // and one in use
}

TEST(ThreeStages, AFailureOfAnyStageEndsAllAndIsPassedOn) {
    const auto failing_at_7 = [](const char* what) {
        return [what](int i) {
            if (i == 7) throw std::runtime_error(what);
            return i;
        };
    };
    for (int workers : {0, 1, 3}) {
        for (const std::string stage : {"make", "change", "use"}) {
            int last_made = -1, last_used = -1;
            const auto at_7 = failing_at_7(stage.c_str());
            try {
                run_pipeline(
                    1000, workers, [&](int i) { return last_made = stage == "make" ? at_7(i) : i; },
                    [&](int, int i, int value) { return stage == "change" ? at_7(i) : value; },
                    [&](int i, int value) {
                        if (stage == "use") at_7(value);
                        last_used = i;
                    });
                FAIL() << "no exception";
            } catch (const std::runtime_error& error) {
                EXPECT_EQ(error.what(), stage);
            }
            EXPECT_LT(last_used, 7);
            EXPECT_LE(last_made, 7 + workers + kMaxWaiting);
        }
    }
}

TEST(ThreeStages, DoNothingForNothing) {
    for (int workers : {0, 2})
        run_pipeline(
            0, workers, [](int i) { return i; }, unchanged, [](int, int) { FAIL(); });
}

}  // namespace
}  // namespace risorius::animate
