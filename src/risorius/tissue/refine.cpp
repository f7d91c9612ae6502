// SPDX-License-Identifier: MIT
#include "risorius/tissue/refine.h"

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "risorius/tissue/strain_error.h"

namespace risorius::tissue {

namespace {

template <class Number>
void require(bool holds, const char* name, const char* range, Number found) {
    if (holds) return;
    std::ostringstream text;
    text << "RefineOptions: " << name << ": expected " << range << ", found " << found;
    throw std::invalid_argument(text.str());
}

void check(const RefineOptions& options) {
    require(options.tolerance > 0 && options.tolerance < 1, "tolerance", "(0, 1)",
            options.tolerance);
    require(options.merge_below >= 0 && options.merge_below < 1, "merge_below", "[0, 1)",
            options.merge_below);
    require(options.deepest_level >= 0 && options.deepest_level <= 8, "deepest_level", "[0, 8]",
            options.deepest_level);
}

/// Strains below this fraction of one are rounding errors, and refining would only follow those.
constexpr double kMinStrain = 1e-12;

}  // namespace

AdaptiveSolid::AdaptiveSolid(const GridShape& root, BodyOnMesh body, const RefineOptions& options)
    : body_(std::move(body)), options_(options), tree_(root) {
    check(options);
    rebuild(nullptr);
}

AdaptiveSolid::AdaptiveSolid(const GridSolid& solid, const RefineOptions& options)
    : AdaptiveSolid(
          solid.grid,
          [solid](CellMesh mesh) {
              return cell_body(solid, std::move(mesh), MassFractions::kCells);
          },
          options) {}

solve::MotionState AdaptiveSolid::start() const {
    solve::MotionState state;
    state.x = solid_->body().rest;
    state.v = Points::Zero(state.x.rows(), 3);
    return state;
}

void AdaptiveSolid::rebuild(solve::MotionState* state) {
    auto next = std::make_shared<CellSolid>(body_(tree_.mesh()));
    if (state != nullptr) {
        const Points x = solid_->vertices(state->x), v = solid_->vertices(state->v);
        const CellMesh& mesh = next->mesh();
        state->x.resize(mesh.node_count(), 3);
        state->v.resize(mesh.node_count(), 3);
        for (int i = 0; i < mesh.node_count(); ++i) {
            const Vec3 a = mesh.material_coordinates().row(i).transpose();
            state->x.row(i) = solid_->mesh().interpolate(x, a).transpose();
            state->v.row(i) = solid_->mesh().interpolate(v, a).transpose();
        }
    }
    solid_ = std::move(next);
}

bool AdaptiveSolid::refine_where(const std::function<bool(const CellMesh::Cell& cell)>& wanted,
                                 solve::MotionState* state) {
    bool changed = false;
    for (int level = 0; level < options_.deepest_level; ++level) {
        const CellMesh mesh = tree_.mesh();
        for (const CellMesh::Cell& cell : mesh.cells())
            if (cell.place.level == level && wanted(cell)) {
                tree_.split(cell.place);
                kept_.insert(cell.place);
                changed = true;
            }
    }
    if (changed) rebuild(state);
    return changed;
}

bool AdaptiveSolid::refine(solve::MotionState& state) {
    const Eigen::VectorXd squared = squared_error(*solid_, state.x);
    const auto& cells = solid_->mesh().cells();
    const double energy = solid_->energy(state.t_s, state.x);
    // Collapsed to a point, the body has strains of order one.
    const double one = solid_->energy(state.t_s, Points::Zero(state.x.rows(), 3));
    error_ = 0;
    if (!(energy > kMinStrain * kMinStrain * one)) return false;
    error_ = std::sqrt(squared.sum() / energy);

    const double due =
        options_.tolerance * options_.tolerance * energy / static_cast<double>(cells.size());
    bool changed = false;
    struct Family {
        int leaves = 0;
        double squared = 0;
    };
    std::map<CellPlace, Family> families;  // by parent
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const CellPlace& place = cells[c].place;
        const double own = squared[static_cast<Eigen::Index>(c)];
        if (place.level > 0) {
            Family& family = families[parent_of(place)];
            ++family.leaves;
            family.squared += own;
        }
        if (own > due && place.level < options_.deepest_level) {
            tree_.split(place);
            changed = true;
        }
    }
    for (const auto& [parent, family] : families)
        if (family.leaves == 8 && family.squared < options_.merge_below * due &&
            !kept_.contains(parent) && tree_.merge(parent))
            changed = true;
    if (changed) rebuild(&state);
    return changed;
}

RefineRounds refine_rounds(int rounds, const std::function<bool(SolveStage stage)>& solve,
                           const std::function<bool()>& refine) {
    RefineRounds done;
    // The result of the last round is not refined any more: it would no longer be an equilibrium.
    while (done.meshes + 1 < rounds) {
        if (!solve(SolveStage::kIntermediate)) return done;
        ++done.meshes;
        if (!refine()) {
            done.satisfied = true;
            break;
        }
    }
    done.converged = solve(SolveStage::kFinal);
    if (done.converged && !done.satisfied) ++done.meshes;
    return done;
}

RefineRounds solve_and_refine(AdaptiveSolid& solid, const SolveSolid& solve, int rounds,
                              solve::MotionState& state) {
    return refine_rounds(
        rounds, [&](SolveStage stage) { return solve(solid.solid(), stage, state); },
        [&] { return solid.refine(state); });
}

}  // namespace risorius::tissue
