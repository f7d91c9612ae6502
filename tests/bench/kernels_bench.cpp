// SPDX-License-Identifier: MIT
// What one frame of the face is made of, at the size of the face: a curved patch of 41 x 41 x 3 nodes (5,043 nodes, 19,200
// tets, 3,200 triangles), 1,800 fibre segments, its deep nodes tethered.
//   kernels_bench --benchmark_min_time=1
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "risorius/muscle/fibre_set.h"
#include "risorius/solve/metric_builder.h"
#include "risorius/solve/quasi_newton.h"
#include "risorius/solve/sparse_cholesky.h"
#include "risorius/tissue/skin_sheet.h"
#include "risorius/tissue/tet_solid.h"
#include "risorius/tissue/zero_length_springs.h"

namespace {

using namespace risorius;

constexpr double kStep = 1.0 / 60.0;

struct Patch {
    static constexpr int n = 41, layers = 3;
    Points rest, x;
    Tets tets;
    Triangles skin;
    Eigen::VectorXd mass, activation;
    std::unique_ptr<tissue::TetSolid> solid;
    std::unique_ptr<tissue::SkinSheet> sheet;
    std::unique_ptr<tissue::ZeroLengthSprings> springs;
    std::unique_ptr<muscle::FibreSet> fibres;
    std::unique_ptr<solve::SparseCholesky> metric;

    static int at(int i, int j, int k) { return (j * n + i) * layers + k; }

    Patch() {
        const double spacing = 4e-3, layer = 4e-3;
        rest.resize(n * n * layers, 3);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                for (int k = 0; k < layers; ++k) {
                    const double u = (i - n / 2) * spacing, v = (j - n / 2) * spacing;
                    rest.row(at(i, j, k)) << u, v, k * layer - 4.0 * u * u - 3.0 * v * v;
                }
        static constexpr int kPaths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                             {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        std::vector<Eigen::RowVector4i> list;
        for (int j = 0; j + 1 < n; ++j)
            for (int i = 0; i + 1 < n; ++i)
                for (int k = 0; k + 1 < layers; ++k)
                    for (int path = 0; path < 6; ++path) {
                        int p[3] = {i, j, k};
                        int corner[4] = {at(i, j, k), 0, 0, 0};
                        for (int step = 0; step < 3; ++step) {
                            ++p[kPaths[path][step]];
                            corner[step + 1] = at(p[0], p[1], p[2]);
                        }
                        if (path >= 3) std::swap(corner[1], corner[2]);
                        list.emplace_back(corner[0], corner[1], corner[2], corner[3]);
                    }
        tets.resize(static_cast<Eigen::Index>(list.size()), 4);
        for (std::size_t t = 0; t < list.size(); ++t)
            tets.row(static_cast<Eigen::Index>(t)) = list[t];
        skin.resize(2 * (n - 1) * (n - 1), 3);
        Eigen::Index row = 0;
        for (int j = 0; j + 1 < n; ++j)
            for (int i = 0; i + 1 < n; ++i) {
                const int a = at(i, j, 2), b = at(i + 1, j, 2), c = at(i + 1, j + 1, 2),
                          d = at(i, j + 1, 2);
                skin.row(row++) << a, b, c;
                skin.row(row++) << a, c, d;
            }

        solid = std::make_unique<tissue::TetSolid>(tets, rest,
                                                   Eigen::VectorXd::Constant(tets.rows(), 2e3),
                                                   Eigen::VectorXd::Constant(tets.rows(), 3e4));
        sheet = std::make_unique<tissue::SkinSheet>(skin, rest,
                                                    Eigen::VectorXd::Constant(skin.rows(), 20.0),
                                                    Eigen::VectorXd::Constant(skin.rows(), 2e-5));
        mass = solid->lumped_mass(1000.0, static_cast<int>(rest.rows()));

        // Deep nodes slide over bone; a rim is held firmly
        std::vector<tissue::ZeroLengthSprings::Spring> held;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const bool rim = i == 0 || j == 0 || i == n - 1 || j == n - 1;
                held.push_back({at(i, j, 0), rest.row(at(i, j, 0)).transpose(), Vec3::UnitZ(), 5.0,
                                rim ? 5.0 : 0.3});
            }
        springs = std::make_unique<tissue::ZeroLengthSprings>(held);

        // 180 fibres of 10 segments through the middle layer, in 20 groups
        std::mt19937 random(1);
        std::uniform_int_distribution<int> place(1, n - 14);
        std::vector<muscle::FibrePoint> points;
        std::vector<muscle::Fibre> strands;
        for (int f = 0; f < 180; ++f) {
            const int i0 = place(random), j0 = place(random);
            strands.push_back({.first_point = static_cast<int>(points.size()),
                               .point_count = 11,
                               .column = f % 20,
                               .f0_n = 0.3});
            for (int s = 0; s <= 10; ++s) {
                const int i = f % 2 ? i0 + s : i0, j = f % 2 ? j0 : j0 + s;
                muscle::FibrePoint point;
                point.count = 4;
                const int nodes[4] = {at(i, j, 0), at(i, j, 1), at(i + 1, j, 1),
                                      at(i + 1, j + 1, 1)};
                const double weights[4] = {0.3, 0.4, 0.2, 0.1};
                for (int c = 0; c < 4; ++c) {
                    point.nodes[c] = nodes[c];
                    point.weights[c] = weights[c];
                }
                points.push_back(point);
            }
        }
        fibres = std::make_unique<muscle::FibreSet>(points, strands, rest);
        activation = Eigen::VectorXd::Constant(20, 0.0);
        for (int c = 0; c < 20; c += 3) activation[c] = 0.6;

        metric = std::make_unique<solve::SparseCholesky>(matrix());
        x = rest;
        std::uniform_real_distribution<double> shake(-3e-4, 3e-4);
        for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] += shake(random);
    }

    Eigen::SparseMatrix<double> matrix() const {
        solve::MetricBuilder builder(static_cast<int>(rest.rows()));
        solid->add_metric(builder);
        solid->add_laplacian(builder, 0.02 / kStep);
        sheet->add_metric(builder);
        springs->add_metric(builder);
        fibres->add_metric(builder);
        for (Eigen::Index i = 0; i < mass.size(); ++i)
            builder.add_diagonal(static_cast<int>(i), mass[i] / (kStep * kStep));
        return builder.build({});
    }
    double energy(const Points& at_x, Points& gradient) const {
        gradient.setZero();
        return solid->add_energy(at_x, gradient) + sheet->add_energy(at_x, gradient) +
               springs->add_energy(at_x, gradient) + fibres->add_energy(at_x, activation, gradient);
    }
};

const Patch& patch() {
    static const Patch the_patch;
    return the_patch;
}

template <class Term>
void time_term(benchmark::State& state, const Term& term) {
    Points gradient = Points::Zero(patch().x.rows(), 3);
    for (auto _ : state) benchmark::DoNotOptimize(term(patch().x, gradient));
}

void BM_Tets(benchmark::State& state) {
    time_term(state, [](const Points& x, Points& g) { return patch().solid->add_energy(x, g); });
    state.counters["tets"] = static_cast<double>(patch().tets.rows());
}
void BM_Skin(benchmark::State& state) {
    time_term(state, [](const Points& x, Points& g) { return patch().sheet->add_energy(x, g); });
    state.counters["hinges"] = patch().sheet->hinge_count();
}
void BM_ZeroLengthSprings(benchmark::State& state) {
    time_term(state, [](const Points& x, Points& g) { return patch().springs->add_energy(x, g); });
}
void BM_Fibres(benchmark::State& state) {
    time_term(state, [](const Points& x, Points& g) {
        return patch().fibres->add_energy(x, patch().activation, g);
    });
}
void BM_FibresAllActive(benchmark::State& state) {
    const Eigen::VectorXd all = Eigen::VectorXd::Constant(20, 0.6);
    time_term(state,
              [&](const Points& x, Points& g) { return patch().fibres->add_energy(x, all, g); });
}
void BM_AllTerms(benchmark::State& state) {
    time_term(state, [](const Points& x, Points& g) { return patch().energy(x, g); });
}
void BM_Factor(benchmark::State& state) {
    const Eigen::SparseMatrix<double> a = patch().matrix();
    for (auto _ : state) benchmark::DoNotOptimize(solve::SparseCholesky(a).size());
}
void BM_Solve(benchmark::State& state) {
    const Points b = patch().x;
    Points x;
    for (auto _ : state) {
        patch().metric->solve(b, x);
        benchmark::DoNotOptimize(x.data());
    }
    state.counters["nonzeros"] = static_cast<double>(patch().metric->nonzeros());
}
/// A frame of `range(0)` iterations from rest, muscles on.
void BM_Frame(benchmark::State& state) {
    const Patch& p = patch();
    const auto potential = [&](const Points& x, Points& gradient) {
        double e = p.energy(x, gradient);
        const double inverse = 1.0 / (kStep * kStep);
        for (Eigen::Index i = 0; i < x.rows(); ++i) {
            const double k = p.mass[i] * inverse;
            for (int c = 0; c < 3; ++c) {
                const double d = x(i, c) - p.rest(i, c);
                e += 0.5 * k * d * d;
                gradient(i, c) += k * d;
            }
        }
        return e;
    };
    solve::QuasiNewton solver;
    solve::StepReport report;
    Points x;
    for (auto _ : state) {
        x = p.rest;
        report = solver.minimise(potential, *p.metric, x,
                                 {.iterations = static_cast<int>(state.range(0))});
        benchmark::DoNotOptimize(x.data());
    }
    state.counters["evaluations"] = report.evaluations;
    state.counters["energy_uj"] = report.energy_j * 1e6;
}

BENCHMARK(BM_Tets)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Skin)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ZeroLengthSprings)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Fibres)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_FibresAllActive)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_AllTerms)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Factor)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Solve)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Frame)->Arg(3)->Arg(6)->Arg(12)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
