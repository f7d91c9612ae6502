// SPDX-License-Identifier: MIT
// Volume muscles whose belly is a mesh of tetrahedra: the rig samples/belly, closed forms, derivatives, and messages.
#include "risorius/face/muscle/detail/mesh_belly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "face/adult_face.h"
#include "message_of.h"
#include "paths.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/detail/jaw_muscles.h"
#include "risorius/face/fields.h"
#include "risorius/face/muscle/detail/muscle_solids.h"
#include "risorius/muscle/muscle_curves.h"
#include "risorius/rig/muscle_force.h"
#include "tet_blocks.h"

namespace risorius::face {
namespace {

const std::filesystem::path kSample = std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples/belly";
constexpr const char* kMasseter = "masseter_superficial";

Face face_with_belly(const rig::RigDescription& rig) {
    return Face(rig, rig::adult().mesh, {"test", 400, 6}, "adult");
}

rig::RigDescription sample() { return rig::read_rig(kSample / "rig.json"); }

/// The sample with other numbers for its mesh.
rig::RigDescription with_mesh(const Json& changes) {
    rig::RigDescription rig = sample();
    Json solids = rig::solid_muscles_json(rig.solids);
    solids[kMasseter]["mesh"].update(changes);
    rig.solids = rig::read_solid_muscles(JsonCursor::from_json(solids, "rig"), rig.muscles);
    return rig;
}

SolidFigures figures_of(const Face& face, Side side = Side::kLeft) {
    for (const SolidFigures& figures : face.diagnostics().solid_figures())
        if (figures.muscle == kMasseter && figures.side == side) return figures;
    ADD_FAILURE() << "no volume muscle";
    return {};
}

class BellySample : public testing::Test {
  protected:
    static Face& face() {
        static Face one = face_with_belly(sample());
        return one;
    }
};

TEST_F(BellySample, WithoutActivationNothingMoves) {
    const FacePose pose = equilibrium_pose(face(), neutral());
    EXPECT_LT((pose.vertices - face().head().vertices).rowwise().norm().maxCoeff(), 1e-6);
    EXPECT_NEAR(figures_of(face()).volume_ratio, 1.0, 1e-9);
}

TEST_F(BellySample, AContractionKeepsTheVolume) {
    StepStats stats;
    equilibrium_pose(face(), with_muscle(kMasseter, 1.0), &stats);
    EXPECT_LT(stats.last_step_rms_m, 1e-4);
    const SolidFigures left = figures_of(face()), right = figures_of(face(), Side::kRight);
    EXPECT_NEAR(left.volume_ratio, 1.0, 0.01);
    EXPECT_GT(left.min_cell_ratio, 0.4);
    EXPECT_LT(left.mean_stretch, 0.995);
    // It has no tendons and is held at both ends, so its fibres become straight rather than short
    EXPECT_NEAR(left.thickness_ratio, 0.91, 0.05);
    EXPECT_NEAR(left.mean_stretch, right.mean_stretch, 0.005) << "the right one is mirrored";
}

TEST_F(BellySample, AnOpenJawStretchesIt) {
    equilibrium_pose(face(), with_kinematic(track::Kinematic::kJawOpen, 0.4));
    const SolidFigures opened = figures_of(face());
    EXPECT_GT(opened.mean_stretch, 1.05);
    EXPECT_NEAR(opened.volume_ratio, 1.0, 0.01);
}

TEST_F(BellySample, TheSameDrivesGiveTheSameBits) {
    const auto run = [&] {
        face().start(always(neutral()));
        for (int i = 0; i < 6; ++i) face().step(always(with_muscle(kMasseter, 0.6)));
        return face().pose().vertices;
    };
    const Points once = run();
    EXPECT_EQ(once, run());
    EXPECT_NEAR(figures_of(face()).volume_ratio, 1.0, 0.01);
}

TEST_F(BellySample, ItsForceIsThatOfTheTable) {
    equilibrium_pose(face(), neutral());
    const rig::RigDescription rig = sample();
    const rig::Muscle& muscle =
        *std::find_if(rig.muscles.muscles.begin(), rig.muscles.muscles.end(),
                      [](const rig::Muscle& one) { return one.id == kMasseter; });
    EXPECT_NEAR(*face().diagnostics().greatest_force_n(kMasseter, Side::kLeft),
                rig::muscle_force(rig, muscle, face().head().size).greatest_n, 1e-9);
}

TEST_F(BellySample, ItsFieldsAreTetrahedra) {
    equilibrium_pose(face(), with_muscle(kMasseter, 0.3));
    const SolidFields fields = face().fields().now().solids;
    ASSERT_EQ(fields.cells.rows(), 2 * 384);
    for (int k : {0, 1, 2}) EXPECT_NE(fields.cells(0, k), fields.cells(0, k + 1 + (k == 2)));
    EXPECT_EQ(fields.cells(0, 2), fields.cells(0, 3));
    EXPECT_EQ(fields.cells(0, 4), fields.cells(0, 7));
    double fibres = 0;
    for (const FibreState& state : fields.state) fibres += std::abs(state.direction.y());
    EXPECT_GT(fibres / static_cast<double>(fields.state.size()), 0.7) << "down from the cheekbone";
    EXPECT_GT(fields.state.front().tension_n, 1);
}

/// A muscle of 40 x 10 x 10 mm along y, as a part of its own.
struct Prism {
    rig::RigDescription rig = sample();
    SolidPlacement nodes;
    SolidPart part;

    explicit Prism(const testing_of::TetBlock& block) {
        part.muscle = &*std::find_if(rig.muscles.muscles.begin(), rig.muscles.muscles.end(),
                                     [](const rig::Muscle& one) { return one.id == kMasseter; });
        part.solid = &rig.solids.front();
        part.f0_n = 50;
        part.tets = block.tets;
        part.fibres = Vec3::UnitX().transpose().replicate(block.tets.rows(), 1);
        part.density.assign(static_cast<std::size_t>(block.tets.rows()), 1.0);
        part.length_m = block.rest.col(0).maxCoeff();
        for (Eigen::Index i = 0; i < block.rest.rows(); ++i) {
            part.node.push_back(static_cast<int>(i));
            part.along.push_back(block.rest(i, 0) / part.length_m);
            nodes.nodes.push_back({.rest = block.rest.row(i).transpose()});
        }
    }
};

TEST(MeshBelly, PullsWithTheForceOfTheTableTimesItsCurves) {
    const auto block = testing_of::tet_block({4, 1, 1}, {0.04, 0.01, 0.01});
    const Prism prism(block);
    MeshBelly belly(prism.part, prism.nodes, prism.rig);
    belly.begin_step(std::numeric_limits<double>::infinity(), block.rest);
    const muscle::MuscleCurves curves = muscle::zajac_curves();
    const double rest_stretch = prism.part.muscle->rest_stretch;
    for (const double factor : {1.0, 0.5, 0.0})
        for (const double a : {0.0, 0.4, 1.0}) {
            belly.set_strength(factor);
            Points gradient = Points::Zero(block.rest.rows(), 3);
            double energy = 0;
            belly.add_energy(block.rest, a, energy, gradient);
            double pull = 0;
            for (Eigen::Index i = 0; i < gradient.rows(); ++i)
                if (block.rest(i, 0) == 0) pull -= gradient(i, 0);
            const double expected = 50 * factor * a * curves.active.value(rest_stretch);
            EXPECT_NEAR(pull, expected, 1e-9);
            EXPECT_NEAR(belly.chain_states(block.rest, a).front().force_n, expected, 1e-9);
        }
    EXPECT_NEAR(belly.mass_kg().sum(), 1060 * 4e-6, 1e-9);
}

// PMC8754054: a tensile anisotropy of 4.67 beside a shear modulus of 1.93 kPa across the fibres is 3 x 1.93 x 4.67 = 27 kPa.
TEST(MeshBelly, RelaxedFibresPullWithThePublishedModulus) {
    const auto block = testing_of::tet_block({4, 1, 1}, {0.04, 0.01, 0.01});
    const auto pull_pa = [&](const rig::SolidMuscle& solid, double stretch) {
        Prism prism(block);
        const auto& table = prism.rig.muscles.muscles;
        prism.part.solid = &solid;
        prism.part.muscle = &*std::find_if(table.begin(), table.end(), [&](const rig::Muscle& one) {
            return one.id == solid.muscle;
        });
        prism.part.f0_n = 1e-4 * 4e5;  // 0.4 MPa
        MeshBelly belly(prism.part, prism.nodes, prism.rig);
        belly.begin_step(std::numeric_limits<double>::infinity(), block.rest);
        const double across = 1 / std::sqrt(stretch);
        const Points x = block.rest * Vec3(stretch, across, across).asDiagonal();
        Points gradient = Points::Zero(x.rows(), 3);
        double energy = 0;
        belly.add_energy(x, 0.0, energy, gradient);
        double pull_n = 0;
        for (Eigen::Index i = 0; i < gradient.rows(); ++i)
            if (block.rest(i, 0) == 0) pull_n -= gradient(i, 0);
        return pull_n / 1e-4;
    };
    ASSERT_EQ(rig::adult().rig.solids.size(), 7u);
    for (const rig::SolidMuscle& solid : rig::adult().rig.solids) {
        rig::SolidMuscle matrix = solid;
        matrix.stretch_along_pa = 0;
        const auto of_fibres_pa = [&](double stretch) {
            return pull_pa(solid, stretch) - pull_pa(matrix, stretch);
        };
        EXPECT_NEAR(of_fibres_pa(1.01), 0.01 * 3 * 1930 * 4.67, 2) << solid.muscle;
        EXPECT_NEAR(of_fibres_pa(1.1), 0.1 * 3 * 1930 * 4.67, 20) << solid.muscle;
        EXPECT_NEAR(of_fibres_pa(0.9), 0, 1e-6) << solid.muscle << ": shortened fibres are slack";
    }
}

// Peck et al. 2000: jaw muscles have 1.5 % of their force at 1.5 times their length.
TEST(MeshBelly, RelaxedJawMusclesPullAsPublishedOrMore) {
    const double published = 0.015;
    const muscle::MuscleCurves curves = muscle::zajac_curves({.passive_strain = kJawPassiveStrain});
    EXPECT_NEAR(curves.passive.value(1.5), published, 0.1 * published);
    for (const rig::SolidMuscle& solid : rig::adult().rig.solids)
        if (solid.muscle.starts_with("masseter") || solid.muscle.starts_with("temporalis"))
            EXPECT_GT(0.5 * solid.stretch_along_pa, published * 4e5) << solid.muscle;
}

TEST(MeshBelly, HasTheDerivativesOfItsEnergy) {
    const auto block = testing_of::tet_block({2, 1, 1}, {0.02, 0.01, 0.01});
    const Prism prism(block);
    MeshBelly belly(prism.part, prism.nodes, prism.rig);
    belly.begin_step(std::numeric_limits<double>::infinity(), block.rest);
    Points x = block.rest;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        x.row(i) += 5e-4 * Vec3(std::sin(3.0 * static_cast<double>(i)),
                                std::sin(5.0 * static_cast<double>(i)),
                                std::cos(7.0 * static_cast<double>(i)))
                               .transpose();
    const auto slope_at = [&](const Points& at) {
        Points gradient = Points::Zero(at.rows(), 3);
        double energy = 0;
        belly.add_energy(at, 0.7, energy, gradient);
        return std::pair(energy, gradient);
    };
    const Points gradient = slope_at(x).second;
    std::vector<int> row;
    for (int i = 0; i < static_cast<int>(x.rows()); ++i) row.push_back(i);
    solve::HessianBuilder builder(static_cast<int>(x.rows()), {});
    belly.add_hessian(x, 0.7, solve::Curvature::kExact, row, builder);
    const Eigen::MatrixXd lower = builder.build();
    const Eigen::MatrixXd second = lower.selfadjointView<Eigen::Lower>();
    const double h = 1e-7;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        Points above = x, below = x;
        above.data()[k] += h;
        below.data()[k] -= h;
        const auto up = slope_at(above), down = slope_at(below);
        EXPECT_NEAR(gradient.data()[k], (up.first - down.first) / (2 * h),
                    1e-6 * gradient.cwiseAbs().maxCoeff());
        const Points change = (up.second - down.second) / (2 * h);
        for (Eigen::Index l = 0; l < x.size(); ++l)
            ASSERT_NEAR(second(l, k), change.data()[l], 1e-5 * second.cwiseAbs().maxCoeff());
    }
}

TEST(MeshBelly, FindsPointsInItsTetrahedra) {
    const auto block = testing_of::tet_block({4, 1, 1}, {0.04, 0.01, 0.01});
    const Prism prism(block);
    const MeshBelly belly(prism.part, prism.nodes, prism.rig);
    for (const Vec3& p : {Vec3(0.013, 0.004, 0.008), Vec3(0.03, -0.002, 0.005)}) {
        double excess = 0.35;
        BellyPoint found;
        belly.find(p, excess, found);
        ASSERT_EQ(found.count, 4);
        Vec3 at = Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k)
            at += found.weight[k] * block.rest.row(found.node[k]).transpose();
        EXPECT_LT((at - p).norm(), 1e-12);
        EXPECT_EQ(excess > 0, p.y() < 0);
    }
    double excess = 0.35;
    BellyPoint none;
    belly.find({0.02, 0.02, 0.005}, excess, none);
    EXPECT_EQ(none.count, 0);
}

TEST(MeshBelly, DirectionsMayBeGivenOrComputed) {
    rig::RigDescription flow = sample();
    auto without = std::make_shared<io::TetMesh>(*flow.solids.front().mesh->left);
    const Points of_file = without->fibres;
    without->fibres.resize(0, 3);
    flow.solids.front().mesh->left = without;
    for (const rig::RigDescription& rig : {with_mesh({{"along", {-9.7, -40, -25.6}}}), flow,
                                           with_mesh({{"metres_per_unit", 0.001}})}) {
        const Face face = face_with_belly(rig);
        Vec3 mean = Vec3::Zero();
        for (const FibreState& state : face.fields().now().solids.state)
            if (state.direction.x() < 0) mean += state.direction;
        EXPECT_GT(mean.normalized().dot(Vec3(-9.7, -40, -25.6).normalized()), 0.97);
    }
}

TEST(MeshBelly, MistakesAreNamedWithWhatWasExpected) {
    const std::string place = "anatomy/solids/masseter_superficial/mesh";
    EXPECT_EQ(message_of([] {
                  face_with_belly(with_mesh({{"metres_per_unit", 0.0005}}));
              }),
              place +
                  ": expected a mesh around the path of its muscle, in the coordinates of the mesh "
                  "of the rig, found one whose middle is 35 mm away from it");
    rig::RigDescription pointed = sample();
    auto tip = std::make_shared<io::TetMesh>(*pointed.solids.front().mesh->left);
    tip->positions.row(7) += Vec3(1.6, 6.5, 4.2).transpose();
    pointed.solids.front().mesh->left = tip;
    EXPECT_EQ(message_of([&] { face_with_belly(pointed); }),
              place +
                  "/ends/0: expected a fraction with at least 3 nodes of the mesh at the origin, "
                  "found 0.06 with 1");
    rig::RigDescription rig = sample();
    auto half = std::make_shared<io::TetMesh>(*rig.solids.front().mesh->left);
    half->fibres.row(6).setZero();
    rig.solids.front().mesh->left = half;
    EXPECT_EQ(
        message_of([&] { face_with_belly(rig); }),
        place +
            ": expected a direction of fibres in every tetrahedron, and none that lies within an "
            "end with all corners, found none in "
            "tetrahedron 7");
}

}  // namespace
}  // namespace risorius::face
