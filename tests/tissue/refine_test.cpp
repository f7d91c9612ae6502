// SPDX-License-Identifier: MIT
// Adaptive resolution: the tree stays balanced, the estimate knows the error, and the body stays the same.
#include "risorius/tissue/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "risorius/solve/newton.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/strain_error.h"
#include "tissue/cell_solids.h"

namespace risorius::tissue {
namespace {

using namespace cell_solids;

std::vector<CellPlace> places_of(const CellMesh& mesh) {
    std::vector<CellPlace> places;
    for (const CellMesh::Cell& cell : mesh.cells()) places.push_back(cell.place);
    return places;
}

/// Maximum difference in level between cells that share a point, found from the extents of the cells alone.
int worst_step_between_neighbours(const CellMesh& mesh) {
    int worst = 0;
    for (const CellMesh::Cell& a : mesh.cells())
        for (const CellMesh::Cell& b : mesh.cells()) {
            const bool apart = ((a.low.array() > (b.low + b.size).array() + 1e-9) ||
                                (b.low.array() > (a.low + a.size).array() + 1e-9))
                                   .any();
            if (!apart) worst = std::max(worst, std::abs(a.place.level - b.place.level));
        }
    return worst;
}

double overlap(const CellMesh::Cell& a, const CellMesh::Cell& b) {
    return ((a.low + a.size).cwiseMin(b.low + b.size) - a.low.cwiseMax(b.low)).cwiseMax(0.0).prod();
}

TEST(CellTree, SplittingOneDeepCellGradesTheCellsRoundIt) {
    CellTree tree({4, 3, 3});
    tree.split(
        {3,
         {7, 7, 7}});  // made, with all it needs; at a corner of root cell 0, next to three others
    EXPECT_TRUE(tree.exists({4, {15, 15, 15}}));
    const CellMesh mesh = tree.mesh();
    EXPECT_EQ(mesh.deepest_level(), 4);
    EXPECT_EQ(worst_step_between_neighbours(mesh), 1) << "across faces, edges and corners";
    double filled = 0, doubled = 0;
    for (const CellMesh::Cell& a : mesh.cells()) {
        filled += a.size.prod();
        for (const CellMesh::Cell& b : mesh.cells())
            if (&a != &b) doubled += overlap(a, b);
    }
    EXPECT_NEAR(filled, 1, 1e-12);
    EXPECT_LT(doubled, 1e-12);
}

TEST(CellTree, MergingUndoesSplitting) {
    CellTree tree({3, 3, 3});
    const auto before = places_of(tree.mesh());
    tree.split({0, {0, 1, 1}});
    const auto once = places_of(tree.mesh());
    EXPECT_EQ(once.size(), before.size() + 7);
    tree.split({1, {0, 3, 3}});
    EXPECT_TRUE(tree.merge({1, {0, 3, 3}}));
    EXPECT_EQ(places_of(tree.mesh()), once);
    EXPECT_TRUE(tree.merge({0, {0, 1, 1}}));
    EXPECT_EQ(places_of(tree.mesh()), before);
    EXPECT_FALSE(tree.merge({0, {0, 1, 1}})) << "a leaf has nothing to merge";
}

TEST(CellTree, MergingIsRefusedOnlyWhereItWouldUnbalanceTheTree) {
    CellTree tree({3, 3, 3});
    tree.split({1, {1, 1, 1}});  // meets all eight root cells in the middle, so all are split
    EXPECT_FALSE(tree.merge({0, {0, 0, 0}})) << "its part is split";
    EXPECT_FALSE(tree.merge({0, {1, 1, 1}})) << "it meets that part across a corner";
    EXPECT_TRUE(tree.merge({1, {1, 1, 1}}));
    EXPECT_TRUE(tree.merge({0, {1, 1, 1}}));
    // A split on the far side of a neighbour is no obstacle.
    CellTree wide({4, 2, 2});
    wide.split({1, {3, 0, 0}});
    wide.split({0, {0, 0, 0}});
    EXPECT_TRUE(wide.is_split({0, {1, 0, 0}}));
    EXPECT_TRUE(wide.merge({0, {0, 0, 0}}));
    EXPECT_EQ(worst_step_between_neighbours(wide.mesh()), 1);
}

TEST(CellTree, PlacesOutsideTheGridAreRefused) {
    CellTree tree({3, 3, 3});
    EXPECT_THROW(tree.split({0, {2, 0, 0}}), std::invalid_argument);
    EXPECT_THROW(tree.split({1, {0, -1, 0}}), std::invalid_argument);
    EXPECT_FALSE(tree.exists({1, {0, 0, 0}}));
}

Points mapped(const CellMesh& mesh, const std::function<Vec3(const Vec3&)>& map) {
    Points x(mesh.node_count(), 3);
    for (int i = 0; i < mesh.node_count(); ++i)
        x.row(i) = map(mesh.material_coordinates().row(i).transpose()).transpose();
    return x;
}

const RestShape kBlock = [](const Vec3& a) -> Vec3 {
    return Vec3(0.1, 0.08, 0.06).cwiseProduct(a);
};
const CellModuli kTissue{.mu_pa = 3e3, .bulk_pa = 2e4};

/// A smooth map that changes volume: it stretches, shears and bends.
Vec3 smooth_map(const Vec3& a) {
    const Vec3 x = kBlock(a);
    return x + 0.01 * Vec3(a[0] * a[0] + a[1] * a[2], a[1] * a[1] - a[0] * a[2], a[2] * a[0]);
}

TEST(StrainError, LinearDeformationHasNoErrorOnAnyMesh) {
    Mat3 F;
    F << 1.2, 0.1, -0.2, 0.05, 0.9, 0.3, 0.1, -0.1, 1.1;
    const auto map = [&](const Vec3& a) -> Vec3 { return F * kBlock(a) + Vec3(1, 2, 3); };
    const CellSolid moduli(cell_body(refined_mesh(), kBlock, kTissue, 1000));
    const Points x = mapped(moduli.mesh(), map);
    EXPECT_LT(squared_error(moduli, x).sum(), 1e-24 * moduli.energy(0, x));

    const CellSolid thesis(cell_body(thesis_cube(4, 100), refined_mesh(), MassFractions::kCells));
    const Points y = mapped(thesis.mesh(), [&](const Vec3& a) -> Vec3 { return F * (kSide * a); });
    EXPECT_LT(squared_error(thesis, y).sum(), 1e-24 * thesis.energy(0, y));
    EXPECT_EQ(squared_error(thesis, y).size(),
              static_cast<Eigen::Index>(thesis.mesh().cells().size()));
}

/// Energy of the difference between the strain of the smooth map and that of the cells, with 4^3 points per cell.
double true_squared_error(const CellSolid& solid) {
    const Points vertices = solid.vertices(mapped(solid.mesh(), smooth_map));
    double sum = 0;
    for (std::size_t c = 0; c < solid.mesh().cells().size(); ++c) {
        const CellMesh::Cell& cell = solid.mesh().cells()[c];
        const auto in_cell = [&](const Vec3& a) -> Vec3 {
            const auto weight = trilinear_weights((a - cell.low).cwiseQuotient(cell.size));
            Vec3 x = Vec3::Zero();
            for (std::size_t k = 0; k < 8; ++k)
                x += weight[k] * vertices.row(cell.vertex[k]).transpose();
            return x;
        };
        const Mat3 inverse = solid.inverse_rest_metric(static_cast<int>(c));
        for (int p = 0; p < 64; ++p) {
            const Vec3 a =
                cell.low +
                Vec3(p / 16 + 0.5, p / 4 % 4 + 0.5, p % 4 + 0.5).cwiseProduct(cell.size / 4);
            Mat3 exact, cells;  // columns are tangents; differences of quadratics are exact
            for (int i = 0; i < 3; ++i) {
                const Vec3 h = 0.1 * cell.size[i] * Vec3::Unit(i);
                exact.col(i) = (smooth_map(a + h) - smooth_map(a - h)) / (2 * h[i]);
                cells.col(i) = (in_cell(a + h) - in_cell(a - h)) / (2 * h[i]);
            }
            const Mat3 off = inverse * (exact.transpose() * exact - cells.transpose() * cells);
            sum += 0.25 * kTissue.mu_pa * (off * off).trace() * cell.size.prod() / 64 /
                   std::sqrt(inverse.determinant());
        }
    }
    return sum;
}

TEST(StrainError, FallsWithTheCellSizeAndIsNearTheTrueError) {
    double before = 0;
    for (const int nodes : {5, 9}) {
        // K = 0, because the cells' dilatation is a mean, which has no exact counterpart point by point.
        const CellSolid solid(cell_body(uniform_cells({nodes, nodes, nodes}), kBlock,
                                        {.mu_pa = kTissue.mu_pa}, 1000));
        const double squared = squared_error(solid, mapped(solid.mesh(), smooth_map)).sum();
        const double effectivity = std::sqrt(squared / true_squared_error(solid));
        EXPECT_GT(effectivity, 0.7) << nodes;
        EXPECT_LT(effectivity, 1.4) << nodes;
        if (before > 0) {
            EXPECT_NEAR(std::log2(std::sqrt(before / squared)), 1, 0.15);
        }
        before = squared;
    }
}

TEST(StrainError, SeesVolumeChangeThatVariesFromCellToCell) {
    const auto error = [](double bulk_pa) {
        const CellSolid solid(
            cell_body(uniform_cells({5, 5, 5}), kBlock, {.mu_pa = 3e3, .bulk_pa = bulk_pa}, 1000));
        return squared_error(solid, mapped(solid.mesh(), smooth_map)).sum();
    };
    const double shape = error(0), both = error(2e4);
    EXPECT_GT(both, 1.1 * shape);
    EXPECT_NEAR(error(4e4) - shape, 2 * (both - shape), 1e-9 * both) << "linear in K";
}

/// The thesis' cube under its weight, held at its highest plane of a3.
bool hang(const std::shared_ptr<CellSolid>& solid, SolveStage stage, solve::MotionState& state) {
    const CellBody& body = solid->body();
    std::vector<char> fixed;
    for (int i = 0; i < solid->mesh().node_count(); ++i)
        fixed.push_back(solid->mesh().material_coordinates()(i, 2) == 1);
    solve::MotionSystem system(body.mass_kg, fixed);
    system.add(solid);
    system.add(std::make_shared<Gravity>(body.mass_kg));
    const Points start = state.x;
    return solve::Newton()
        .solve_equilibrium(
            system, {.end_s = 0, .step_s = std::numeric_limits<double>::infinity(), .start = start},
            {.iterations = 100,
             .tolerance_m = stage == SolveStage::kFinal ? 1e-7 : 1e-3,
             .first_step_s = 30},
            state.x)
        .converged;
}

double tip(const CellSolid& solid, const Points& x) {
    double sum = 0;
    for (const CellMesh::Cell& cell : solid.mesh().cells())
        if (cell.low[2] == 0)
            for (const int corner : {0, 2, 4, 6})
                sum += cell.size[0] * cell.size[1] / 4 *
                       solid.vertices(x)(cell.vertex[static_cast<std::size_t>(corner)], 2);
    return sum;
}

TEST(AdaptiveSolid, HangingCubeIsRefinedAlongTheEdgesOfTheHeldFaceAndAgreesWithTheFineGrid) {
    const RefineOptions options{.tolerance = 0.35, .deepest_level = 1};
    AdaptiveSolid adaptive(thesis_cube(5, 100), options);
    solve::MotionState state = adaptive.start();
    const RefineRounds rounds = solve_and_refine(adaptive, hang, 5, state);
    EXPECT_TRUE(rounds.satisfied);
    EXPECT_TRUE(rounds.converged);
    EXPECT_GE(rounds.meshes, 2);
    EXPECT_FALSE(adaptive.refine(state)) << "satisfied is satisfied";
    EXPECT_TRUE(adaptive.tree().is_split({0, {0, 0, 3}})) << "a corner of the held face";
    EXPECT_TRUE(adaptive.tree().is_split({0, {2, 0, 3}})) << "an edge of it";
    EXPECT_FALSE(adaptive.tree().is_split({0, {0, 0, 0}})) << "a free corner, without strain";

    AdaptiveSolid fine(thesis_cube(5, 100), options);
    EXPECT_TRUE(fine.refine_where([](const CellMesh::Cell&) { return true; }));
    EXPECT_EQ(fine.solid()->mesh().cells().size(), 512u);
    solve::MotionState fine_state = fine.start();
    ASSERT_TRUE(hang(fine.solid(), SolveStage::kFinal, fine_state));
    EXPECT_LT(adaptive.solid()->mesh().node_count(), 0.8 * fine.solid()->mesh().node_count());
    EXPECT_NEAR(tip(*adaptive.solid(), state.x) / tip(*fine.solid(), fine_state.x), 1, 0.01);
}

TEST(AdaptiveSolid, PokedPlaceIsRefinedAndMergedAgainWhenLeftAlone) {
    AdaptiveSolid adaptive(
        {5, 5, 5}, [](CellMesh mesh) { return cell_body(std::move(mesh), kBlock, kTissue, 1000); },
        {.tolerance = 0.3, .merge_below = 0.1, .deepest_level = 2});
    solve::MotionState state = adaptive.start();
    const auto dent = [](const Vec3& a) -> Vec3 {
        const double away = (a - Vec3(0.3, 0.3, 1)).squaredNorm();
        return kBlock(a) - Vec3(0, 0, 0.01 * std::exp(-away / 0.02));
    };
    for (int round = 0; round < 3; ++round) {
        state.x = mapped(adaptive.solid()->mesh(), dent);
        adaptive.refine(state);
    }
    const CellMesh& mesh = adaptive.solid()->mesh();
    EXPECT_EQ(mesh.cells()[static_cast<std::size_t>(mesh.cell_at({0.3, 0.3, 0.99}))].place.level,
              2);
    EXPECT_EQ(mesh.cells()[static_cast<std::size_t>(mesh.cell_at({0.9, 0.9, 0.1}))].place.level, 0);
    EXPECT_GT(adaptive.estimated_error(), 0);

    // Later the strain is elsewhere: cells are split there and merged here.
    const auto elsewhere = [](const Vec3& a) -> Vec3 {
        const double away = (a - Vec3(0.8, 0.8, 0)).squaredNorm();
        return kBlock(a) - Vec3(0, 0, 0.01 * std::exp(-away / 0.02));
    };
    for (int round = 0; round < 4; ++round) {
        state.x = mapped(adaptive.solid()->mesh(), elsewhere);
        adaptive.refine(state);
    }
    const CellMesh& later = adaptive.solid()->mesh();
    EXPECT_EQ(later.cells()[static_cast<std::size_t>(later.cell_at({0.3, 0.3, 0.99}))].place.level,
              0);
    EXPECT_EQ(later.cells()[static_cast<std::size_t>(later.cell_at({0.8, 0.8, 0.01}))].place.level,
              2);
}

TEST(AdaptiveSolid, RestIsNeverRefined) {
    AdaptiveSolid adaptive(thesis_cube(3, 100), {.tolerance = 1e-6});
    solve::MotionState state = adaptive.start();
    EXPECT_FALSE(adaptive.refine(state));
    EXPECT_EQ(adaptive.estimated_error(), 0);
}

TEST(AdaptiveSolid, MaterialAndLinearStatesAreUnchangedByRefinement) {
    AdaptiveSolid adaptive(thesis_cube(3, 100), {.deepest_level = 2});
    Mat3 F;
    F << 1.2, 0.1, -0.2, 0.05, 0.9, 0.3, 0.1, -0.1, 1.1;
    const auto place = [&](const Vec3& a) -> Vec3 { return F * (kSide * a); };
    const auto speed = [](const Vec3& a) -> Vec3 { return {a[1], 2 - a[0], a[2] + a[0]}; };
    solve::MotionState state = adaptive.start();
    state.x = mapped(adaptive.solid()->mesh(), place);
    state.v = mapped(adaptive.solid()->mesh(), speed);
    const double mass = adaptive.solid()->body().mass_kg.sum();
    const double energy = adaptive.solid()->energy(0, state.x);
    EXPECT_NEAR(mass, kMass, 1e-12);

    const auto in_corner = [](const CellMesh::Cell& cell) { return cell.low.maxCoeff() == 0; };
    EXPECT_TRUE(adaptive.refine_where(in_corner, &state));
    EXPECT_FALSE(adaptive.refine_where(in_corner, &state)) << "nothing is left to split";
    const CellSolid& solid = *adaptive.solid();
    EXPECT_GT(solid.mesh().hanging().size(), 0u);
    EXPECT_NEAR(solid.body().mass_kg.sum(), mass, 1e-12 * mass);
    EXPECT_GT(solid.body().mass_kg.minCoeff(), 0);
    EXPECT_NEAR(solid.rest_volume(), kSide * kSide * kSide, 1e-12 * solid.rest_volume());
    EXPECT_LT((state.x - mapped(solid.mesh(), place)).cwiseAbs().maxCoeff(), 1e-14 * kSide * 10);
    EXPECT_LT((state.v - mapped(solid.mesh(), speed)).cwiseAbs().maxCoeff(), 1e-14 * 10);
    EXPECT_NEAR(solid.energy(0, state.x), energy, 1e-12 * energy);
    // Its centre of mass is that of the description too, so the weight acts at the same point.
    const Vec3 centre = solid.body().rest.transpose() * solid.body().mass_kg / mass;
    EXPECT_LT((centre - Vec3::Constant(kSide / 2)).norm(), 1e-12 * kSide);
    // Splits that were asked for stay, whatever the strain.
    state.x = mapped(solid.mesh(), place);
    EXPECT_FALSE(adaptive.refine(state));
}

TEST(AdaptiveSolid, EveryMeshIsSettledOnTheWayAndTheLastToTheEnd) {
    std::vector<std::pair<SolveStage, std::size_t>> calls;
    const auto stretch = [&](const std::shared_ptr<CellSolid>& solid, SolveStage stage,
                             solve::MotionState& state) {
        calls.emplace_back(stage, solid->mesh().cells().size());
        state.x =
            mapped(solid->mesh(), [](const Vec3& a) -> Vec3 { return kSide * (a + a * a[2]); });
        return true;
    };
    AdaptiveSolid adaptive(thesis_cube(2, 100), {.tolerance = 1e-3, .deepest_level = 1});
    solve::MotionState state = adaptive.start();
    RefineRounds rounds = solve_and_refine(adaptive, stretch, 2, state);
    EXPECT_EQ(calls, (decltype(calls){{SolveStage::kIntermediate, 1}, {SolveStage::kFinal, 8}}));
    EXPECT_EQ(rounds.meshes, 2);
    EXPECT_TRUE(rounds.converged);
    EXPECT_FALSE(rounds.satisfied) << "not asked";

    calls.clear();
    rounds = solve_and_refine(adaptive, stretch, 9, state);
    EXPECT_EQ(calls, (decltype(calls){{SolveStage::kIntermediate, 8}, {SolveStage::kFinal, 8}}));
    EXPECT_EQ(rounds.meshes, 1);
    EXPECT_TRUE(rounds.satisfied) << "at its deepest level";
}

TEST(AdaptiveSolid, StopsWhereASolverFails) {
    AdaptiveSolid adaptive(thesis_cube(3, 100), {});
    solve::MotionState state = adaptive.start();
    const RefineRounds rounds = solve_and_refine(
        adaptive, [](const auto&, SolveStage, solve::MotionState&) { return false; }, 3, state);
    EXPECT_EQ(rounds.meshes, 0);
    EXPECT_FALSE(rounds.converged);
    EXPECT_FALSE(rounds.satisfied);
}

TEST(AdaptiveSolid, OptionsOutsideTheirRangesAreNamed) {
    const auto message = [](const RefineOptions& options) -> std::string {
        try {
            AdaptiveSolid(thesis_cube(3, 100), options);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(message({.tolerance = 1}), "RefineOptions: tolerance: expected (0, 1), found 1");
    EXPECT_EQ(message({.tolerance = 0}), "RefineOptions: tolerance: expected (0, 1), found 0");
    EXPECT_EQ(message({.merge_below = -0.1}),
              "RefineOptions: merge_below: expected [0, 1), found -0.1");
    EXPECT_EQ(message({.deepest_level = 9}),
              "RefineOptions: deepest_level: expected [0, 8], found 9");
    EXPECT_EQ(message({.tolerance = std::nan("")}).substr(0, 34),
              "RefineOptions: tolerance: expected");
}

}  // namespace
}  // namespace risorius::tissue
