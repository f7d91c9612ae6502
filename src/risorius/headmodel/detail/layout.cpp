// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/layout.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "risorius/core/error.h"

namespace risorius::headmodel {
namespace {

using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// The longest closed chain of edges that only one face has, in the direction of their faces.
std::vector<int> outer_loop(const std::vector<std::array<int, 4>>& faces) {
    std::map<std::pair<int, int>, int> uses;
    for (const auto& f : faces)
        for (std::size_t k = 0; k < 4; ++k) {
            const int a = f[k], b = f[(k + 1) % 4];
            ++uses[{std::min(a, b), std::max(a, b)}];
        }
    std::map<int, int> next;
    for (const auto& f : faces)
        for (std::size_t k = 0; k < 4; ++k) {
            const int a = f[k], b = f[(k + 1) % 4];
            if (uses[{std::min(a, b), std::max(a, b)}] == 1) next[a] = b;
        }
    std::vector<int> longest;
    while (!next.empty()) {
        std::vector<int> loop;
        for (int v = next.begin()->first;;) {
            const auto found = next.find(v);
            if (found == next.end()) break;
            loop.push_back(v);
            v = found->second;
            next.erase(found);
        }
        if (loop.size() > longest.size()) longest = loop;
    }
    return longest;
}

/// Solves for what is not held; the others keep their values.
struct Unknowns {
    std::vector<int> index;  ///< -1 where held
    int count = 0;
    explicit Unknowns(const std::vector<bool>& held) : index(held.size(), -1) {
        for (std::size_t v = 0; v < held.size(); ++v)
            if (!held[v]) index[v] = count++;
    }
};

struct Spring {
    int a, b;
    double weight;
};

Eigen::SparseMatrix<double> stiffness(const std::vector<Spring>& springs, const Unknowns& unknown) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Spring& s : springs) {
        const int i = unknown.index[static_cast<std::size_t>(s.a)],
                  j = unknown.index[static_cast<std::size_t>(s.b)];
        if (i >= 0) entries.emplace_back(i, i, s.weight);
        if (j >= 0) entries.emplace_back(j, j, s.weight);
        if (i < 0 || j < 0) continue;
        entries.emplace_back(i, j, -s.weight);
        entries.emplace_back(j, i, -s.weight);
    }
    Eigen::SparseMatrix<double> matrix(unknown.count, unknown.count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// A triangle as it lies in its own plane, and the weights of its edges (edge k is opposite corner k).
struct FlatTriangle {
    std::array<int, 3> corner;
    std::array<Vec2, 3> at;
    std::array<double, 3> weight;
};

std::vector<FlatTriangle> flat_triangles(const std::vector<Vec3>& points,
                                         const std::vector<std::array<int, 4>>& faces,
                                         const std::vector<int>& local) {
    std::vector<FlatTriangle> triangles;
    for (const auto& f : faces)
        // Both diagonals, at half weight: which one a quad is cut by makes no difference.
        for (const auto& c : {std::array{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}) {
            FlatTriangle t;
            std::array<Vec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                const int v = f[static_cast<std::size_t>(c[k])];
                t.corner[k] = local[static_cast<std::size_t>(v)];
                p[k] = points[static_cast<std::size_t>(v)];
            }
            const Vec3 along = p[1] - p[0], other = p[2] - p[0];
            const double length = std::max(along.norm(), 1e-6);
            const double height = along.cross(other).norm() / length;
            t.at = {Vec2(0, 0), Vec2(length, 0), Vec2(along.dot(other) / length, height)};
            constexpr double kMax = 20;  // cotangent of an angle of three degrees
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
                const double cross = a.cross(b).norm();
                t.weight[k] = 0.25 * std::clamp(a.dot(b) / std::max(cross, 1e-9), 0.02, kMax);
            }
            triangles.push_back(t);
        }
    return triangles;
}

double area_of(const FlatTriangle& t, const std::vector<Vec2>& at) {
    const auto corner = [&](std::size_t k) { return at[static_cast<std::size_t>(t.corner[k])]; };
    const Vec2 a = corner(1) - corner(0), b = corner(2) - corner(0);
    return a.x() * b.y() - a.y() * b.x();
}
double area_on_surface(const FlatTriangle& t) { return std::max(1e-6, t.at[1].x() * t.at[2].y()); }

/// As rigid as possible may fold where the surface is curved most. There vertices move, one after the other, until the triangle about
/// them that is worst off, by its area over that on the surface, is as well off as can be, or well enough.
void unfold(const std::vector<FlatTriangle>& triangles, const std::vector<bool>& held_u,
            std::vector<Vec2>& at) {
    constexpr double kFolded = 0.0, kWell = 0.05;
    constexpr int kSweeps = 60;
    std::vector<std::vector<const FlatTriangle*>> about(at.size());
    for (const FlatTriangle& t : triangles)
        for (const int v : t.corner) about[static_cast<std::size_t>(v)].push_back(&t);
    const auto worst = [&](std::size_t v) {
        double out = 1;
        for (const FlatTriangle* t : about[v])
            out = std::min(out, area_of(*t, at) / area_on_surface(*t));
        return out;
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool folded = false;
        for (std::size_t v = 0; v < at.size(); ++v) {
            double best = worst(v);
            if (best > kFolded) continue;
            folded = true;
            double reach = 0;
            for (const FlatTriangle* t : about[v]) reach = std::max(reach, t->at[1].x());
            for (; reach > 1e-4; reach *= 0.5)
                for (int turn = 0; turn < 8 && best < kWell; ++turn) {
                    const Vec2 before = at[v];
                    const double angle = M_PI / 4 * turn;
                    at[v] += reach * Vec2(held_u[v] ? 0 : std::cos(angle), std::sin(angle));
                    const double now = worst(v);
                    if (now > best)
                        best = now;
                    else
                        at[v] = before;
                }
        }
        if (!folded) return;
    }
}

/// Puts the border on a circle, or on a half circle with its straight part on the diameter; says whether a part is straight.
bool place_border(std::vector<int>& loop, const std::vector<int>& local,
                  const std::vector<bool>& straight, std::vector<Vec2>& at,
                  std::vector<bool>& on_border) {
    // Begin after the last straight vertex, so that all between the first and the last of them lies on the line.
    std::size_t begin = 0, longest = 0, gap = 0;
    for (std::size_t k = 0; k < 2 * loop.size(); ++k) {
        gap = straight[static_cast<std::size_t>(loop[k % loop.size()])] ? 0 : gap + 1;
        if (gap > longest && gap <= loop.size()) {
            longest = gap;
            begin = (k + 1 + loop.size() - gap) % loop.size();
        }
    }
    std::rotate(loop.begin(), loop.begin() + static_cast<long>(begin), loop.end());
    const bool lined = longest < loop.size();
    const double round = lined ? M_PI : 2 * M_PI;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto i = static_cast<std::size_t>(local[static_cast<std::size_t>(loop[k])]);
        on_border[i] = true;
        if (k < longest) {
            const double angle =
                -M_PI / 2 +
                (lined ? round * static_cast<double>(k + 1) / static_cast<double>(longest + 1)
                       : round * static_cast<double>(k) / static_cast<double>(longest));
            at[i] = 300 * Vec2(std::cos(angle), std::sin(angle));
        } else {
            const double fraction = static_cast<double>(k - longest) /
                                    std::max(1.0, static_cast<double>(loop.size() - longest - 1));
            at[i] = 300 * Vec2(0, 1 - 2 * fraction);
        }
    }
    return lined;
}

/// The right sides of the joining: the edges of every triangle, turned as the triangle lies now.
std::pair<Eigen::VectorXd, Eigen::VectorXd> turned_edges(const std::vector<FlatTriangle>& triangles,
                                                         const std::vector<Vec2>& at,
                                                         const Unknowns& free_u,
                                                         const Unknowns& free_v) {
    Eigen::VectorXd right_u = Eigen::VectorXd::Zero(free_u.count),
                    right_v = Eigen::VectorXd::Zero(free_v.count);
    for (const FlatTriangle& t : triangles) {
        Eigen::Matrix2d join = Eigen::Matrix2d::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            join += t.weight[k] *
                    (at[static_cast<std::size_t>(t.corner[b])] -
                     at[static_cast<std::size_t>(t.corner[a])]) *
                    (t.at[b] - t.at[a]).transpose();
        }
        // The nearest turn of a plane matrix
        const double c = join(0, 0) + join(1, 1), s = join(1, 0) - join(0, 1);
        const double size = std::max(std::hypot(c, s), 1e-12);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            const Vec2 d = t.at[b] - t.at[a];
            const Vec2 turned(t.weight[k] * (c * d.x() - s * d.y()) / size,
                              t.weight[k] * (s * d.x() + c * d.y()) / size);
            const auto push = [&](const Unknowns& unknown, Eigen::VectorXd& right, int axis) {
                const int i = unknown.index[static_cast<std::size_t>(t.corner[a])],
                          j = unknown.index[static_cast<std::size_t>(t.corner[b])];
                if (i >= 0) right[i] -= turned[axis];
                if (j >= 0) right[j] += turned[axis];
            };
            push(free_u, right_u, 0);
            push(free_v, right_v, 1);
        }
    }
    return {right_u, right_v};
}

}  // namespace

std::vector<Vec2> flatten(const std::vector<Vec3>& points,
                          const std::vector<std::array<int, 4>>& faces,
                          const std::vector<bool>& straight) {
    // Vertices of these faces alone
    std::vector<int> local(points.size(), -1), global;
    for (const auto& f : faces)
        for (const int v : f)
            if (local[static_cast<std::size_t>(v)] < 0) {
                local[static_cast<std::size_t>(v)] = static_cast<int>(global.size());
                global.push_back(v);
            }
    const std::size_t n = global.size();
    std::vector<int> loop = outer_loop(faces);
    if (loop.size() < 4) throw Error("chart", "a surface with a border", "none");

    // First flat on a round table (Tutte 1963), where nothing can fold: a half disc when part of it is straight.
    std::vector<Vec2> at(n, Vec2::Zero());
    std::vector<bool> on_border(n, false), on_line(n, false);
    for (std::size_t i = 0; i < n; ++i) on_line[i] = straight[static_cast<std::size_t>(global[i])];
    const bool lined = place_border(loop, local, straight, at, on_border);
    std::vector<Spring> even;
    for (const auto& f : faces)
        for (std::size_t k = 0; k < 4; ++k)
            even.push_back({local[static_cast<std::size_t>(f[k])],
                            local[static_cast<std::size_t>(f[(k + 1) % 4])], 1.0});
    const Unknowns inside(on_border);
    const auto solve = [&](const Solver& solver, const Unknowns& unknown,
                           const std::vector<Spring>& springs, int axis, Eigen::VectorXd right) {
        for (const Spring& s : springs) {
            const int i = unknown.index[static_cast<std::size_t>(s.a)],
                      j = unknown.index[static_cast<std::size_t>(s.b)];
            if (i >= 0 && j < 0) right[i] += s.weight * at[static_cast<std::size_t>(s.b)][axis];
            if (j >= 0 && i < 0) right[j] += s.weight * at[static_cast<std::size_t>(s.a)][axis];
        }
        return Eigen::VectorXd(solver.solve(right));
    };
    {
        const Solver solver(stiffness(even, inside));
        const Eigen::VectorXd zero = Eigen::VectorXd::Zero(inside.count);
        const Eigen::VectorXd u = solve(solver, inside, even, 0, zero),
                              v = solve(solver, inside, even, 1, zero);
        for (std::size_t i = 0; i < n; ++i)
            if (inside.index[i] >= 0) at[i] = Vec2(u[inside.index[i]], v[inside.index[i]]);
    }

    // Then every triangle is turned as it lies now, and all are joined again, over and over.
    constexpr int kRounds = 150;
    const std::vector<FlatTriangle> triangles = flat_triangles(points, faces, local);
    std::vector<Spring> springs;
    for (const FlatTriangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            springs.push_back({t.corner[(k + 1) % 3], t.corner[(k + 2) % 3], t.weight[k]});
    std::vector<bool> held_u = on_line, held_v(n, false);
    if (!lined) held_u[0] = true;
    held_v[0] = true;
    for (std::size_t i = 0; i < n; ++i)
        if (on_line[i]) at[i].x() = 0;
    const Unknowns free_u(held_u), free_v(held_v);
    const Solver solver_u(stiffness(springs, free_u)), solver_v(stiffness(springs, free_v));
    for (int round_number = 0; round_number < kRounds; ++round_number) {
        const auto [right_u, right_v] = turned_edges(triangles, at, free_u, free_v);
        const Eigen::VectorXd u = solve(solver_u, free_u, springs, 0, right_u),
                              v = solve(solver_v, free_v, springs, 1, right_v);
        for (std::size_t i = 0; i < n; ++i) {
            if (free_u.index[i] >= 0) at[i].x() = u[free_u.index[i]];
            if (free_v.index[i] >= 0) at[i].y() = v[free_v.index[i]];
        }
    }
    unfold(triangles, on_line, at);
    std::vector<Vec2> places(points.size(), Vec2::Zero());
    for (std::size_t i = 0; i < n; ++i) places[static_cast<std::size_t>(global[i])] = at[i];
    return places;
}

namespace {

using Quads = std::vector<std::array<int, 4>>;

/// Cuts a pit open from its border to the vertex that is farthest from it, so that it need not be pressed to lie flat: vertices on the
/// left of the cut become new ones at the end of `points`.
void cut_open(std::vector<Vec3>& points, Quads& faces) {
    std::map<std::pair<int, int>, std::size_t> face_of;  // of each directed edge
    std::map<int, std::vector<int>> next_to;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 4; ++k) {
            const int a = faces[f][k], b = faces[f][(k + 1) % 4];
            face_of[{a, b}] = f;
            next_to[a].push_back(b);
            next_to[b].push_back(a);
        }
    // Shortest ways from the border (Dijkstra 1959)
    std::map<int, std::pair<double, int>> way;  // length, and from where
    std::set<std::pair<double, int>> open;
    for (const int v : outer_loop(faces)) {
        way[v] = {0.0, -1};
        open.insert({0.0, v});
    }
    int end = -1;
    while (!open.empty()) {
        const auto [length, v] = *open.begin();
        open.erase(open.begin());
        if (length > way.at(v).first) continue;
        end = v;
        for (const int w : next_to[v]) {
            const double longer =
                length +
                (points[static_cast<std::size_t>(w)] - points[static_cast<std::size_t>(v)]).norm();
            const auto known = way.find(w);
            if (known != way.end() && known->second.first <= longer) continue;
            way[w] = {longer, v};
            open.insert({longer, w});
        }
    }
    const Quads whole = faces;
    int inner = end;
    for (int v = way.at(end).second; v >= 0; inner = v, v = way.at(v).second) {
        // The faces on the left of the way from v inwards, round v to where the way comes from or the border is
        const int from = way.at(v).second;
        const auto copy = static_cast<int>(points.size());
        points.push_back(points[static_cast<std::size_t>(v)]);
        for (auto found = face_of.find({v, inner}); found != face_of.end();) {
            const std::array<int, 4>& face = whole[found->second];
            std::size_t k = 0;
            while (face[k] != v) ++k;
            faces[found->second][k] = copy;
            const int before = face[(k + 3) % 4];
            if (before == from) break;
            found = face_of.find({v, before});
        }
    }
}

struct Chart {
    std::vector<int> faces;    ///< of the half
    Quads corner;              ///< of each of them, into:
    std::vector<Vec3> points;  ///< mm: those of the half, and more where it is cut
    std::vector<Vec2> place;   ///< mm
    Vec2 low{1e9, 1e9}, high{-1e9, -1e9};

    void turn_upright() {
        // Up in space is up in the picture, on the average.
        Vec3 middle = Vec3::Zero();
        Vec2 flat_middle = Vec2::Zero();
        double count = 0;
        for (const auto& quad : corner)
            for (const int v : quad) {
                middle += points[static_cast<std::size_t>(v)];
                flat_middle += place[static_cast<std::size_t>(v)];
                ++count;
            }
        middle /= count;
        flat_middle /= count;
        Vec2 up = Vec2::Zero();
        for (const auto& quad : corner)
            for (const int v : quad)
                up += (points[static_cast<std::size_t>(v)].y() - middle.y()) *
                      (place[static_cast<std::size_t>(v)] - flat_middle);
        if (up.norm() < 1e-6) return;
        up.normalize();
        for (Vec2& p : place) p = Vec2(up.y() * p.x() - up.x() * p.y(), up.dot(p));
    }
    void measure() {
        for (const auto& quad : corner)
            for (const int v : quad) {
                low = low.cwiseMin(place[static_cast<std::size_t>(v)]);
                high = high.cwiseMax(place[static_cast<std::size_t>(v)]);
            }
    }
};

}  // namespace

void lay_out(const HalfMesh& half, double crown_z, const std::vector<int>& upper,
             const std::vector<int>& lower, geom::PolygonMesh& mesh) {
    std::map<int, int> shut;
    for (std::size_t k = 0; k < upper.size(); ++k) shut[upper[k]] = lower[k];
    // Head, ear, nostril, mouth
    constexpr std::size_t kNostril = 2;
    std::array<Chart, 4> charts;
    const auto chart_of = [](Region region) -> std::size_t {
        return region == Region::kEar       ? 1
               : region == Region::kNostril ? kNostril
               : region == Region::kLining  ? 3
                                            : 0;
    };
    std::vector<std::size_t> in_chart;  // of each face of the half
    for (std::size_t f = 0; f < half.face.size(); ++f) {
        std::vector<int>& list = charts[chart_of(half.region[f])].faces;
        in_chart.push_back(list.size());
        list.push_back(static_cast<int>(f));
    }
    for (std::size_t c = 0; c < charts.size(); ++c) {
        Chart& chart = charts[c];
        chart.points = half.point;
        for (const int f : chart.faces) {
            chart.corner.push_back(half.face[static_cast<std::size_t>(f)]);
            if (c > 0) continue;
            for (int& v : chart.corner.back())
                if (const auto found = shut.find(v); found != shut.end()) v = found->second;
        }
        if (c == kNostril) cut_open(chart.points, chart.corner);
        std::vector<bool> straight(chart.points.size(), false);
        if (c == 0)
            for (std::size_t v = 0; v < half.point.size(); ++v)
                straight[v] = half.midline[v] && half.point[v].z() > crown_z;
        chart.place = flatten(chart.points, chart.corner, straight);
        if (c > 0) chart.turn_upright();
        chart.measure();
    }
    // The head above, its halves side by side; below it the small ones, mirrored about the middle too.
    constexpr double kGap_mm = 4;
    double shelf = 0, along = kGap_mm;
    std::array<Vec2, 4> corner;  // of the left ones
    for (std::size_t c = 1; c < charts.size(); ++c) {
        corner[c] = Vec2(along, kGap_mm);
        along += charts[c].high.x() - charts[c].low.x() + 2 * kGap_mm;
        shelf = std::max(shelf, charts[c].high.y() - charts[c].low.y());
    }
    corner[0] = Vec2(charts[0].low.x(), shelf + 2 * kGap_mm);
    const double half_width = std::max(charts[0].high.x() + kGap_mm, along),
                 height = corner[0].y() + charts[0].high.y() - charts[0].low.y() + kGap_mm;
    const double scale = 1 / std::max(2 * half_width, height);
    const std::size_t faces = half.face.size();
    for (std::size_t f = 0; f < 2 * faces; ++f) {
        const std::size_t own = f % faces, c = chart_of(half.region[own]);
        const Chart& chart = charts[c];
        const bool mirror = f >= faces;
        const std::array<int, 4>& corners = chart.corner[in_chart[own]];
        for (std::size_t k = 0; k < 4; ++k) {
            const int v = corners[mirror ? 3 - k : k];
            Vec2 p = chart.place[static_cast<std::size_t>(v)] - chart.low + corner[c];
            if (mirror) p.x() = -p.x();
            mesh.corner_texcoord.row(mesh.face_begin[f] + static_cast<int>(k)) =
                Vec2(0.5 + scale * p.x(), scale * p.y());
        }
    }
}

}  // namespace risorius::headmodel
