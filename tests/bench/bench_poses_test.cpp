// SPDX-License-Identifier: MIT
// Equilibria measured on shells of several sizes.
#include "tools/bench/bench_poses.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "scene/adult_of_bundles.h"

namespace risorius::bench {
namespace {

TEST(BenchPoses, EquilibriaAreAtRestWhateverTheSizeOfTheShell) {
    const Json shells = bench_poses(scene::adult_of_bundles(), {{600, 1200}, {"AU26"}});
    ASSERT_EQ(shells.size(), 2U);
    EXPECT_GT(shells[1]["nodes"].get<int>(), 1.7 * shells[0]["nodes"].get<int>());
    for (const Json& shell : shells) {
        ASSERT_EQ(shell["poses"].size(), 1U);
        const Json& pose = shell["poses"][0];
        EXPECT_EQ(pose["name"], "AU26");
        EXPECT_TRUE(pose["at_rest"].get<bool>());
        EXPECT_GT(pose["iterations"].get<int>(), 20);
        EXPECT_LT(pose["left_mm"].get<double>(), 0.1);
    }
}

TEST(BenchPoses, NamesAUnitThatNoTableHas) {
    EXPECT_EQ(
        message_of([] {
            bench_poses(scene::adult_of_bundles(), {{600}, {"AU99"}});
        }),
        scene::adult_of_bundles().place() + ": expected a unit of its tables, found \"AU99\"");
}

}  // namespace
}  // namespace risorius::bench
