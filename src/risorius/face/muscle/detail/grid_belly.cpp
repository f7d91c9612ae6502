// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/grid_belly.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "risorius/core/error.h"
#include "risorius/solve/energy_term.h"

namespace risorius::face {

namespace {

constexpr double kRadian = 3.14159265358979323846 / 180.0;
constexpr double kShortTendon = 0.15;  // of the optimal fibre length; shorter tendons are rigid

// Returns the coordinates of p in a cell, 0..1 on each axis if inside: Newton iterations on the trilinear map from the middle.
Vec3 place_in_cell(const Vec3& p, const Eigen::Matrix<double, 3, 8>& corner) {
    Vec3 s = Vec3::Constant(0.5);
    for (int iteration = 0; iteration < 8; ++iteration) {
        const std::array<double, 8> w = tissue::trilinear_weights(s);
        Vec3 at = Vec3::Zero();
        Mat3 slope = Mat3::Zero();
        for (int c = 0; c < 8; ++c) {
            at += w[static_cast<std::size_t>(c)] * corner.col(c);
            const double f[3] = {c & 4 ? s[0] : 1 - s[0], c & 2 ? s[1] : 1 - s[1],
                                 c & 1 ? s[2] : 1 - s[2]};
            slope.col(0) += (c & 4 ? 1 : -1) * f[1] * f[2] * corner.col(c);
            slope.col(1) += (c & 2 ? 1 : -1) * f[0] * f[2] * corner.col(c);
            slope.col(2) += (c & 1 ? 1 : -1) * f[0] * f[1] * corner.col(c);
        }
        s += (slope.fullPivLu().solve(p - at)).cwiseMax(-0.5).cwiseMin(0.5);
        s = s.cwiseMax(-2.0).cwiseMin(3.0);
    }
    return s;
}

/// Corners of a cell (4 b1 + 2 b2 + b3) in the order of VTK: round its lower face, then round the upper one.
constexpr std::array<int, 8> kRound{0, 4, 6, 2, 1, 5, 7, 3};

}  // namespace

GridBelly::GridBelly(const SolidPart& place, const SolidPlacement& nodes,
                     const rig::RigDescription& rig)
    : SolidBelly(place, nodes) {
    const tissue::GridShape& grid = place_.grid;
    const rig::SolidMuscle& solid = *place_.solid;
    const muscle::ZajacShape curves = this->curves(rig);
    const auto rest_at = [&](const Vec3& a) -> Vec3 {
        return rest_
            .row(grid.index(static_cast<int>(std::lround(a[0] * (grid.m - 1))),
                            static_cast<int>(std::lround(a[1] * (grid.n - 1))),
                            static_cast<int>(std::lround(a[2] * (grid.o - 1)))))
            .transpose();
    };
    try {
        cells_ = std::make_unique<tissue::CellSolid>(tissue::cell_body(
            tissue::uniform_cells(grid), rest_at,
            {solid.shear_pa, solid.volume_pa, rig.tissue.damping_s * solid.shear_pa},
            kMuscleDensity_kg_m3));
        if (solid.is_stiffer_along())
            along_.emplace(tissue::strain_points(cells_->mesh(), rest_), along_moduli());
    } catch (const std::invalid_argument&) {
        throw Error("anatomy/solids/" + place_.muscle->id,
                    "a muscle whose cells have volume on this head", "a folded cell");
    }

    std::vector<std::vector<int>> chains;
    for (int k = 0; k < grid.n * grid.o; ++k) {
        std::vector<int> chain;
        for (int m = 0; m < grid.m; ++m) chain.push_back(m * grid.n * grid.o + k);
        chains.push_back(std::move(chain));
    }
    const rig::Muscle& muscle = *place_.muscle;
    const double fibre_m = muscle.rest_stretch * muscle.optimal_length_m;
    const double count = static_cast<double>(chains.size());
    chains_ = std::make_unique<muscle::ChainSet>(
        std::move(chains), rest_,
        muscle::ChainProperties{
            .f0_n = place_.f0_n / count,
            .rest_stretch = muscle.rest_stretch,
            .pennation_rad = muscle.pennation_deg * kRadian,
            .tendon_fraction = muscle.tendon_slack_m / (muscle.tendon_slack_m + fibre_m),
            .rigid_tendon = muscle.tendon_slack_m < kShortTendon * muscle.optimal_length_m},
        muscle::zajac_curves(curves));
    built_f0_n_ = chains_->properties().f0_n;
    own_ = std::make_unique<solve::HessianBuilder>(grid.size(), std::vector<char>{});
    start_ = rest_;
}

void GridBelly::begin_step(double h, const Points& start) {
    step_s_ = h;
    start_ = start;
}

void GridBelly::add_energy(const Points& x, double activation, double& energy,
                           Points& gradient) const {
    energy += cells_->add_potential({0.0, step_s_, start_}, x, gradient);
    if (along_) energy += along_->add_potential({0.0, step_s_, start_}, x, gradient);
    energy += chains_->add_energy(x, activation, gradient);
}

void GridBelly::add_cells(const Points& x, solve::Curvature curvature, const std::vector<int>& row,
                          solve::HessianBuilder& hessian) const {
    own_->clear();
    cells_->add_hessian({0.0, step_s_, start_}, x, curvature, *own_);
    if (along_) along_->add_hessian({0.0, step_s_, start_}, x, curvature, *own_);
    add_blocks(own_->build_blocks(), row, hessian);
}

void GridBelly::add_hessian(const Points& x, double activation, solve::Curvature curvature,
                            const std::vector<int>& row, solve::HessianBuilder& hessian) const {
    add_cells(x, curvature, row, hessian);
    chains_->add_hessian(x, activation, curvature, row, hessian);
}

void GridBelly::add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                              solve::HessianBuilder& hessian) const {
    add_cells(x, solve::Curvature::kPositive, row, hessian);
    chains_->add_stiffness(x, activation, row, hessian);
}

void GridBelly::find(const Vec3& p, double& least_excess, BellyPoint& best) const {
    constexpr double kInside_m = 0.2e-3;
    for (const tissue::CellMesh::Cell& cell : cells_->mesh().cells()) {
        Eigen::Matrix<double, 3, 8> corner;
        for (int c = 0; c < 8; ++c)
            corner.col(c) = rest_.row(cell.vertex[static_cast<std::size_t>(c)]).transpose();
        if ((corner.rowwise().mean() - p).norm() > 0.03) continue;
        const Vec3 s = place_in_cell(p, corner);
        const Vec3 excess = (s - Vec3::Constant(0.5)).cwiseAbs() - Vec3::Constant(0.5);
        const double out = std::max(0.0, excess.maxCoeff());
        if (out >= least_excess) continue;
        const std::array<double, 8> w = tissue::trilinear_weights(s);
        Vec3 found = Vec3::Zero();
        for (int c = 0; c < 8; ++c) found += w[static_cast<std::size_t>(c)] * corner.col(c);
        if ((found - p).norm() > kInside_m) continue;
        least_excess = out;
        best = {.count = 8, .node = cell.vertex, .weight = w};
    }
}

std::vector<std::vector<int>> GridBelly::sections() const {
    const tissue::GridShape& grid = place_.grid;
    std::vector<std::vector<int>> out(static_cast<std::size_t>(grid.m));
    for (int m = 0; m < grid.m; ++m)
        for (int n = 0; n < grid.n; ++n)
            for (int o = 0; o < grid.o; ++o)
                out[static_cast<std::size_t>(m)].push_back(grid.index(m, n, o));
    return out;
}

SolidFigures GridBelly::figures(const Points& x, double activation) const {
    const tissue::GridShape& grid = place_.grid;
    SolidFigures figures{.muscle = place_.muscle->id, .side = place_.side};
    const Eigen::VectorXd now = cells_->cell_volumes(x), then = cells_->cell_volumes(rest_);
    figures.volume_ratio = now.sum() / then.sum();
    figures.min_cell_ratio = now.cwiseQuotient(then).minCoeff();
    figures.mean_stretch = chains_->mean_stretch(x, activation);
    // The section through the middle of the belly, between two slabs when there is no middle slab
    const auto thickness = [&](const Points& p) {
        double sum = 0;
        for (int m : {(grid.m - 1) / 2, grid.m / 2})
            for (int n : {(grid.n - 1) / 2, grid.n / 2})
                sum += (p.row(grid.index(m, n, grid.o - 1)) - p.row(grid.index(m, n, 0))).norm();
        return sum;
    };
    figures.thickness_ratio = thickness(x) / thickness(rest_);
    return figures;
}

void GridBelly::add_cell_states(const Points& x, double activation,
                                std::vector<SolidCellState>& states) const {
    const tissue::GridShape& grid = place_.grid;
    const Eigen::VectorXd now = cells_->cell_volumes(x), then = cells_->cell_volumes(rest_);
    const std::vector<muscle::ChainSet::State> chains = chains_->states(x, activation);
    const auto& list = cells_->mesh().cells();
    for (std::size_t c = 0; c < list.size(); ++c) {
        const int cell = static_cast<int>(c);
        SolidCellState state;
        state.column = place_.column;
        state.volume_ratio = now[cell] / then[cell];
        const tissue::CellModuli& moduli = cells_->body().moduli[c];
        const Mat3 f = cells_->deformation_gradient(x, cell);
        const Mat3 strain = f.transpose() * f - Mat3::Identity();
        state.stress_pa = moduli.mu_pa / f.determinant() * f * strain * f.transpose() +
                          moduli.bulk_pa * (state.volume_ratio - 1) * Mat3::Identity();
        Vec3 along = Vec3::Zero(), along_at_rest = Vec3::Zero();
        double stretch = 0, tension_n = 0;
        for (std::size_t k = 0; k < 8; ++k) {
            const int vertex = list[c].vertex[static_cast<std::size_t>(kRound[k])];
            state.node[k] = place_.node[static_cast<std::size_t>(vertex)];
            along += (kRound[k] & 4 ? 1 : -1) * x.row(vertex).transpose();
            along_at_rest += (kRound[k] & 4 ? 1 : -1) * rest_.row(vertex).transpose();
            // Each of the four chains at the edges has a node at either end of the cell
            const auto& chain = chains[static_cast<std::size_t>(vertex % (grid.n * grid.o))];
            stretch += chain.stretch / 8;
            tension_n += chain.force_n / 8;
        }
        if (along_)
            state.stress_pa += tissue::AlongFibres::cauchy_stress_pa(along_->moduli(), f,
                                                                     along_at_rest.normalized());
        state.direction = along.normalized();
        state.stretch = stretch;
        state.tension_n = tension_n;
        states.push_back(state);
    }
}

}  // namespace risorius::face
