// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/refine_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace risorius::tissue {

namespace {

using Edge = std::array<int, 2>;  ///< lower node first

Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The corner at which the longest rest edge of triangle t begins.
int longest_side(const TriangleSurface& surface, Eigen::Index t) {
    int longest = 0;
    double max = -1;
    Edge best{};
    for (int k = 0; k < 3; ++k) {
        const int a = surface.triangles(t, k), b = surface.triangles(t, (k + 1) % 3);
        // Measured from the lower node, so that both triangles of an edge get the same bits.
        const Edge edge = edge_of(a, b);
        const double length = (surface.rest.row(edge[1]) - surface.rest.row(edge[0])).squaredNorm();
        if (length > max || (length == max && edge < best)) {
            longest = k;
            max = length;
            best = edge;
        }
    }
    return longest;
}

struct Corner {
    int node;
    Vec2 a;
};
using Corners = std::array<Corner, 3>;

Corners corners_of(const TriangleSurface& surface, Eigen::Index t) {
    Corners corners{};
    for (int k = 0; k < 3; ++k)
        corners[static_cast<std::size_t>(k)] = {
            surface.triangles(t, k),
            {surface.coordinates(t, 2 * k), surface.coordinates(t, 2 * k + 1)}};
    return corners;
}

/// Metric strain and change of curvature of a triangle by a: G11, G22, G12, b11, b22, b12.
using SheetStrain = Eigen::Matrix<double, 6, 1>;

std::vector<SheetStrain> strain_of_triangles(const TriangleSurface& surface,
                                             const TriangleSheetTerm& term, const Points& x) {
    const std::vector<Vec3> curvature = term.curvatures(x);
    std::vector<SheetStrain> strain(curvature.size());
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
        const auto a = coordinates_of(surface, t);
        Mat2 edges;
        edges << a.col(1) - a.col(0), a.col(2) - a.col(0);
        const Mat2 inverse = edges.inverse();
        const auto metric = [&](const Points& at) -> Mat2 {
            Eigen::Matrix<double, 3, 2> sides;
            for (int k = 0; k < 2; ++k)
                sides.col(k) =
                    (at.row(surface.triangles(t, k + 1)) - at.row(surface.triangles(t, 0)))
                        .transpose();
            const Eigen::Matrix<double, 3, 2> tangents = sides * inverse;
            return tangents.transpose() * tangents;
        };
        const Mat2 off = metric(x) - metric(surface.rest);
        strain[static_cast<std::size_t>(t)] << off(0, 0), off(1, 1), off(0, 1),
            curvature[static_cast<std::size_t>(t)];
    }
    return strain;
}

void check(const SurfaceRefineOptions& options) {
    std::ostringstream text;
    if (!(options.tolerance > 0 && options.tolerance < 1))
        text << "tolerance: expected (0, 1), found " << options.tolerance;
    else if (options.max_bisections < 0 || options.max_bisections > 16)
        text << "most_bisections: expected [0, 16], found " << options.max_bisections;
    if (!text.str().empty()) throw std::invalid_argument("SurfaceRefineOptions: " + text.str());
}

Points with_middles(const Points& x, const std::vector<Edge>& middle_of) {
    Points all(x.rows() + static_cast<Eigen::Index>(middle_of.size()), 3);
    all.topRows(x.rows()) = x;
    for (std::size_t k = 0; k < middle_of.size(); ++k)
        all.row(x.rows() + static_cast<Eigen::Index>(k)) =
            0.5 * (all.row(middle_of[k][0]) + all.row(middle_of[k][1]));
    return all;
}

constexpr double kMinSheetStrain = 1e-12;  ///< smaller strains are rounding errors

}  // namespace

Bisected bisected(const TriangleSurface& surface, const std::vector<char>& marked) {
    const Eigen::Index count = surface.triangles.rows();
    std::map<Edge, std::vector<int>> triangles_of;
    std::vector<int> longest(static_cast<std::size_t>(count));
    for (Eigen::Index t = 0; t < count; ++t) {
        longest[static_cast<std::size_t>(t)] = longest_side(surface, t);
        for (int k = 0; k < 3; ++k)
            triangles_of[edge_of(surface.triangles(t, k), surface.triangles(t, (k + 1) % 3))]
                .push_back(static_cast<int>(t));
    }

    // A triangle with a cut edge is cut at its longest edge too.
    std::map<Edge, int> cut;  // for each cut edge: the node at its midpoint, once numbered
    std::vector<int> open;
    for (Eigen::Index t = 0; t < count; ++t)
        if (marked[static_cast<std::size_t>(t)]) open.push_back(static_cast<int>(t));
    while (!open.empty()) {
        const int t = open.back();
        open.pop_back();
        const int k = longest[static_cast<std::size_t>(t)];
        const Edge edge = edge_of(surface.triangles(t, k), surface.triangles(t, (k + 1) % 3));
        if (!cut.emplace(edge, 0).second) continue;
        for (const int other : triangles_of[edge]) open.push_back(other);
    }
    Bisected out;
    for (auto& [edge, node] : cut) {
        node = static_cast<int>(surface.rest.rows()) + static_cast<int>(out.middle_of.size());
        out.middle_of.push_back(edge);
    }

    std::vector<Corners> parts;
    for (Eigen::Index t = 0; t < count; ++t) {
        const Corners whole = corners_of(surface, t);
        const auto middle = [&](const Corner& a, const Corner& b) -> std::pair<bool, Corner> {
            const auto found = cut.find(edge_of(a.node, b.node));
            if (found == cut.end()) return {false, a};
            return {true, {found->second, 0.5 * (a.a + b.a)}};
        };
        const auto k = static_cast<std::size_t>(longest[static_cast<std::size_t>(t)]);
        const Corner &a = whole[k], &b = whole[(k + 1) % 3], &c = whole[(k + 2) % 3];
        const auto [is_cut, m] = middle(a, b);
        const std::size_t before = parts.size();
        if (!is_cut) {
            parts.push_back(whole);
        } else {
            // Halves (a, m, c) and (m, b, c). Each is cut again from m when its own old edge is cut.
            if (const auto [again, n] = middle(c, a); again) {
                parts.push_back({a, m, n});
                parts.push_back({n, m, c});
            } else {
                parts.push_back({a, m, c});
            }
            if (const auto [again, n] = middle(b, c); again) {
                parts.push_back({m, b, n});
                parts.push_back({m, n, c});
            } else {
                parts.push_back({m, b, c});
            }
        }
        out.parent.insert(out.parent.end(), parts.size() - before, static_cast<int>(t));
    }

    out.surface.rest = with_middles(surface.rest, out.middle_of);
    out.surface.triangles.resize(static_cast<Eigen::Index>(parts.size()), 3);
    out.surface.coordinates.resize(static_cast<Eigen::Index>(parts.size()), 6);
    for (std::size_t t = 0; t < parts.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto row = static_cast<Eigen::Index>(t), column = static_cast<Eigen::Index>(k);
            out.surface.triangles(row, column) = parts[t][k].node;
            out.surface.coordinates.block<1, 2>(row, 2 * column) = parts[t][k].a.transpose();
        }
    out.surface.material = surface.material;
    if (surface.material.size() > 1) {
        out.surface.material.clear();
        for (const int parent : out.parent)
            out.surface.material.push_back(surface.material[static_cast<std::size_t>(parent)]);
    }
    return out;
}

Eigen::VectorXd squared_error(const TriangleSurface& surface, const TriangleSheetTerm& term,
                              const Points& x) {
    const std::vector<SheetStrain> strain = strain_of_triangles(surface, term, x);
    std::vector<SheetStrain> mean(static_cast<std::size_t>(surface.rest.rows()),
                                  SheetStrain::Zero());
    std::vector<double> whole(mean.size(), 0.0);
    std::vector<double> area(strain.size());
    for (std::size_t t = 0; t < strain.size(); ++t) {
        const auto row = static_cast<Eigen::Index>(t);
        area[t] = area_of(coordinates_of(surface, row));
        for (int k = 0; k < 3; ++k) {
            const auto node = static_cast<std::size_t>(surface.triangles(row, k));
            mean[node] += area[t] * strain[t];
            whole[node] += area[t];
        }
    }
    for (std::size_t i = 0; i < mean.size(); ++i)
        if (whole[i] > 0) mean[i] /= whole[i];

    Eigen::VectorXd squared(static_cast<Eigen::Index>(strain.size()));
    for (std::size_t t = 0; t < strain.size(); ++t) {
        const auto row = static_cast<Eigen::Index>(t);
        const SurfaceMaterial& material = material_of(surface, row);
        const Mat2 &lambda = material.elastic_n_per_m3, &zeta = material.bending_n_per_m;
        SheetStrain weight;  // of the squares; mixed components count twice
        weight << 0.25 * lambda(0, 0), 0.25 * lambda(1, 1), 0.5 * lambda(0, 1), 0.5 * zeta(0, 0),
            0.5 * zeta(1, 1), zeta(0, 1);
        double sum = 0;  // at the midpoints of the edges: exact for squares of linear functions
        for (int k = 0; k < 3; ++k) {
            const auto p = static_cast<std::size_t>(surface.triangles(row, k));
            const auto q = static_cast<std::size_t>(surface.triangles(row, (k + 1) % 3));
            const SheetStrain off = strain[t] - 0.5 * (mean[p] + mean[q]);
            sum += weight.dot(off.cwiseAbs2()) / 3;
        }
        squared[row] = area[t] * sum;
    }
    return squared;
}

AdaptiveSurface::AdaptiveSurface(TriangleSurface surface, const SurfaceRefineOptions& options)
    : surface_(std::move(surface)), options_(options) {
    check(options);
    bisections_.assign(static_cast<std::size_t>(surface_.triangles.rows()), 0);
    term_ = std::make_shared<TriangleSheetTerm>(surface_);
}

solve::MotionState AdaptiveSurface::start() const {
    solve::MotionState state;
    state.x = surface_.rest;
    state.v = Points::Zero(state.x.rows(), 3);
    return state;
}

bool AdaptiveSurface::bisect(const std::vector<char>& marked, solve::MotionState* state) {
    if (std::find(marked.begin(), marked.end(), 1) == marked.end()) return false;
    Bisected next = bisected(surface_, marked);
    std::vector<int> parts(bisections_.size(), 0);
    for (const int parent : next.parent) ++parts[static_cast<std::size_t>(parent)];
    std::vector<int> bisections;
    for (const int parent : next.parent) {
        const auto p = static_cast<std::size_t>(parent);
        bisections.push_back(bisections_[p] + (parts[p] > 2 ? 2 : parts[p] - 1));
    }
    bisections_ = std::move(bisections);
    if (state != nullptr) {
        state->x = with_middles(state->x, next.middle_of);
        state->v = with_middles(state->v, next.middle_of);
    }
    surface_ = std::move(next.surface);
    term_ = std::make_shared<TriangleSheetTerm>(surface_);
    return true;
}

bool AdaptiveSurface::refine_where(const std::function<bool(int triangle)>& wanted,
                                   solve::MotionState* state) {
    std::vector<char> marked(bisections_.size(), 0);
    for (std::size_t t = 0; t < marked.size(); ++t)
        marked[t] = bisections_[t] < options_.max_bisections && wanted(static_cast<int>(t));
    return bisect(marked, state);
}

bool AdaptiveSurface::refine(solve::MotionState& state) {
    const Eigen::VectorXd squared = squared_error(surface_, *term_, state.x);
    const double energy = term_->energy(state.t_s, state.x);
    // Shrunk to a point, the surface has strains of order one.
    const double one = term_->metric_energy(Points::Zero(state.x.rows(), 3));
    error_ = 0;
    if (!(energy > kMinSheetStrain * kMinSheetStrain * one)) return false;
    error_ = std::sqrt(squared.sum() / energy);
    const double due =
        options_.tolerance * options_.tolerance * energy / static_cast<double>(squared.size());
    return refine_where(
        [&](int triangle) { return squared[static_cast<Eigen::Index>(triangle)] > due; }, &state);
}

RefineRounds solve_and_refine(AdaptiveSurface& surface, const SolveSurface& solve, int rounds,
                              solve::MotionState& state) {
    return refine_rounds(
        rounds, [&](SolveStage stage) { return solve(surface, stage, state); },
        [&] { return surface.refine(state); });
}

}  // namespace risorius::tissue
