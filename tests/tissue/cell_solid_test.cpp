// SPDX-License-Identifier: MIT
// The solid of trilinear cells: forces, energies, stiffness, volume and moduli, on uniform and on refined meshes.
#include "risorius/tissue/cell_solid.h"

#include <gtest/gtest.h>

#include <limits>

#include "risorius/core/dense_algebra.h"
#include "second_derivative_checks.h"
#include "tissue/cell_solids.h"

namespace risorius::tissue {
namespace {

using namespace cell_solids;
using solve::Curvature;
using solve::ImplicitStep;

constexpr double kEver = std::numeric_limits<double>::infinity();

/// A solid and a state in which every part is deformed.
struct Case {
    const char* name;
    CellSolid solid;
    double amplitude;  ///< of the random displacement, m

    Points state(unsigned seed) const { return jolted(solid.body().rest, amplitude, seed); }
};

std::vector<std::unique_ptr<Case>> cases() {
    std::vector<std::unique_ptr<Case>> list;
    const auto add = [&](const char* name, CellBody body, double amplitude) {
        list.push_back(
            std::unique_ptr<Case>(new Case{name, CellSolid(std::move(body)), amplitude}));
    };
    add("thesis' cube", cell_body(thesis_cube(4, 10.0, 0.1)), 0.2);
    add("varied solid", cell_body(varied_solid({4, 3, 5})), 0.05);
    add("varied solid, refined",
        cell_body(varied_solid({4, 4, 4}), refined_mesh(), MassFractions::kCells), 0.04);
    add("tissue, refined block",
        cell_body(
            refined_mesh(), [](const Vec3& a) -> Vec3 { return 0.1 * a; }, {5e3, 1e5, 40.0}, 1060),
        0.002);
    add("tissue, bent and refined", cell_body(refined_mesh(), bent, {5e3, 1e5, 40.0}, 1060), 0.001);
    return list;
}

// ---- The sums of the header, written out, as a reference for the inner loop.

double plain_energy(const CellSolid& solid, const Points& x) {
    const CellBody& body = solid.body();
    const Points all = solid.vertices(x), rest = solid.vertices(body.rest);
    double sum = 0;
    for (std::size_t c = 0; c < body.mesh.cells().size(); ++c) {
        const CellMesh::Cell& cell = body.mesh.cells()[c];
        const double fraction = cell.size.prod() / 8;
        double volume = 0, rest_volume = 0, metric = 0;
        for (int g = 0; g < 8; ++g) {
            Mat3 r = Mat3::Zero(), r0 = Mat3::Zero();
            for (int v = 0; v < 8; ++v)
                for (int i = 0; i < 3; ++i) {
                    double d = 1 / cell.size[i];
                    for (int k = 0; k < 3; ++k) {
                        const int bit = 4 >> k;
                        if (k == i)
                            d *= (v & bit) ? 1 : -1;
                        else
                            d *= (1 + ((v & bit) == (g & bit) ? 1 : -1) / std::sqrt(3.0)) / 2;
                    }
                    const int row = cell.vertex[static_cast<std::size_t>(v)];
                    r.col(i) += d * all.row(row).transpose();
                    r0.col(i) += d * rest.row(row).transpose();
                }
            volume += fraction * r.determinant();
            rest_volume += fraction * r0.determinant();
            const Mat3 strain = r.transpose() * r - r0.transpose() * r0;
            if (body.moduli.empty()) {
                metric += fraction * 0.25 *
                          body.parameters[c]
                              .elastic_n_per_m3.cwiseProduct(strain.cwiseProduct(strain))
                              .sum();
            } else {
                const Mat3 C = (r0.transpose() * r0).inverse();
                metric += fraction * r0.determinant() * 0.25 * body.moduli[c].mu_pa *
                          (C * strain * C * strain).trace();
            }
        }
        const double psi = body.moduli.empty()
                               ? body.parameters[c].incompressibility_n_per_m5 / cell.size.prod()
                               : body.moduli[c].bulk_pa / (2 * rest_volume);
        sum += metric + psi * (volume - rest_volume) * (volume - rest_volume);
    }
    return sum;
}

TEST(CellSolid, EnergyIsThatOfThePlainSumOverGaussPoints) {
    for (const auto& at : cases()) {
        const Points x = at->state(1);
        const double plain = plain_energy(at->solid, x);
        EXPECT_NEAR(at->solid.energy(0, x), plain, 1e-12 * plain) << at->name;
        EXPECT_NEAR(at->solid.energy(0, at->solid.body().rest), 0, 1e-22 * plain) << at->name;
    }
}

TEST(CellSolid, ForceIsMinusTheDerivativeOfEnergy) {  // T1
    for (const auto& at : cases()) {
        const Points x = at->state(2);
        const Points still = Points::Zero(x.rows(), 3);
        Points force = still;
        at->solid.add_force(0, x, still, force);
        for (unsigned seed = 3; seed < 8; ++seed) {
            const Points along = jolted(still, 1.0, seed);
            // Fourth-order difference, because the energy is of degree six in x.
            const auto e = [&](double t) { return at->solid.energy(0, x + t * along); };
            const double h = 1e-3 * at->amplitude;
            const double slope = (8 * (e(h) - e(-h)) - (e(2 * h) - e(-2 * h))) / (12 * h);
            const double scale = force.norm() * along.norm();
            EXPECT_NEAR(-force.cwiseProduct(along).sum(), slope, 1e-8 * scale) << at->name;
        }
    }
}

TEST(CellSolid, InternalForcesHaveNoNetForceAndTorqueAndDampingBrakes) {  // T3
    for (const auto& at : cases()) {
        const Points x = at->state(4);
        const Points v = jolted(Points::Zero(x.rows(), 3), 10 * at->amplitude, 5);
        Points elastic = Points::Zero(x.rows(), 3), damped = elastic;
        at->solid.add_force(0, x, Points::Zero(x.rows(), 3), elastic);
        at->solid.add_force(0, x, v, damped);
        const Points viscous = damped - elastic;
        EXPECT_GT(viscous.norm(), 1e-3 * elastic.norm()) << at->name;
        for (const Points& f : {elastic, viscous}) {
            const double largest = f.cwiseAbs().maxCoeff();
            EXPECT_LT(f.colwise().sum().norm(), 1e-9 * largest) << at->name;
            Vec3 torque = Vec3::Zero();
            for (Eigen::Index i = 0; i < x.rows(); ++i)
                torque += Vec3(x.row(i)).cross(Vec3(f.row(i)));
            EXPECT_LT(torque.norm(), 1e-9 * largest) << at->name;
        }
        EXPECT_LT(viscous.cwiseProduct(v).sum(), 0) << at->name;

        // Rotation of the whole body causes no strain.
        const Vec3 spin(0.3, -0.5, 0.8);
        Points turning(x.rows(), 3);
        for (Eigen::Index i = 0; i < x.rows(); ++i)
            turning.row(i) = spin.cross(Vec3(x.row(i))).transpose();
        Points f = Points::Zero(x.rows(), 3);
        at->solid.add_force(0, x, turning, f);
        EXPECT_LT((f - elastic).norm(), 1e-10 * elastic.norm()) << at->name;
    }
}

TEST(CellSolid, PotentialOfAStepHasTheDampingForceOfItsVelocityInTheLimit) {
    for (const auto& at : cases()) {
        const Points start = at->state(6);
        const Points v = jolted(Points::Zero(start.rows(), 3), 10 * at->amplitude, 7);
        const double h = 1e-7;
        const Points x = start + h * v;
        Points force = Points::Zero(x.rows(), 3), gradient = force;
        at->solid.add_force(0, x, v, force);
        at->solid.add_potential({h, h, start}, x, gradient);
        EXPECT_LT((force + gradient).norm(), 1e-5 * force.norm()) << at->name;
    }
}

TEST(CellSolid, GradientOfAStepIsTheDerivativeOfItsPotential) {
    for (const auto& at : cases()) {
        const Points start = at->state(8), x = at->state(9);
        for (const double h : {0.01, kEver}) {
            const ImplicitStep step{h, h, start};
            Points gradient = Points::Zero(x.rows(), 3), scratch = gradient;
            at->solid.add_potential(step, x, gradient);
            const Points along = jolted(scratch, 1.0, 10);
            const auto e = [&](double t) {
                return at->solid.add_potential(step, x + t * along, scratch);
            };
            const double d = 1e-3 * at->amplitude;
            const double slope = (8 * (e(d) - e(-d)) - (e(2 * d) - e(-2 * d))) / (12 * d);
            EXPECT_NEAR(gradient.cwiseProduct(along).sum(), slope,
                        1e-8 * gradient.norm() * along.norm())
                << at->name << ", h = " << h;
        }
    }
}

TEST(CellSolid, StepWithoutMotionDissipatesNothing) {
    for (const auto& at : cases()) {
        const Points x = at->state(8);
        Points gradient = Points::Zero(x.rows(), 3);
        const double e = at->solid.energy(0, x);
        EXPECT_NEAR(at->solid.add_potential({0.01, 0.01, x}, x, gradient), e, 1e-11 * e)
            << at->name;
    }
}

Eigen::MatrixXd whole(const Eigen::SparseMatrix<double>& lower) {
    const Eigen::MatrixXd dense = lower;
    return dense.selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd full_hessian(const CellSolid& solid, const ImplicitStep& step, const Points& x,
                             Curvature curvature) {
    solve::HessianBuilder builder(static_cast<int>(x.rows()), {});
    solid.add_hessian(step, x, curvature, builder);
    return whole(builder.build());
}

TEST(CellSolid, ExactStiffnessIsTheDerivativeOfTheGradient) {
    for (const auto& at : cases()) {
        const Points start = at->state(11), x = at->state(12);
        for (const double h : {0.01, kEver}) {
            const ImplicitStep step{h, h, start};
            const Eigen::MatrixXd H = full_hessian(at->solid, step, x, Curvature::kExact);
            const Points along = jolted(Points::Zero(x.rows(), 3), 1.0, 13);
            const auto gradient = [&](double t) {
                Points g = Points::Zero(x.rows(), 3);
                at->solid.add_potential(step, x + t * along, g);
                return g;
            };
            const double d = 1e-3 * at->amplitude;
            const Points change =
                (8 * (gradient(d) - gradient(-d)) - (gradient(2 * d) - gradient(-2 * d))) /
                (12 * d);
            const Eigen::Map<const Eigen::VectorXd> by(along.data(), along.size()),
                measured(change.data(), change.size());
            EXPECT_LT((H * by - measured).norm(), 1e-8 * measured.norm())
                << at->name << ", h = " << h;
        }
    }
}

TEST(CellSolid, PositiveStiffnessHasNoNegativeEigenvalueAndIsExactAtRest) {
    for (const auto& at : cases()) {
        const Points x = at->state(14), start = at->solid.body().rest;
        const ImplicitStep step{0.01, 0.01, start};
        const Eigen::VectorXd values =
            symmetric_eigenvalues(full_hessian(at->solid, step, x, Curvature::kPositive));
        EXPECT_GT(values[0], -1e-12 * values.tail(1)[0]) << at->name;
        const Eigen::MatrixXd exact = full_hessian(at->solid, step, start, Curvature::kExact),
                              positive = full_hessian(at->solid, step, start, Curvature::kPositive);
        EXPECT_LT((exact - positive).norm(), 1e-11 * exact.norm()) << at->name;
    }
}

TEST(CellSolid, MetricBoundsTheStiffnessAtRest) {
    for (const auto& at : cases()) {
        const Points& rest = at->solid.body().rest;
        const int n = static_cast<int>(rest.rows());
        const double h = 0.01;
        solve::MetricBuilder builder(n);
        at->solid.add_metric(h, builder);
        Eigen::MatrixXd metric = Eigen::MatrixXd::Zero(3 * n, 3 * n), mass = metric;
        const Eigen::MatrixXd scalar = whole(builder.build({}));
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (int k = 0; k < 3; ++k) metric(3 * i + k, 3 * j + k) = scalar(i, j);
        // A small mass removes rigid motions, which neither matrix resists, from the quotient.
        metric.diagonal().array() += 1e-6 * scalar.norm();
        Eigen::MatrixXd H = full_hessian(at->solid, {h, h, rest}, rest, Curvature::kExact);
        H.diagonal().array() += 1e-6 * scalar.norm();
        const double max = testing_of::fractions(H, metric).maxCoeff();
        EXPECT_LT(max, 3.0) << at->name;  // div u counts at most three times
        EXPECT_GT(max, 0.5) << at->name;
    }
}

TEST(CellSolid, CellVolumesSumToTheVolumeWithinTheSurface) {
    const GridShape grid{4, 3, 5};
    const CellSolid solid(cell_body(varied_solid(grid)));
    const Points x = jolted(solid.body().rest, 0.05, 15);
    const double hull = enclosed_volume(grid, x);
    EXPECT_NEAR(solid.volume(x), hull, 1e-13 * hull);
    EXPECT_EQ(solid.inverted_count(x), 0);

    // There are no gaps and overlaps where cells of different sizes meet: moving inner nodes does not change the total.
    const CellSolid refined(cell_body(thesis_cube(4, 10.0), refined_mesh(), MassFractions::kCells));
    Points moved = refined.body().rest;
    const Points& a = refined.mesh().material_coordinates();
    const Points shakes = jolted(Points::Zero(moved.rows(), 3), 0.1, 16);
    for (Eigen::Index i = 0; i < moved.rows(); ++i)
        if (a.row(i).minCoeff() > 0 && a.row(i).maxCoeff() < 1) moved.row(i) += shakes.row(i);
    EXPECT_NEAR(refined.volume(moved), 27.0, 1e-12);
    EXPECT_GT((refined.cell_volumes(moved) - refined.cell_volumes(refined.body().rest)).norm(),
              0.01);
}

TEST(CellSolid, SecantTimesPositionsIsTheForce) {
    for (const auto& at : cases()) {
        const Points x = at->state(17);
        const Points v = jolted(Points::Zero(x.rows(), 3), 10 * at->amplitude, 18);
        Points force = Points::Zero(x.rows(), 3);
        at->solid.add_force(0, x, v, force);
        for (const bool lag : {false, true}) {
            solve::MetricBuilder K(static_cast<int>(x.rows())), damping(static_cast<int>(x.rows()));
            Points rest_of_it = Points::Zero(x.rows(), 3);
            at->solid.add_secant(0, x, v, lag, K, damping, rest_of_it);
            const Points from_k = -(whole(K.build({})) * x);
            EXPECT_LT((from_k + rest_of_it - force).norm(), 1e-11 * force.norm())
                << at->name << ", lagged " << lag;
        }
    }
}

TEST(CellSolid, LinearDeformationHasOneEnergyDensityAndNoForceInside) {  // patch test
    Mat3 F;
    F << 1.10, 0.05, -0.02, 0.03, 0.93, 0.04, 0.01, -0.06, 1.05;
    const auto block = [](const Vec3& a) -> Vec3 { return Vec3(0.10, 0.12, 0.08).cwiseProduct(a); };
    const CellModuli tissue{5e3, 1e5, 0};
    const CellSolid coarse(cell_body(uniform_cells({2, 2, 2}), block, tissue, 1060));
    const CellSolid refined(cell_body(refined_mesh(), block, tissue, 1060));
    ASSERT_GT(refined.mesh().hanging().size(), 20u);
    const auto deformed = [&](const CellSolid& solid) -> Points {
        return solid.body().rest * F.transpose();
    };
    const double expected = coarse.energy(0, deformed(coarse));
    const Points x = deformed(refined);
    EXPECT_NEAR(refined.energy(0, x), expected, 1e-12 * expected);

    Points force = Points::Zero(x.rows(), 3);
    refined.add_force(0, x, Points::Zero(x.rows(), 3), force);
    const Points& a = refined.mesh().material_coordinates();
    int inside = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        if (a.row(i).minCoeff() > 0 && a.row(i).maxCoeff() < 1) {
            ++inside;
            EXPECT_LT(force.row(i).norm(), 1e-10 * force.cwiseAbs().maxCoeff()) << "node " << i;
        }
    EXPECT_GT(inside, 20);

    // Hanging vertices follow the deformation exactly.
    const Points all = refined.vertices(x), rest = refined.vertices(refined.body().rest);
    EXPECT_LT((all - rest * F.transpose()).norm(), 1e-14);
}

TEST(CellSolid, UniaxialStretchShowsYoungsModulusTwiceTheShearModulus) {
    // K = 0: nothing resists lateral strain and nothing causes it, nu = 0.
    const double mu = 5e3, L = 0.1;
    const auto cube = [&](const Vec3& a) -> Vec3 { return L * a; };
    const CellSolid solid(cell_body(uniform_cells({4, 4, 4}), cube, {mu, 0, 0}, 1060));
    // The same material in the thesis' parameters: lambda = mu / L.
    GridSolid thesis;
    thesis.grid = {4, 4, 4};
    thesis.rest = block_rest(thesis.grid, Vec3::Constant(L));
    thesis.material = {isotropic_material(mu / L, 0, 0, 1, 0)};
    const CellSolid same(cell_body(thesis));
    const double strain = 1e-6;
    Points x = solid.body().rest;
    x.col(2) *= 1 + strain;
    for (const CellSolid* body : {&solid, &same}) {
        Points force = Points::Zero(x.rows(), 3);
        body->add_force(0, x, Points::Zero(x.rows(), 3), force);
        double pull = 0;
        for (Eigen::Index i = 0; i < x.rows(); ++i)
            if (body->mesh().material_coordinates()(i, 2) == 1) pull -= force(i, 2);
        EXPECT_NEAR(pull / (L * L) / strain, 2 * mu, 1e-5 * mu);
        EXPECT_LT(force.leftCols(2).norm(), 1e-9 * force.norm());
    }
}

TEST(CellSolid, ModuliMeanTheSameOnACurvedRestShapeAsOnABlock) {
    // A uniform swelling of any body: W = V (3 mu/4 (s^2 - 1)^2 + K/2 (s^3 - 1)^2).
    const CellModuli tissue{5e3, 1e5, 0};
    const CellSolid solid(cell_body(refined_mesh(), bent, tissue, 1060));
    const double s = 1.07, V = solid.rest_volume();
    const double expected = V * (0.75 * tissue.mu_pa * std::pow(s * s - 1, 2) +
                                 0.5 * tissue.bulk_pa * std::pow(s * s * s - 1, 2));
    EXPECT_NEAR(solid.energy(0, s * solid.body().rest), expected, 1e-12 * expected);
    EXPECT_NEAR(solid.body().mass_kg.sum(), 1060 * V, 1e-12 * 1060 * V);
}

TEST(CellSolid, MassOfTheDescriptionIsKeptOnAnyMesh) {
    const GridSolid varied = varied_solid({4, 4, 4});
    const double total = node_mass(varied).sum();
    EXPECT_NEAR(cell_body(varied).mass_kg.sum(), total, 1e-12 * total);
    EXPECT_NEAR(cell_body(varied, refined_mesh(), MassFractions::kCells).mass_kg.sum(), total,
                1e-12 * total);
    EXPECT_GT(cell_body(varied, refined_mesh(), MassFractions::kCells).mass_kg.minCoeff(), 0);
    EXPECT_NEAR((cell_body(varied).mass_kg - node_mass(varied)).norm(), 0, 1e-14);
    EXPECT_THROW(cell_body(varied, refined_mesh(), MassFractions::kNodes), std::invalid_argument);
}

TEST(CellSolid, ParametersPerNodeAreThoseOfEquation10AtTheirResolution) {
    GridSolid independent = thesis_cube(5, 10.0, 0.1), per_node = independent;
    SolidMaterial& material = per_node.material.front();
    material.elastic_n_per_m3 = per_node_tensor(material.elastic_n_per_m3, per_node.grid);
    material.damping_ns_per_m3 = per_node_tensor(material.damping_ns_per_m3, per_node.grid);
    material.incompressibility_n_per_m5 /= 64;
    per_node.parameters = Parameters::kPerNode;
    const CellSolid a(cell_body(independent)), b(cell_body(per_node));
    const Points x = jolted(a.body().rest, 0.2, 19);
    EXPECT_NEAR(a.energy(0, x), b.energy(0, x), 1e-13 * a.energy(0, x));
}

TEST(CellSolid, SameStateGivesTheSameBits) {
    for (const auto& at : cases()) {
        const Points start = at->state(20), x = at->state(21);
        const CellSolid other(at->solid.body());
        Points g1 = Points::Zero(x.rows(), 3), g2 = g1, ignored = g1;
        const double e1 = at->solid.add_potential({0.01, 0.01, start}, x, g1);
        other.add_potential({0.02, 0.02, x}, start, ignored);  // another step in between
        const double e2 = other.add_potential({0.01, 0.01, start}, x, g2);
        EXPECT_EQ(e1, e2) << at->name;
        EXPECT_EQ(g1, g2) << at->name;
    }
}

TEST(CellSolid, RestWithoutVolumeAndArraysThatDoNotFitAreRefused) {
    CellBody folded = cell_body(thesis_cube(3, 10.0));
    folded.rest.col(0) *= -1;
    EXPECT_THROW(CellSolid{folded}, std::invalid_argument);
    CellBody short_of_one = cell_body(thesis_cube(3, 10.0));
    short_of_one.parameters.pop_back();
    EXPECT_THROW(CellSolid{short_of_one}, std::invalid_argument);
}

}  // namespace
}  // namespace risorius::tissue
