#include "risorius/core/place_chance.h"

#include <gtest/gtest.h>

namespace risorius {
namespace {

TEST(PlaceChance, IsThePublishedGenerator) {
    // First outputs of splitmix64 by Vigna's reference code (prng.di.unimi.it) for these seeds
    EXPECT_EQ(PlaceChance(1234567).at(0).bits(), 6457827717110365317u);
    EXPECT_EQ(PlaceChance(0).at(0).bits(), 0xe220a8397b1dcdafu);
}

TEST(PlaceChance, HangsOnEveryPartAndTheirOrder) {
    const double once = PlaceChance(3).at(1).at(2).from_zero();
    EXPECT_EQ(once, PlaceChance(3).at(1).at(2).from_zero());
    EXPECT_NE(once, PlaceChance(3).at(2).at(1).from_zero());
    EXPECT_NE(once, PlaceChance(3).at(1).from_zero());
    EXPECT_NE(once, PlaceChance(4).at(1).at(2).from_zero());
    EXPECT_GT(PlaceChance(3).at(1).at(2).inside(), once);
}

}  // namespace
}  // namespace risorius
