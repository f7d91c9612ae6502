// SPDX-License-Identifier: MIT
#include "risorius/geom/mirror.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace risorius::geom {

namespace {

// Finds the nearest of some points, by grid cells.
class NearestVertex {
  public:
    NearestVertex(const Points& points, const std::vector<int>& members, double cell)
        : points_(points), cell_(cell) {
        for (int v : members) cells_[cell_of(points.row(v).transpose())].push_back(v);
    }
    /// The nearest point; -1 when none is within the width of a cell.
    int nearest(const Vec3& p) const {
        const std::array<int, 3> home = cell_of(p);
        int best = -1;
        double min = cell_ * cell_;
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                for (int k = -1; k <= 1; ++k) {
                    const auto found = cells_.find({home[0] + i, home[1] + j, home[2] + k});
                    if (found == cells_.end()) continue;
                    for (int v : found->second) {
                        const double squared = (points_.row(v).transpose() - p).squaredNorm();
                        if (squared < min) {
                            min = squared;
                            best = v;
                        }
                    }
                }
        return best;
    }

  private:
    std::array<int, 3> cell_of(const Vec3& p) const {
        return {static_cast<int>(std::floor(p.x() / cell_)),
                static_cast<int>(std::floor(p.y() / cell_)),
                static_cast<int>(std::floor(p.z() / cell_))};
    }
    const Points& points_;
    double cell_;
    std::map<std::array<int, 3>, std::vector<int>> cells_;
};

}  // namespace

MirrorPairs find_mirror_pairs(const Triangles& triangles, const Points& points, Vec3 normal,
                              double offset, double tolerance) {
    const std::size_t count = static_cast<std::size_t>(points.rows());
    std::vector<double> shortest(count, std::numeric_limits<double>::infinity());
    double edges = 0;
    for (long f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
            const double edge = (points.row(a) - points.row(b)).norm();
            shortest[a] = std::min(shortest[a], edge);
            shortest[b] = std::min(shortest[b], edge);
            edges += edge / (3.0 * static_cast<double>(triangles.rows()));
        }
    std::vector<int> members;
    for (std::size_t v = 0; v < count; ++v)
        if (std::isfinite(shortest[v])) members.push_back(static_cast<int>(v));
    const NearestVertex search(points, members, 2.0 * edges);

    // The given plane comes from landmarks. The surface itself gives a more precise one.
    MirrorPairs mirror{std::vector<int>(count, -1), normal, offset};
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        Vec3 across = Vec3::Zero();
        double middle = 0;
        long pairs = 0;
        for (int v : members) {
            const Vec3 p = points.row(v).transpose();
            const Vec3 image = p - 2.0 * (mirror.normal.dot(p) - mirror.offset) * mirror.normal;
            const int w = mirror.partner[v] = search.nearest(image);
            if (w < 0 || search.nearest(p) != v) continue;
            const Vec3 q = points.row(w).transpose();
            across += p.dot(mirror.normal) > q.dot(mirror.normal) ? p - q : q - p;
            middle += 0.5 * mirror.normal.dot(p + q);
            ++pairs;
        }
        if (pairs < static_cast<long>(members.size()) / 2 || across.norm() == 0) return {};
        if (round + 1 == kRounds) break;
        mirror.offset = middle / static_cast<double>(pairs);
        mirror.normal = across.normalized();
    }

    for (int v : members) {
        const int w = mirror.partner[v];
        if (w < 0 || mirror.partner[w] != v) return {};
        const Vec3 p = points.row(v).transpose();
        const Vec3 image = p - 2.0 * (mirror.normal.dot(p) - mirror.offset) * mirror.normal;
        if ((points.row(w).transpose() - image).norm() > tolerance * shortest[v]) return {};
    }
    // Number of triangles of the first half at an edge.
    std::map<std::pair<int, int>, int> along_seam;
    for (long f = 0; f < triangles.rows(); ++f) {
        int min = 1, max = -1, on_seam = 0;
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
            const int side = mirror.side(a, points);
            min = std::min(min, side);
            max = std::max(max, side);
            on_seam += side == 0;
            if (side == 0 && mirror.side(b, points) == 0)
                ++along_seam[{std::min(a, b), std::max(a, b)}];
        }
        if (min * max < 0 || on_seam == 3) return {};
    }
    for (const auto& [edge, faces] : along_seam)
        if (faces > 2) return {};
    return mirror;
}

Triangles first_half(const Triangles& whole, const Points& points, const MirrorPairs& mirror) {
    Triangles half(whole.rows(), 3);
    long rows = 0;
    for (long f = 0; f < whole.rows(); ++f)
        if (mirror.side(whole(f, 0), points) >= 0 && mirror.side(whole(f, 1), points) >= 0 &&
            mirror.side(whole(f, 2), points) >= 0)
            half.row(rows++) = whole.row(f);
    half.conservativeResize(rows, 3);
    return half;
}

Triangles paired_half(const Triangles& whole, const Points& points, const MirrorPairs& mirror) {
    const auto sorted = [](std::array<int, 3> face) {
        std::sort(face.begin(), face.end());
        return face;
    };
    std::set<std::array<int, 3>> there;
    for (long f = 0; f < whole.rows(); ++f)
        there.insert(sorted({whole(f, 0), whole(f, 1), whole(f, 2)}));
    Triangles half = first_half(whole, points, mirror);
    long rows = 0;
    for (long f = 0; f < half.rows(); ++f)
        if (there.count(sorted({mirror.partner[half(f, 0)], mirror.partner[half(f, 1)],
                                mirror.partner[half(f, 2)]})))
            half.row(rows++) = half.row(f).eval();
    half.conservativeResize(rows, 3);
    return half;
}

Triangles with_mirror_image(const Triangles& half, const MirrorPairs& mirror) {
    Triangles whole(2 * half.rows(), 3);
    for (long f = 0; f < half.rows(); ++f) {
        whole.row(f) = half.row(f);
        whole.row(half.rows() + f) << mirror.partner[half(f, 0)], mirror.partner[half(f, 2)],
            mirror.partner[half(f, 1)];
    }
    return whole;
}

Decimated decimate_mirrored(const Triangles& half, const Points& points,
                            const std::vector<double>& length, const MirrorPairs& mirror,
                            const DecimateOptions& options) {
    std::vector<char> seam(mirror.partner.size(), 0);
    for (std::size_t v = 0; v < seam.size(); ++v)
        seam[v] = mirror.partner[v] == static_cast<int>(v);
    Decimated out = decimate(half, points, length, {}, options, seam);
    out.triangles = with_mirror_image(out.triangles, mirror);
    for (std::size_t v = 0; v < seam.size(); ++v)
        if (out.collapsed_to[v] >= 0)
            out.collapsed_to[mirror.partner[v]] = mirror.partner[out.collapsed_to[v]];
    out.kept.clear();
    for (std::size_t v = 0; v < seam.size(); ++v)
        if (out.collapsed_to[v] == static_cast<int>(v)) out.kept.push_back(static_cast<int>(v));
    return out;
}

}  // namespace risorius::geom
