// SPDX-License-Identifier: MIT
#include "risorius/core/counter_rng.h"

#include <gtest/gtest.h>

namespace risorius {
namespace {

TEST(CounterRng, IsThePublishedGenerator) {
    // First outputs of splitmix64 for these seeds, by Vigna's reference code (prng.di.unimi.it).
    EXPECT_EQ(CounterRng(1234567).at(0).bits(), 6457827717110365317u);
    EXPECT_EQ(CounterRng(0).at(0).bits(), 0xe220a8397b1dcdafu);
}

TEST(CounterRng, HangsOnEveryPartAndTheirOrder) {
    const double once = CounterRng(3).at(1).at(2).uniform();
    EXPECT_EQ(once, CounterRng(3).at(1).at(2).uniform());
    EXPECT_NE(once, CounterRng(3).at(2).at(1).uniform());
    EXPECT_NE(once, CounterRng(3).at(1).uniform());
    EXPECT_NE(once, CounterRng(4).at(1).at(2).uniform());
    EXPECT_GT(CounterRng(3).at(1).at(2).uniform_open(), once);
}

}  // namespace
}  // namespace risorius
