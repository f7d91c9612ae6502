// SPDX-License-Identifier: MIT
// The volume around nodes: the closed form of a homogeneous change, derivatives, and no locking where tetrahedra lock.
#include "risorius/tissue/node_volumes.h"

#include <gtest/gtest.h>

#include <limits>

#include "force_term_checks.h"
#include "tet_blocks.h"

namespace risorius::tissue {
namespace {

constexpr double kNoTime = std::numeric_limits<double>::infinity();

TEST(NodeVolumes, StoreTheClosedFormOfAHomogeneousChange) {
    const auto block = testing_of::tet_block({3, 2, 2}, {0.03, 0.02, 0.01});
    const NodeVolumes term(block.tets, block.rest, 1e6);
    for (const double l : {0.9, 1.0, 1.2}) {
        const Points x = block.rest * Vec3(l, 1.05, 0.98).asDiagonal().toDenseMatrix();
        Points gradient = Points::Zero(x.rows(), 3);
        const double off = l * 1.05 * 0.98 - 1;
        EXPECT_NEAR(term.add_potential({0, kNoTime, x}, x, gradient), 0.5e6 * 6e-6 * off * off,
                    1e-12);
    }
}

TEST(NodeVolumes, HaveTheDerivativesOfTheirEnergy) {
    const auto block = testing_of::tet_block({2, 1, 1}, {0.02, 0.01, 0.01});
    const NodeVolumes term(block.tets, block.rest, 1e6);
    const Points x = block.rest + testing_of::random_points(block.rest.rows(), 1e-3, 3);
    const solve::ImplicitStep step{0, kNoTime, block.rest};
    testing_of::expect_gradient_of_potential(term, step, x, 1e-7, 1e-6);
    testing_of::expect_hessian_of_potential(term, step, x, 1e-7, 1e-6);
    testing_of::expect_projection(term, step, x);
}

// Each tetrahedron of its own lets fewer motions keep the volume than there are nodes; around nodes there are at most as many demands as nodes,
// a third of the coordinates.
TEST(NodeVolumes, LeaveTwoThirdsOfTheCoordinatesFree) {
    const auto block = testing_of::tet_block({3, 3, 3}, {0.03, 0.03, 0.03});
    const NodeVolumes term(block.tets, block.rest, 1e6);
    const Eigen::MatrixXd H =
        testing_of::hessian(term, {0, kNoTime, block.rest}, block.rest, solve::Curvature::kExact);
    const Eigen::VectorXd values = symmetric_eigenvalues(H);
    const auto stiff = (values.array() > 1e-9 * values.maxCoeff()).count();
    EXPECT_EQ(block.rest.rows(), 64);
    EXPECT_LE(stiff, 64);
    EXPECT_GT(stiff, 48);
    EXPECT_GT(block.tets.rows(), 2 * 64) << "tetrahedra of their own would leave almost nothing";
}

TEST(NodeVolumes, RefuseWhatHasNoVolume) {
    auto block = testing_of::tet_block({1, 1, 1}, {1, 1, 1});
    EXPECT_THROW(NodeVolumes(block.tets, block.rest, -1), std::invalid_argument);
    block.tets.col(0).swap(block.tets.col(1));
    EXPECT_THROW(NodeVolumes(block.tets, block.rest, 1), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::tissue
