// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/landmark_drop.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>
#include <vector>

#include "risorius/geom/closest_point.h"
#include "risorius/rig/landmark_warp.h"

namespace risorius::rig {

namespace {

constexpr double kAroundMouth_m = 40e-3;  // radius around stomion, at atlas size
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Shortest distances along the edges of a surface from the vertex nearest to any of `from`.
std::unordered_map<int, double> ways_from(
    const std::vector<Vec3>& from, const Points& vertices,
    const std::unordered_map<int, std::vector<int>>& neighbours) {
    std::unordered_map<int, double> way;
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        open;
    for (const Vec3& p : from) {
        int start = -1;
        double min = kInfinite;
        for (const auto& [v, others] : neighbours) {
            const double squared = (vertices.row(v).transpose() - p).squaredNorm();
            // Of equally near vertices the lowest index is used, because the order of a hash map is not defined.
            if (squared < min || (squared == min && v < start)) {
                min = squared;
                start = v;
            }
        }
        if (start < 0) continue;
        way[start] = 0;
        open.push({0.0, start});
    }
    while (!open.empty()) {
        const auto [distance, v] = open.top();
        open.pop();
        if (distance > way.at(v)) continue;
        for (int w : neighbours.at(v)) {
            const double longer = distance + (vertices.row(v) - vertices.row(w)).norm();
            const auto known = way.find(w);
            if (known != way.end() && known->second <= longer) continue;
            way[w] = longer;
            open.push({longer, w});
        }
    }
    return way;
}

// The triangles around the mouth that are nearer, along the skin, to the border of this lip than to that of the other lip.
Triangles lip_skin(const Triangles& around, const std::unordered_map<int, double>& own,
                   const std::unordered_map<int, double>& other) {
    std::vector<long> rows;
    for (long f = 0; f < around.rows(); ++f) {
        double nearer = 0;
        for (int k = 0; k < 3; ++k) {
            const auto here = own.find(around(f, k)), there = other.find(around(f, k));
            const double a = here == own.end() ? kInfinite : here->second;
            const double b = there == other.end() ? kInfinite : there->second;
            nearer += a < b ? 1 : a > b ? -1 : 0;
        }
        if (nearer > 1) rows.push_back(f);
    }
    Triangles out(static_cast<long>(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
        out.row(static_cast<long>(i)) = around.row(rows[i]);
    return out;
}

// Returns a vertex instead of a point between vertices: a point on the margin must belong to one lip, although the lips touch.
Vec3 nearest_vertex(const Vec3& p, const Points& vertices, const Triangles& triangles) {
    int best = triangles(0, 0);
    for (long f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = triangles(f, k);
            if ((vertices.row(v).transpose() - p).squaredNorm() <
                (vertices.row(best).transpose() - p).squaredNorm())
                best = v;
        }
    return vertices.row(best).transpose();
}

}  // namespace

std::map<std::string, Vec3> missing_landmarks(const Points& vertices, const Triangles& skin,
                                              const Atlas& atlas,
                                              const std::map<std::string, Vec3>& given,
                                              double size) {
    Points from(static_cast<long>(given.size()), 3), to(static_cast<long>(given.size()), 3);
    long row = 0;
    for (const auto& [id, p] : given) {
        from.row(row) = atlas.landmark(id)->position.transpose();
        to.row(row++) = p.transpose();
    }
    const LandmarkWarp warp(from, to, 1e-3);
    std::map<std::string, Vec3> warped;
    for (const AtlasLandmark& landmark : atlas.landmarks)
        if (!given.count(landmark.id)) warped[landmark.id] = warp(landmark.position);
    if (warped.empty()) return warped;

    // The skin around the mouth, and distances along it from the borders of both lips.
    const Vec3 mouth = given.at("sto");
    std::vector<long> near;
    std::unordered_map<int, std::vector<int>> neighbours;
    for (long f = 0; f < skin.rows(); ++f) {
        bool inside = true;
        for (int k = 0; k < 3; ++k)
            inside = inside &&
                     (vertices.row(skin(f, k)).transpose() - mouth).norm() < size * kAroundMouth_m;
        if (!inside) continue;
        near.push_back(f);
        for (int k = 0; k < 3; ++k) {
            neighbours[skin(f, k)].push_back(skin(f, (k + 1) % 3));
            neighbours[skin(f, (k + 1) % 3)].push_back(skin(f, k));
        }
    }
    Triangles around(static_cast<long>(near.size()), 3);
    for (std::size_t i = 0; i < near.size(); ++i)
        around.row(static_cast<long>(i)) = skin.row(near[i]);
    const auto border = [&](std::initializer_list<const char*> ids) {
        std::vector<Vec3> out;
        for (const char* id : ids) {
            const auto at = given.find(id);
            if (at != given.end()) out.push_back(at->second);
        }
        return ways_from(out, vertices, neighbours);
    };
    const auto upper = border({"ls", "cph_l", "cph_r", "ulc_l", "ulc_r"});
    const auto lower = border({"li", "llc_l", "llc_r"});
    const geom::SurfaceTree everywhere(vertices, skin);
    const Triangles upper_lip = lip_skin(around, upper, lower);
    const Triangles lower_lip = lip_skin(around, lower, upper);

    for (auto& [id, p] : warped) {
        const bool above = id == "stos" || id.starts_with("uli_") || id.starts_with("ulc_") ||
                           id.starts_with("cph_");
        const bool below = id == "stoi" || id.starts_with("lli_") || id.starts_with("llc_");
        const Triangles& own = above ? upper_lip : lower_lip;
        if ((above || below) && own.rows() > 0) {
            p = nearest_vertex(p, vertices, own);
        } else if (const auto foot = everywhere.closest(p)) {
            p = foot->point;
        }
    }
    return warped;
}

}  // namespace risorius::rig
