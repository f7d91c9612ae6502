// SPDX-License-Identifier: MIT
// Directions of fibres as a flow: straight in a prism, radial in a wedge, round in an arc.
#include "risorius/muscle/fibre_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tet_blocks.h"

namespace risorius::muscle {
namespace {

using testing_of::face_of;
using testing_of::TetBlock;

TEST(FibreFlow, IsStraightInAPrism) {
    const TetBlock block = testing_of::tet_block({5, 2, 3}, {0.05, 0.01, 0.02});
    const Points fibres =
        fibre_flow(block.rest, block.tets, face_of(block.rest, 0, 0), face_of(block.rest, 0, 0.05));
    ASSERT_EQ(fibres.rows(), block.tets.rows());
    for (Eigen::Index t = 0; t < fibres.rows(); ++t)
        EXPECT_NEAR((fibres.row(t) - Vec3::UnitX().transpose()).norm(), 0, 1e-11) << t;
}

/// The largest angle between the fibres and those of the closed form in a quarter of a ring, degrees. The fibres run round from the face
/// at 0 to that at 90 degrees, or outward from the inner to the outer wall.
double worst_angle_deg(int cells, bool round) {
    TetBlock block = testing_of::tet_block({2 * cells, cells, 1}, {1, 1, 0.2});
    const std::vector<char> from = face_of(block.rest, round ? 0 : 1, 0),
                            to = face_of(block.rest, round ? 0 : 1, 1);
    for (Eigen::Index i = 0; i < block.rest.rows(); ++i) {
        const double angle = 0.5 * std::numbers::pi * block.rest(i, 0), r = 1 + block.rest(i, 1);
        block.rest.row(i) << r * std::sin(angle), r * std::cos(angle), block.rest(i, 2);
    }
    const Points fibres = fibre_flow(block.rest, block.tets, from, to);
    double worst = 0;
    for (Eigen::Index t = 0; t < fibres.rows(); ++t) {
        Vec3 middle = Vec3::Zero();
        for (int k = 0; k < 4; ++k) middle += block.rest.row(block.tets(t, k)).transpose() / 4;
        middle.z() = 0;
        const Vec3 outward = middle.normalized();
        const Vec3 exact = round ? Vec3(outward.y(), -outward.x(), 0) : outward;
        const double along = std::min(1.0, fibres.row(t).dot(exact.transpose()));
        worst = std::max(worst, std::acos(along) * 180 / std::numbers::pi);
    }
    return worst;
}

TEST(FibreFlow, GoesTowardsTheClosedFormOfARing) {
    for (const bool round : {true, false}) {
        const double coarse = worst_angle_deg(3, round), fine = worst_angle_deg(12, round);
        EXPECT_LT(coarse, 12) << round;
        EXPECT_LT(fine, 0.35 * coarse) << round;  // of first order: a quarter
    }
}

TEST(FibreFlow, NeedsAWayFromEndToEnd) {
    const TetBlock block = testing_of::tet_block({2, 1, 1}, {2, 1, 1});
    const std::vector<char> from = face_of(block.rest, 0, 0), to = face_of(block.rest, 0, 2),
                            none(from.size(), 0);
    EXPECT_NO_THROW(fibre_flow(block.rest, block.tets, from, to));
    EXPECT_THROW(fibre_flow(block.rest, block.tets, from, none), std::invalid_argument);
    // The first cube lies within the origin.
    std::vector<char> thick = from;
    const std::vector<char> middle = face_of(block.rest, 0, 1);
    for (std::size_t i = 0; i < thick.size(); ++i) thick[i] = thick[i] || middle[i] ? 1 : 0;
    EXPECT_THROW(fibre_flow(block.rest, block.tets, thick, to), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::muscle
