// SPDX-License-Identifier: MIT
// Fans of tetrahedra: every tet occurs once, and each is where its fan says.
#include "risorius/tissue/detail/tet_fans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tissue/layered_block.h"

namespace risorius::tissue {
namespace {

std::set<int> nodes_of(const Tets& tets, int tet) {
    return {tets(tet, 0), tets(tet, 1), tets(tet, 2), tets(tet, 3)};
}

void expect_each_tet_once(const Tets& tets, const TetFans& found) {
    std::vector<int> times(static_cast<std::size_t>(tets.rows()), 0);
    for (int tet : found.alone) ++times[static_cast<std::size_t>(tet)];
    for (const TetFan& fan : found.fans) {
        EXPECT_EQ(std::set<int>(fan.nodes.begin(), fan.nodes.end()).size(), fan.nodes.size());
        for (int i = 0; i < kFanTets; ++i) {
            ++times[static_cast<std::size_t>(fan.tets[i])];
            EXPECT_EQ(
                nodes_of(tets, fan.tets[i]),
                (std::set<int>{fan.nodes[0], fan.nodes[1], fan.nodes[2 + i], fan.nodes[3 + i]}));
        }
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), tets.rows());
}

TEST(TetFans, ThreeTetsOfACutPrismAreOne) {
    Tets tets(3, 4);  // bottom 0 1 2, top 3 4 5
    tets << 0, 1, 2, 5, 0, 1, 5, 4, 0, 4, 5, 3;
    const TetFans found = find_fans(tets);
    ASSERT_EQ(found.fans.size(), 1u);
    EXPECT_TRUE(found.alone.empty());
    EXPECT_EQ(found.fans[0].tets, (std::array<int, 3>{0, 1, 2}));
    EXPECT_EQ((std::set<int>{found.fans[0].nodes[0], found.fans[0].nodes[1]}),
              (std::set<int>{0, 5}));
    expect_each_tet_once(tets, found);
}

TEST(TetFans, HoldEveryTetOfABlockOnce) {
    const LayeredBlock block(5, 4, 3);
    const TetFans found = find_fans(block.tets);
    expect_each_tet_once(block.tets, found);
    EXPECT_LT(found.alone.size(), block.tets.rows() / 4u);
}

TEST(TetFans, ThreeTetsThatCloseAroundAnEdgeAreNone) {
    Tets tets(3, 4);  // around 0-1, ring 2 3 4 2
    tets << 0, 1, 2, 3, 0, 1, 3, 4, 0, 1, 4, 2;
    const TetFans found = find_fans(tets);
    EXPECT_TRUE(found.fans.empty());
    EXPECT_EQ(found.alone, (std::vector<int>{0, 1, 2}));
    Tets none(0, 4);
    EXPECT_TRUE(find_fans(none).alone.empty());
}

}  // namespace
}  // namespace risorius::tissue
