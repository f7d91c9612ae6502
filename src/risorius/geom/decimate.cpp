// SPDX-License-Identifier: MIT
#include "risorius/geom/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>

namespace risorius::geom {

namespace {

constexpr double kPi = 3.14159265358979323846;

// The surface during coarsening.
class Surface {
  public:
    Surface(const Triangles& triangles, const Points& points, const std::vector<char>& seam)
        : points_(points), seam_(seam) {
        faces_of_.resize(static_cast<std::size_t>(points.rows()));
        for (long f = 0; f < triangles.rows(); ++f) {
            faces_.push_back({triangles(f, 0), triangles(f, 1), triangles(f, 2)});
            alive_.push_back(1);
            for (int k = 0; k < 3; ++k) faces_of_[triangles(f, k)].push_back(static_cast<int>(f));
        }
        rest_normal_.assign(faces_.size(), Vec3::Zero());
        for (std::size_t f = 0; f < faces_.size(); ++f) rest_normal_[f] = normal(faces_[f]);
    }

    bool on_seam(int v) const { return !seam_.empty() && seam_[v]; }
    Vec3 at(int v) const { return points_.row(v).transpose(); }
    Vec3 normal(const std::array<int, 3>& f) const {
        return (at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0])).normalized();
    }
    std::vector<int> neighbours(int v) const {
        std::vector<int> out;
        for (int f : faces_of_[v])
            for (int w : faces_[f])
                if (w != v) out.push_back(w);
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }
    int faces_on_edge(int a, int b) const {
        int count = 0;
        for (int f : faces_of_[a])
            if (std::find(faces_[f].begin(), faces_[f].end(), b) != faces_[f].end()) ++count;
        return count;
    }
    std::vector<int> boundary_neighbours(int v) const {
        std::vector<int> out;
        for (int w : neighbours(v))
            if (faces_on_edge(v, w) == 1) out.push_back(w);
        return out;
    }

    const Points& points_;
    const std::vector<char>& seam_;
    std::vector<std::array<int, 3>> faces_;
    std::vector<char> alive_;
    std::vector<std::vector<int>> faces_of_;
    std::vector<Vec3> rest_normal_;
};

// 1 for an equilateral triangle, 0 for a degenerate one.
double quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area2 = (b - a).cross(c - a).norm();
    const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return edges > 0 ? 2.0 * std::sqrt(3.0) * area2 / edges : 0.0;
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto angle = [](const Vec3& u, const Vec3& v) {
        return std::atan2(u.cross(v).norm(), u.dot(v));
    };
    return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

// True when a collapse preserves the seam: its vertices, except its ends, move only along it, and no other edge connects two of
// them.
bool keeps_seam(const Surface& s, int gone, int stays, const std::vector<int>& around,
                const std::vector<int>& common, const std::vector<int>& border) {
    if (s.on_seam(gone))
        return s.on_seam(stays) &&
               std::all_of(border.begin(), border.end(), [&](int w) { return s.on_seam(w); });
    if (!s.on_seam(stays)) return true;
    return std::all_of(around.begin(), around.end(), [&](int w) {
        return w == stays || !s.on_seam(w) || std::binary_search(common.begin(), common.end(), w);
    });
}

// Quality of the surface after moving `gone` onto `stays`; negative when the collapse is not allowed.
double collapse_quality(const Surface& s, int gone, int stays, const std::vector<double>& length,
                        const DecimateOptions& options) {
    const std::vector<int> around = s.neighbours(gone), around_stays = s.neighbours(stays);
    std::vector<int> common;
    std::set_intersection(around.begin(), around.end(), around_stays.begin(), around_stays.end(),
                          std::back_inserter(common));
    const int on_edge = s.faces_on_edge(gone, stays);
    if (static_cast<int>(common.size()) != on_edge) return -1;  // link condition
    const auto only_these = [&](int v) {
        return static_cast<int>(s.faces_of_[v].size()) == on_edge;
    };
    if (only_these(gone) && only_these(stays)) return -1;  // the last triangle of a piece

    const std::vector<int> border = s.boundary_neighbours(gone);
    if (!keeps_seam(s, gone, stays, around, common, border)) return -1;
    if (!border.empty()) {
        if (border.size() != 2 || on_edge != 1) return -1;
        const int other = border[0] == stays ? border[1] : border[0];
        const Vec3 along = s.at(other) - s.at(stays);
        const Vec3 from = s.at(gone) - s.at(stays);
        const double t = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
        // A seam is a boundary of this half only. There the normals decide, as inside a surface.
        if (!s.on_seam(gone) &&
            (from - t * along).norm() > options.boundary_tolerance * length[gone])
            return -1;
    } else if (!s.boundary_neighbours(stays).empty() && on_edge != 2) {
        return -1;
    }
    for (int w : around)
        if (w != stays && (s.at(w) - s.at(stays)).norm() >
                              options.longest_edge * 0.5 * (length[w] + length[stays]))
            return -1;

    const double turn = std::cos(options.max_normal_turn_deg * kPi / 180.0);
    double worst = 1.0;
    for (int f : s.faces_of_[gone]) {
        std::array<int, 3> face = s.faces_[f];
        if (std::find(face.begin(), face.end(), stays) != face.end()) continue;
        std::replace(face.begin(), face.end(), gone, stays);
        if (s.normal(face).dot(s.rest_normal_[f]) < turn) return -1;
        worst = std::min(worst, quality(s.at(face[0]), s.at(face[1]), s.at(face[2])));
    }
    return worst;
}

struct Candidate {
    double order;
    int a, b;
    bool operator>(const Candidate& o) const {
        if (order != o.order) return order > o.order;
        return a != o.a ? a > o.a : b > o.b;
    }
};

void flip_edges(Surface& s, const DecimateOptions& options) {
    const double turn = std::cos(options.max_normal_turn_deg * kPi / 180.0);
    for (int sweep = 0; sweep < 8; ++sweep) {
        std::map<std::pair<int, int>, std::vector<int>> edges;
        for (std::size_t f = 0; f < s.faces_.size(); ++f)
            if (s.alive_[f])
                for (int k = 0; k < 3; ++k) {
                    const int a = s.faces_[f][k], b = s.faces_[f][(k + 1) % 3];
                    edges[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(f));
                }
        int flips = 0;
        std::vector<char> touched(s.faces_.size(), 0);
        for (const auto& [edge, faces] : edges) {
            if (faces.size() != 2 || touched[faces[0]] || touched[faces[1]]) continue;
            std::array<int, 3>&f = s.faces_[faces[0]], &g = s.faces_[faces[1]];
            int a = edge.first, b = edge.second;
            const auto opposite = [&](const std::array<int, 3>& face) {
                for (int v : face)
                    if (v != a && v != b) return v;
                return -1;
            };
            // Orients the edge so that face f runs a -> b.
            for (int k = 0; k < 3; ++k)
                if (f[k] == b && f[(k + 1) % 3] == a) std::swap(a, b);
            const int c = opposite(f), d = opposite(g);
            if (c < 0 || d < 0 || c == d || s.faces_on_edge(c, d) > 0) continue;
            if (s.on_seam(c) && s.on_seam(d)) continue;
            const Vec3 pa = s.at(a), pb = s.at(b), pc = s.at(c), pd = s.at(d);
            const double before = std::min(smallest_angle(pa, pb, pc), smallest_angle(pb, pa, pd));
            const double after = std::min(smallest_angle(pc, pa, pd), smallest_angle(pd, pb, pc));
            if (after < before + 0.02) continue;
            const std::array<int, 3> f_new{c, a, d}, g_new{d, b, c};
            const Vec3 mean = (s.normal(f) + s.normal(g)).normalized();
            const Vec3 nf = s.normal(f_new), ng = s.normal(g_new);
            if (nf.dot(mean) < turn || ng.dot(mean) < turn || nf.dot(ng) < 0.5) continue;
            const auto drop = [&](int v, int face) {
                auto& list = s.faces_of_[v];
                list.erase(std::find(list.begin(), list.end(), face));
            };
            drop(b, faces[0]);
            drop(a, faces[1]);
            s.faces_of_[d].push_back(faces[0]);
            s.faces_of_[c].push_back(faces[1]);
            f = f_new;
            g = g_new;
            touched[faces[0]] = touched[faces[1]] = 1;
            ++flips;
        }
        if (flips == 0) return;
    }
}

}  // namespace

Decimated decimate(const Triangles& triangles, const Points& points,
                   const std::vector<double>& length, const std::vector<char>& keep,
                   const DecimateOptions& options, const std::vector<char>& seam) {
    Surface s(triangles, points, seam);
    const std::size_t count = static_cast<std::size_t>(points.rows());
    std::vector<int> parent(count, -1);
    for (long f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) parent[triangles(f, k)] = triangles(f, k);

    // No vertex moves, so an edge keeps its priority while it is in the queue.
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
    std::vector<std::vector<int>> waiting(count);  // queued edges a < b: b is listed at a
    const auto push = [&](int a, int b) {
        if (a > b) std::swap(a, b);
        if (std::find(waiting[a].begin(), waiting[a].end(), b) != waiting[a].end()) return;
        const double ratio = (s.at(a) - s.at(b)).norm() / (0.5 * (length[a] + length[b]));
        if (ratio >= 1.0) return;
        queue.push({ratio, a, b});
        waiting[a].push_back(b);
    };
    for (std::size_t v = 0; v < count; ++v)
        for (int w : s.neighbours(static_cast<int>(v)))
            if (static_cast<int>(v) < w) push(static_cast<int>(v), w);

    const auto kept_always = [&](int v) { return !keep.empty() && keep[v]; };
    while (!queue.empty()) {
        const Candidate top = queue.top();
        queue.pop();
        std::vector<int>& waited = waiting[top.a];
        waited.erase(std::find(waited.begin(), waited.end(), top.b));
        if (parent[top.a] != top.a || parent[top.b] != top.b) continue;
        if (s.faces_on_edge(top.a, top.b) == 0) continue;
        constexpr double kWorstQuality = 0.35;
        const double ab =
            kept_always(top.a) ? -1 : collapse_quality(s, top.a, top.b, length, options);
        const double ba =
            kept_always(top.b) ? -1 : collapse_quality(s, top.b, top.a, length, options);
        if (std::max(ab, ba) < kWorstQuality) continue;
        const int gone = ab >= ba ? top.a : top.b, stays = ab >= ba ? top.b : top.a;

        for (int f : s.faces_of_[gone]) {
            std::array<int, 3>& face = s.faces_[f];
            if (std::find(face.begin(), face.end(), stays) != face.end()) {
                s.alive_[f] = 0;
                for (int v : face)
                    if (v != gone) {
                        auto& list = s.faces_of_[v];
                        list.erase(std::find(list.begin(), list.end(), f));
                    }
            } else {
                std::replace(face.begin(), face.end(), gone, stays);
                s.faces_of_[stays].push_back(f);
            }
        }
        s.faces_of_[gone].clear();
        parent[gone] = stays;
        // Edges around the changed vertex that were rejected before are tried again.
        for (int w : s.neighbours(stays))
            for (int x : s.neighbours(w)) push(w, x);
    }
    flip_edges(s, options);

    Decimated out;
    std::vector<std::array<int, 3>> left;
    for (std::size_t f = 0; f < s.faces_.size(); ++f)
        if (s.alive_[f]) left.push_back(s.faces_[f]);
    out.triangles.resize(static_cast<long>(left.size()), 3);
    for (std::size_t f = 0; f < left.size(); ++f)
        for (int k = 0; k < 3; ++k) out.triangles(static_cast<long>(f), k) = left[f][k];
    out.collapsed_to.assign(count, -1);
    for (std::size_t v = 0; v < count; ++v) {
        if (parent[v] < 0) continue;
        int root = static_cast<int>(v);
        while (parent[root] != root) root = parent[root];
        out.collapsed_to[v] = root;
        if (root == static_cast<int>(v)) out.kept.push_back(root);
    }
    return out;
}

}  // namespace risorius::geom
