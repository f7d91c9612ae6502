#include "tissue/refine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "tissue/detail/cell_point.h"

namespace risorius::tissue {

namespace {

CellPlace parent_of(CellPlace cell) {
    --cell.level;
    for (int& at : cell.at) at /= 2;
    return cell;
}

CellPlace child_of(const CellPlace& cell, int corner) {
    return {cell.level + 1,
            {2 * cell.at[0] + (corner >> 2 & 1), 2 * cell.at[1] + (corner >> 1 & 1),
             2 * cell.at[2] + (corner & 1)}};
}

CellPlace neighbour_of(CellPlace cell, int code) {
    cell.at[0] += code / 9 - 1;
    cell.at[1] += code / 3 % 3 - 1;
    cell.at[2] += code % 3 - 1;
    return cell;
}

}  // namespace

Eigen::VectorXd error_indicator(const CellSolid& solid, const Points& x) {
    const CellMesh& mesh = solid.mesh();
    const CellBody& body = solid.body();
    const auto cells = mesh.cells().size();
    const Points vertices = solid.vertices(x);

    // Weighed strain: a dG b with a, b such that its square sum is the energy density, so that different cells compare
    std::vector<std::array<Mat3, 8>> strain(cells);
    std::vector<Mat3> mean(static_cast<std::size_t>(mesh.vertex_count()), Mat3::Zero());
    std::vector<double> share(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
    for (std::size_t c = 0; c < cells; ++c) {
        Mat3 at[8];
        solid.metric_strain(vertices, static_cast<int>(c), at);
        Mat3 middle = Mat3::Zero();
        for (std::size_t g = 0; g < 8; ++g) {
            strain[c][g] = at[g];
            middle += 0.125 * at[g];
        }
        const double weight = mesh.cells()[c].size.prod();
        for (const int vertex : mesh.cells()[c].vertex) {
            mean[static_cast<std::size_t>(vertex)] += weight * middle;
            share[static_cast<std::size_t>(vertex)] += weight;
        }
    }
    // A hanging vertex also sees what its nodes see: the big cell beside it has no corner there
    for (std::size_t v = 0; v < mean.size(); ++v) mean[v] /= share[v];
    for (std::size_t h = 0; h < mesh.hanging().size(); ++h) {
        const CellMesh::Hanging& hanging = mesh.hanging()[h];
        Mat3 sum = Mat3::Zero();
        for (int k = 0; k < hanging.count; ++k)
            sum += mean[static_cast<std::size_t>(hanging.node[static_cast<std::size_t>(k)])];
        mean[static_cast<std::size_t>(mesh.node_count()) + h] = sum / hanging.count;
    }

    constexpr double kNear = 0.5 + 0.28867513459481288225;  // (1 + 1/sqrt 3) / 2
    Eigen::VectorXd indicator(static_cast<Eigen::Index>(cells));
    for (std::size_t c = 0; c < cells; ++c) {
        const CellMesh::Cell& cell = mesh.cells()[c];
        const Mat3 inverse = body.moduli.empty() ? Mat3::Zero().eval()
                                                 : solid.inverse_rest_metric(static_cast<int>(c));
        double sum = 0;
        for (int g = 0; g < 8; ++g) {
            const Vec3 s((g & 4) ? kNear : 1 - kNear, (g & 2) ? kNear : 1 - kNear,
                         (g & 1) ? kNear : 1 - kNear);
            const auto weight = trilinear_weights(s);
            Mat3 smooth = Mat3::Zero();
            for (std::size_t k = 0; k < 8; ++k)
                smooth += weight[k] * mean[static_cast<std::size_t>(cell.vertex[k])];
            const Mat3 off = strain[c][static_cast<std::size_t>(g)] - smooth;
            sum +=
                body.moduli.empty()
                    ? body.parameters[c].elastic_n_per_m3.cwiseProduct(off.cwiseProduct(off)).sum()
                    : body.moduli[c].mu_pa * (inverse * off * inverse * off).trace();
        }
        const double volume = body.moduli.empty()
                                  ? cell.size.prod()
                                  : 1 / std::sqrt(inverse.determinant()) * cell.size.prod();
        indicator[static_cast<Eigen::Index>(c)] = 0.25 * 0.125 * volume * sum;
    }
    return indicator;
}

bool CellTree::inside(const CellPlace& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
        const int at = cell.at[static_cast<std::size_t>(axis)];
        if (at < 0 || at >= (root_.along(axis) - 1) << cell.level) return false;
    }
    return true;
}

bool CellTree::exists(const CellPlace& cell) const {
    return inside(cell) && (cell.level == 0 || is_split(parent_of(cell)));
}

void CellTree::split(const CellPlace& cell) {
    if (is_split(cell)) return;
    if (cell.level > 0) split(parent_of(cell));
    // Parts may not meet cells bigger than this one
    for (int code = 0; code < 27; ++code) {
        const CellPlace neighbour = neighbour_of(cell, code);
        if (inside(neighbour) && cell.level > 0) split(parent_of(neighbour));
    }
    split_.insert(cell);
}

bool CellTree::merge(const CellPlace& cell) {
    if (!is_split(cell)) return false;
    for (int code = 0; code < 27; ++code) {
        const CellPlace neighbour = neighbour_of(cell, code);
        for (int corner = 0; corner < 8; ++corner)
            if (is_split(child_of(neighbour, corner))) return false;
    }
    split_.erase(cell);
    return true;
}

CellMesh CellTree::mesh() const {
    std::vector<CellPlace> leaves, open;
    for (int i = 0; i + 1 < root_.m; ++i)
        for (int j = 0; j + 1 < root_.n; ++j)
            for (int k = 0; k + 1 < root_.o; ++k) open.push_back({0, {i, j, k}});
    while (!open.empty()) {
        const CellPlace cell = open.back();
        open.pop_back();
        if (!is_split(cell)) {
            leaves.push_back(cell);
            continue;
        }
        for (int corner = 0; corner < 8; ++corner) open.push_back(child_of(cell, corner));
    }
    return {root_, std::move(leaves)};
}

AdaptiveSolid::AdaptiveSolid(const GridShape& root, BodyOnMesh body, const RefineOptions& options)
    : body_(std::move(body)), options_(options), tree_(root) {
    if (!(options.tolerance > 0 && options.tolerance < 1) ||
        !(options.merge_below >= 0 && options.merge_below < 1) || options.deepest_level < 0 ||
        options.deepest_level > 8)
        throw std::invalid_argument("AdaptiveSolid: an option is outside its range");
    rebuild(nullptr);
}

AdaptiveSolid::AdaptiveSolid(const GridSolid& solid, const RefineOptions& options)
    : AdaptiveSolid(
          solid.grid,
          [solid](CellMesh mesh) { return cell_body(solid, std::move(mesh), MassShares::kCells); },
          options) {}

void AdaptiveSolid::rebuild(solve::MotionState* state) {
    auto next = std::make_shared<CellSolid>(body_(tree_.mesh()));
    if (state != nullptr && solid_ != nullptr) {
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

void AdaptiveSolid::refine_where(const std::function<bool(const CellMesh::Cell& cell)>& wanted,
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
}

bool AdaptiveSolid::refine(solve::MotionState& state) {
    const Eigen::VectorXd indicator = error_indicator(*solid_, state.x);
    const auto& cells = solid_->mesh().cells();
    const double energy = solid_->energy(state.t_s, state.x);
    error_ = energy > 0 ? std::sqrt(indicator.sum() / energy) : 0;
    const double due =
        options_.tolerance * options_.tolerance * energy / static_cast<double>(cells.size());
    bool changed = false;
    std::map<CellPlace, std::pair<int, double>> families;  // leaves of a parent, their sum
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const CellPlace& place = cells[c].place;
        const double eta = indicator[static_cast<Eigen::Index>(c)];
        if (place.level > 0) {
            auto& [count, sum] = families[parent_of(place)];
            ++count;
            sum += eta;
        }
    }
    for (std::size_t c = 0; c < cells.size(); ++c)
        if (indicator[static_cast<Eigen::Index>(c)] > due &&
            cells[c].place.level < options_.deepest_level) {
            tree_.split(cells[c].place);
            changed = true;
        }
    for (const auto& [parent, family] : families)
        if (family.first == 8 && family.second < options_.merge_below * due &&
            !kept_.contains(parent)) {
            bool leaves = true;
            for (int corner = 0; corner < 8; ++corner)
                leaves = leaves && !tree_.is_split(child_of(parent, corner));
            if (leaves && tree_.merge(parent)) changed = true;
        }
    if (changed) rebuild(&state);
    return changed;
}

int settle_and_refine(AdaptiveSolid& solid, const SystemOfSolid& system, const Settle& settle,
                      int rounds, solve::MotionState& state) {
    for (int round = 1; round <= rounds; ++round) {
        const auto now = system(solid.solid());
        if (!settle(*now, state)) return round - 1;
        // The last round's answer is not refined any more: it would no longer be an equilibrium
        if (round == rounds || !solid.refine(state)) return round;
    }
    return 0;
}

}  // namespace risorius::tissue
