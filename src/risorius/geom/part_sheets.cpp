// SPDX-License-Identifier: MIT
#include "risorius/geom/part_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace risorius::geom {
namespace {

constexpr double kSame = 1e-6;  // of angles; faces that coincide

/// A side of a face: the corner where it begins, and that where it ends.
struct Side {
    int low, high;  ///< vertices
    int from, to;   ///< corners
    int face;
    bool forward;  ///< runs from low to high
};

class Sheets {
  public:
    explicit Sheets(PolygonMesh& mesh) : mesh_(mesh), parent_(mesh.corner_vertex.size()) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    int part() {
        find_sides();
        std::vector<bool> crowded(static_cast<std::size_t>(mesh_.vertex_count()), false);
        bool any = false;
        for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
            while (end < sides_.size() && sides_[end].low == sides_[begin].low &&
                   sides_[end].high == sides_[begin].high)
                ++end;
            if (end - begin == 2) join(sides_[begin], sides_[begin + 1]);
            if (end - begin <= 2) continue;
            any = true;
            crowded[static_cast<std::size_t>(sides_[begin].low)] = true;
            crowded[static_cast<std::size_t>(sides_[begin].high)] = true;
            join_through_flesh(begin, end);
        }
        return any ? give_vertices(crowded) : 0;
    }

  private:
    Vec3 position(int vertex) const { return mesh_.positions.row(vertex).transpose(); }

    void find_sides() {
        for (int f = 0; f < mesh_.face_count(); ++f) {
            const int first = mesh_.face_begin[static_cast<std::size_t>(f)],
                      n = mesh_.corner_count(f);
            for (int k = 0; k < n; ++k) {
                const int from = first + k, to = first + (k + 1) % n;
                const int a = mesh_.corner_vertex[static_cast<std::size_t>(from)],
                          b = mesh_.corner_vertex[static_cast<std::size_t>(to)];
                if (a != b) sides_.push_back({std::min(a, b), std::max(a, b), from, to, f, a < b});
            }
        }
        std::stable_sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
            return std::pair(a.low, a.high) < std::pair(b.low, b.high);
        });
    }

    int root(int corner) {
        while (parent_[static_cast<std::size_t>(corner)] != corner) {
            int& up = parent_[static_cast<std::size_t>(corner)];
            up = parent_[static_cast<std::size_t>(up)];
            corner = up;
        }
        return corner;
    }
    void unite(int a, int b) {
        a = root(a);
        b = root(b);
        parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    /// Corners of two faces at the same edge are one vertex.
    void join(const Side& a, const Side& b) {
        const bool same = a.forward == b.forward;
        unite(a.from, same ? b.from : b.to);
        unite(a.to, same ? b.to : b.from);
    }

    /// The direction in which a face leaves an edge.
    Vec3 leaving(const Side& side) const {
        const Vec3 from = position(side.low), along = (position(side.high) - from).normalized();
        const auto f = static_cast<std::size_t>(side.face);
        Vec3 centre = Vec3::Zero();
        for (int c = mesh_.face_begin[f]; c < mesh_.face_begin[f + 1]; ++c)
            centre += position(mesh_.corner_vertex[static_cast<std::size_t>(c)]);
        centre = centre / mesh_.corner_count(side.face) - from;
        return centre - along * along.dot(centre);
    }

    void join_through_flesh(std::size_t begin, std::size_t end) {
        const Side& first = sides_[begin];
        const Vec3 axis = (position(first.high) - position(first.low)).normalized(),
                   zero = leaving(first).normalized(), quarter = axis.cross(zero);
        // Counter-clockwise around the axis. The flesh of a face that runs forward lies on the clockwise side: its normal is
        // axis x direction, the counter-clockwise side.
        std::vector<std::pair<double, std::size_t>> around;
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3 direction = leaving(sides_[i]);
            double angle = i == begin ? 0 : std::atan2(direction.dot(quarter), direction.dot(zero));
            if (angle < -kSame) angle += 2 * std::numbers::pi;
            around.emplace_back(angle, i);
        }
        // At equal angles, a face whose flesh lies before it comes first.
        std::sort(around.begin(), around.end(), [&](const auto& a, const auto& b) {
            if (std::abs(a.first - b.first) > kSame) return a.first < b.first;
            return std::pair(!sides_[a.second].forward, a.second) <
                   std::pair(!sides_[b.second].forward, b.second);
        });
        const std::size_t n = around.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Side &face = sides_[around[k].second], &next = sides_[around[(k + 1) % n].second];
            // Flesh from a face that runs backward, counter-clockwise, to the next one that runs forward
            if (!face.forward && next.forward) join(face, next);
        }
    }

    int give_vertices(const std::vector<bool>& crowded) {
        const int before = mesh_.vertex_count();
        std::map<int, int> vertex_of_root;
        std::vector<bool> taken(static_cast<std::size_t>(before), false);
        std::vector<int> copied;
        for (std::size_t c = 0; c < mesh_.corner_vertex.size(); ++c) {
            int& vertex = mesh_.corner_vertex[c];
            if (!crowded[static_cast<std::size_t>(vertex)]) continue;
            const auto [entry, is_new] =
                vertex_of_root.try_emplace(root(static_cast<int>(c)), vertex);
            if (is_new && taken[static_cast<std::size_t>(vertex)]) {
                entry->second = before + static_cast<int>(copied.size());
                copied.push_back(vertex);
            }
            taken[static_cast<std::size_t>(vertex)] = true;
            vertex = entry->second;
        }
        mesh_.positions.conservativeResize(before + static_cast<long>(copied.size()), 3);
        for (std::size_t i = 0; i < copied.size(); ++i)
            mesh_.positions.row(before + static_cast<long>(i)) =
                mesh_.positions.row(copied[i]).eval();
        return static_cast<int>(copied.size());
    }

    PolygonMesh& mesh_;
    std::vector<Side> sides_;
    std::vector<int> parent_;  ///< of corners that are one vertex
};

}  // namespace

int part_sheets(PolygonMesh& mesh) { return Sheets(mesh).part(); }

}  // namespace risorius::geom
