// SPDX-License-Identifier: MIT
#include "risorius/geom/filled_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "risorius/geom/closest_point.h"

namespace risorius::geom {

namespace {

constexpr double kLeastVolume = 0.1;          // of a tetrahedron, over that in a cube
constexpr std::size_t kTetsAroundANode = 24;  // of one that is within
constexpr int kSweeps = 20, kRounds = 6;
constexpr double kNear = 0.02;        // an outer node so near, over the spacing, is on the surface
constexpr double kFlat = 1.2;         // over the least volume: a tetrahedron that blocks its nodes
constexpr double kLeastShare = 0.01;  // of its way that a node goes

/// Whether every edge has two triangles that go along it in opposite directions.
bool is_closed(const Triangles& triangles) {
    std::map<std::array<int, 2>, int> uses;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) ++uses[{triangles(t, k), triangles(t, (k + 1) % 3)}];
    for (const auto& [edge, count] : uses) {
        const auto back = uses.find({edge[1], edge[0]});
        if (count != 1 || back == uses.end()) return false;
    }
    return !uses.empty();
}

double volume_inside(const Points& positions, const Triangles& triangles) {
    double sum = 0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        sum += positions.row(triangles(t, 0))
                   .dot(positions.row(triangles(t, 1)).cross(positions.row(triangles(t, 2)))) /
               6;
    return sum;
}

/// How often the surface winds round a point: 1 inside, 0 outside (van Oosterom & Strackee 1983, solid angles of triangles).
double winding(const Points& positions, const Triangles& triangles, const Vec3& at) {
    double sum = 0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const Vec3 a = positions.row(triangles(t, 0)).transpose() - at,
                   b = positions.row(triangles(t, 1)).transpose() - at,
                   c = positions.row(triangles(t, 2)).transpose() - at;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

/// The cubes inside of a surface.
class Lattice {
  public:
    Lattice(const Points& positions, double spacing) : spacing_(spacing) {
        const Vec3 low = positions.colwise().minCoeff().transpose(),
                   high = positions.colwise().maxCoeff().transpose();
        for (int k = 0; k < 3; ++k)
            size_[k] = static_cast<long>(
                std::min(std::ceil((high[k] - low[k]) / spacing), 2 * kMostFillingCubes));
        const Vec3 whole(static_cast<double>(size_[0]), static_cast<double>(size_[1]),
                         static_cast<double>(size_[2]));
        low_ = 0.5 * (low + high) - 0.5 * spacing * whole;  // as far over at both ends
    }
    double cubes() const {
        return static_cast<double>(size_[0]) * static_cast<double>(size_[1]) *
               static_cast<double>(size_[2]);
    }
    Vec3 point(const std::array<long, 3>& at, double shift = 0) const {
        Vec3 out = low_;
        for (std::size_t k = 0; k < 3; ++k)
            out[static_cast<int>(k)] += spacing_ * (static_cast<double>(at[k]) + shift);
        return out;
    }
    template <class Use>
    void each(const Use& use) const {
        std::array<long, 3> at{};
        for (at[0] = 0; at[0] < size_[0]; ++at[0])
            for (at[1] = 0; at[1] < size_[1]; ++at[1])
                for (at[2] = 0; at[2] < size_[2]; ++at[2]) use(at);
    }

  private:
    double spacing_;
    long size_[3]{};
    Vec3 low_;
};

/// Tetrahedra of the lattice, before nodes are moved.
struct LatticeTets {
    std::map<std::array<long, 3>, int> index;
    std::vector<Vec3> nodes;
    std::vector<std::array<int, 4>> tets;

    int node(const std::array<long, 3>& at, const Lattice& lattice) {
        const auto [found, is_new] = index.emplace(at, static_cast<int>(nodes.size()));
        if (is_new) nodes.push_back(lattice.point(at));
        return found->second;
    }
    /// Of the six tetrahedra about the diagonal of a cube those that `keep` wants, by their middle. The diagonal is the same in all cubes, so
    /// that neighbours share their faces.
    template <class Keep>
    void add(const std::array<long, 3>& cube, const Lattice& lattice, const Keep& keep) {
        static constexpr std::size_t kWays[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                                    {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        for (std::size_t way = 0; way < 6; ++way) {
            std::array<std::array<long, 3>, 4> corners{cube, cube, cube, cube};
            Vec3 middle = lattice.point(cube) / 4;
            for (std::size_t step = 0; step < 3; ++step) {
                corners[step + 1] = corners[step];
                ++corners[step + 1][kWays[way][step]];
                middle += lattice.point(corners[step + 1]) / 4;
            }
            if (!keep(middle)) continue;
            if (way >= 3) std::swap(corners[2], corners[3]);
            std::array<int, 4> tet{};
            for (std::size_t k = 0; k < 4; ++k) tet[k] = node(corners[k], lattice);
            tets.push_back(tet);
        }
    }
};

double six_volumes(const std::vector<Vec3>& at, const std::array<int, 4>& tet) {
    const auto point = [&](std::size_t k) { return at[static_cast<std::size_t>(tet[k])]; };
    return (point(1) - point(0)).dot((point(2) - point(0)).cross(point(3) - point(0)));
}

using Face = std::array<int, 3>;

/// The faces of a tetrahedron, by ascending nodes.
std::array<Face, 4> faces_of(const std::array<int, 4>& tet) {
    std::array<Face, 4> out{};
    for (std::size_t skip = 0; skip < 4; ++skip) {
        for (std::size_t k = 0, at = 0; k < 4; ++k)
            if (k != skip) out[skip][at++] = tet[k];
        std::sort(out[skip].begin(), out[skip].end());
    }
    return out;
}

/// Takes away outer tetrahedra that are as flat as they may be and keep a node from the surface. Returns whether there were any.
bool drop_blocking(const SurfaceTree& tree, double spacing, LatticeTets& solid) {
    std::map<Face, int> uses;
    for (const std::array<int, 4>& tet : solid.tets)
        for (const Face& face : faces_of(tet)) ++uses[face];
    std::vector<char> off(solid.nodes.size(), 0);
    for (const auto& [face, count] : uses) {
        if (count != 1) continue;
        for (const int node : face)
            off[static_cast<std::size_t>(node)] =
                !tree.closest(solid.nodes[static_cast<std::size_t>(node)], kNear * spacing);
    }
    const double flat = kFlat * kLeastVolume * spacing * spacing * spacing;
    return std::erase_if(solid.tets, [&](const std::array<int, 4>& tet) {
               if (six_volumes(solid.nodes, tet) > flat) return false;
               if (std::none_of(tet.begin(), tet.end(),
                                [&](int node) { return off[static_cast<std::size_t>(node)]; }))
                   return false;
               const auto faces = faces_of(tet);
               return std::any_of(faces.begin(), faces.end(),
                                  [&](const Face& face) { return uses[face] == 1; });
           }) > 0;
}

/// Leaves out nodes that no tetrahedron has.
void drop_nodes(LatticeTets& solid) {
    std::vector<int> place(solid.nodes.size(), -1);
    std::vector<Vec3> nodes;
    for (std::array<int, 4>& tet : solid.tets)
        for (int& node : tet) {
            int& at = place[static_cast<std::size_t>(node)];
            if (at < 0) {
                at = static_cast<int>(nodes.size());
                nodes.push_back(solid.nodes[static_cast<std::size_t>(node)]);
            }
            node = at;
        }
    solid.nodes = std::move(nodes);
}

/// Moves nodes one after the other, as far as no tetrahedron becomes too flat.
class Mover {
  public:
    Mover(const SurfaceTree& tree, double spacing, LatticeTets& solid)
        : tree_(tree), spacing_(spacing), solid_(solid), around_(solid.nodes.size()) {
        for (std::size_t t = 0; t < solid.tets.size(); ++t)
            for (const int node : solid.tets[t])
                around_[static_cast<std::size_t>(node)].push_back(static_cast<int>(t));
    }

    /// Outer nodes onto the surface; nodes within to the middle of their neighbours, which makes way for the others.
    void run() {
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            double most = 0;
            for (std::size_t n = 0; n < around_.size(); ++n)
                if (around_[n].size() != kTetsAroundANode)
                    most = std::max(most, go(n, tree_.closest(solid_.nodes[n])->point));
            for (std::size_t n = 0; n < around_.size(); ++n)
                if (around_[n].size() == kTetsAroundANode) go(n, middle_of_neighbours(n));
            if (most < 1e-6 * spacing_) break;
        }
    }

  private:
    double least_volume(std::size_t n) const {
        double least = std::numeric_limits<double>::infinity();
        for (const int t : around_[n])
            least = std::min(least,
                             six_volumes(solid_.nodes, solid_.tets[static_cast<std::size_t>(t)]));
        return least;
    }
    /// Returns how far the node went.
    double go(std::size_t n, const Vec3& goal) {
        const Vec3 from = solid_.nodes[n];
        const double least =
            std::min(kLeastVolume * spacing_ * spacing_ * spacing_, least_volume(n));
        for (double share = 1; share > kLeastShare; share *= 0.5) {
            solid_.nodes[n] = from + share * (goal - from);
            if (least_volume(n) >= least) return share * (goal - from).norm();
        }
        solid_.nodes[n] = from;
        return 0;
    }
    /// Every neighbour counts once for each tetrahedron that both have.
    Vec3 middle_of_neighbours(std::size_t n) const {
        Vec3 sum = Vec3::Zero();
        for (const int t : around_[n])
            for (const int other : solid_.tets[static_cast<std::size_t>(t)])
                if (static_cast<std::size_t>(other) != n)
                    sum += solid_.nodes[static_cast<std::size_t>(other)];
        return sum / (3.0 * static_cast<double>(around_[n].size()));
    }

    const SurfaceTree& tree_;
    double spacing_;
    LatticeTets& solid_;
    std::vector<std::vector<int>> around_;
};

}  // namespace

FilledSurface fill_with_tets(const Points& positions, const Triangles& triangles, double spacing,
                             NotFilled& why) {
    FilledSurface out;
    why = NotFilled::kOpen;
    if (!is_closed(triangles)) return out;
    why = NotFilled::kInsideOut;
    if (!(volume_inside(positions, triangles) > 0)) return out;
    const Lattice lattice(positions, spacing);
    why = NotFilled::kTooFine;
    if (lattice.cubes() > kMostFillingCubes) return out;
    const SurfaceTree tree(positions, triangles);
    const auto inside = [&](const Vec3& at) { return winding(positions, triangles, at) > 0.5; };
    LatticeTets solid;
    lattice.each([&](const std::array<long, 3>& cube) {
        const Vec3 middle = lattice.point(cube, 0.5);
        if (tree.closest(middle, spacing)) {  // the surface may pass through the cube
            solid.add(cube, lattice, inside);
        } else if (inside(middle)) {
            solid.add(cube, lattice, [](const Vec3&) { return true; });
        }
    });
    why = NotFilled::kTooCoarse;
    if (solid.tets.empty()) return out;
    why = NotFilled::kNothing;
    for (int round = 0; round < kRounds; ++round) {
        Mover(tree, spacing, solid).run();
        if (!drop_blocking(tree, spacing, solid)) break;
        drop_nodes(solid);
    }

    out.nodes.resize(static_cast<Eigen::Index>(solid.nodes.size()), 3);
    for (std::size_t n = 0; n < solid.nodes.size(); ++n)
        out.nodes.row(static_cast<Eigen::Index>(n)) = solid.nodes[n].transpose();
    out.tets.resize(static_cast<Eigen::Index>(solid.tets.size()), 4);
    for (std::size_t t = 0; t < solid.tets.size(); ++t)
        for (int k = 0; k < 4; ++k)
            out.tets(static_cast<Eigen::Index>(t), k) = solid.tets[t][static_cast<std::size_t>(k)];
    return out;
}

}  // namespace risorius::geom
