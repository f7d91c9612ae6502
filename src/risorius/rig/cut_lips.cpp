// SPDX-License-Identifier: MIT
#include "risorius/rig/cut_lips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "risorius/rig/detail/lip_line.h"
#include "risorius/rig/detail/scan_spikes.h"

namespace risorius::rig {

namespace {

// Fraction of an edge: a cut this close to a vertex passes through the vertex
constexpr double kDegenerate = 0.12;
// Largest distance of the cut from the line of the landmarks, at atlas size
constexpr double kFromLine_m = 9e-3;
constexpr double kBehind_m = 5e-3;  // points this far behind the lips are inside the mouth
constexpr double kPi = 3.14159265358979323846;

/// A polygon of the mesh during the cut.
struct Polygon {
    std::vector<int> vertex;
    std::vector<Vec2> texcoord;  ///< empty when the mesh has no texture coordinates
    int group;
    int texture = -1;  ///< index of its picture, or -1
};

using Edge = std::pair<int, int>;
Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Takes the mesh apart, cuts it and puts it together again.
class Cut {
  public:
    Cut(const geom::PolygonMesh& mesh, const Head& head, const std::vector<int>& groups)
        : head_(head), line_(head), textured_(mesh.corner_texcoord.rows() > 0) {
        const Points laid_back = without_spikes(head, line_, laid_back_);
        for (long v = 0; v < laid_back.rows(); ++v)
            position_.push_back(laid_back.row(v).transpose());
        for (int f = 0; f < mesh.face_count(); ++f) {
            Polygon polygon{{}, {}, mesh.face_group[static_cast<std::size_t>(f)]};
            if (!mesh.face_texture.empty())
                polygon.texture = mesh.face_texture[static_cast<std::size_t>(f)];
            for (int c = mesh.face_begin[static_cast<std::size_t>(f)];
                 c < mesh.face_begin[static_cast<std::size_t>(f) + 1]; ++c) {
                polygon.vertex.push_back(mesh.corner_vertex[static_cast<std::size_t>(c)]);
                if (textured_) polygon.texcoord.push_back(mesh.corner_texcoord.row(c).transpose());
            }
            const bool skin =
                std::find(groups.begin(), groups.end(), polygon.group) != groups.end();
            is_skin_.push_back(skin && near_lips(polygon));
            polygons_.push_back(std::move(polygon));
        }
        // Vertices on both sides of a texture seam of the file are treated as one.
        for (Polygon& polygon : polygons_)
            for (int& v : polygon.vertex)
                if (head.carrier[static_cast<std::size_t>(v)] == Carrier::kSkin)
                    v = head.welded[static_cast<std::size_t>(v)];
    }

    /// Splits every polygon that the line crosses.
    void split() {
        mark_vertices_on_line();
        std::vector<Polygon> out;
        for (std::size_t f = 0; f < polygons_.size(); ++f) {
            const Polygon& polygon = polygons_[f];
            if (!is_skin_[f] || !is_crossed(polygon)) {
                out.push_back(polygon);
                continue;
            }
            for (std::size_t k = 1; k + 1 < polygon.vertex.size(); ++k)
                split_triangle(corner(polygon, 0), corner(polygon, k), corner(polygon, k + 1),
                               polygon, out);
        }
        polygons_ = std::move(out);
    }

    /// The vertices of the cut from the right to the left corner; empty when they do not form a single path.
    std::vector<int> path() const {
        std::map<int, std::set<int>> next;
        for (const Polygon& polygon : polygons_)
            for (std::size_t k = 0; k < polygon.vertex.size(); ++k) {
                const int a = polygon.vertex[k],
                          b = polygon.vertex[(k + 1) % polygon.vertex.size()];
                if (!on_line_.count(a) || !on_line_.count(b)) continue;
                next[a].insert(b);
                next[b].insert(a);
            }
        if (next.empty()) return {};
        const auto nearest_to = [&](const Vec3& corner) {
            int best = next.begin()->first;
            for (const auto& [v, others] : next)
                if ((position(v) - corner).norm() < (position(best) - corner).norm()) best = v;
            return best;
        };
        const int start = nearest_to(head_.landmark("ch_r"));
        const int goal = nearest_to(head_.landmark("ch_l"));
        // The shortest path, because vertices beside the line may also count as on it.
        std::map<int, std::pair<double, int>> way{{start, {0.0, -1}}};
        std::set<std::pair<double, int>> open{{0.0, start}};
        while (!open.empty()) {
            const auto [length, v] = *open.begin();
            open.erase(open.begin());
            if (v == goal) break;
            for (int w : next.at(v)) {
                const double longer = length + (position(v) - position(w)).norm();
                const auto known = way.find(w);
                if (known != way.end() && known->second.first <= longer) continue;
                if (known != way.end()) open.erase({known->second.first, w});
                way[w] = {longer, v};
                open.insert({longer, w});
            }
        }
        std::vector<int> out;
        if (way.count(goal))
            for (int v = goal; v >= 0; v = way.at(v).second) out.insert(out.begin(), v);
        return out;
    }

    /// Duplicates the vertices along the path for the lower lip; returns the new ones, without the corners.
    std::vector<int> part(const std::vector<int>& path) {
        std::map<int, int> below;
        std::vector<int> out;
        for (std::size_t i = 1; i + 1 < path.size(); ++i) {
            below[path[i]] = static_cast<int>(position_.size());
            out.push_back(static_cast<int>(position_.size()));
            position_.push_back(position_[static_cast<std::size_t>(path[i])]);
        }
        // The skin is wound counter-clockwise from outside, so polygons below the path run against it. Further polygons are found
        // across shared edges.
        std::set<Edge> cut;
        for (std::size_t i = 0; i + 1 < path.size(); ++i) cut.insert({path[i + 1], path[i]});
        std::map<Edge, std::size_t> beside;  // directed edges of the polygons at the path
        std::vector<std::size_t> open;
        for (std::size_t f = 0; f < polygons_.size(); ++f) {
            const std::vector<int>& vertex = polygons_[f].vertex;
            if (std::none_of(vertex.begin(), vertex.end(),
                             [&](int v) { return below.count(v) > 0; }))
                continue;
            for (std::size_t k = 0; k < vertex.size(); ++k) {
                const Edge side{vertex[k], vertex[(k + 1) % vertex.size()]};
                beside[side] = f;
                if (cut.count(side)) open.push_back(f);
            }
        }
        std::set<std::size_t> lower;
        while (!open.empty()) {
            const std::size_t f = open.back();
            open.pop_back();
            if (!lower.insert(f).second) continue;
            const std::vector<int>& vertex = polygons_[f].vertex;
            for (std::size_t k = 0; k < vertex.size(); ++k) {
                const Edge side{vertex[k], vertex[(k + 1) % vertex.size()]};
                const auto across = beside.find({side.second, side.first});
                const bool at_path = below.count(side.first) || below.count(side.second);
                if (at_path && !cut.count(side) && across != beside.end())
                    open.push_back(across->second);
            }
        }
        for (const std::size_t f : lower)
            for (int& v : polygons_[f].vertex)
                if (const auto own = below.find(v); own != below.end()) v = own->second;
        return out;
    }

    /// Adds a pocket behind the cut: narrow between the lips, wide behind them, closed at its end.
    void add_lining(const std::vector<int>& path, const std::vector<int>& lower, int group) {
        struct Row {
            double back_mm, gap_mm;
        };
        // Lips, vestibule, oral cavity; the last row is the back wall.
        static const std::array<Row, 6> kRows{
            {{3, 0.15}, {7, 0.8}, {11, 4}, {17, 8}, {26, 9}, {34, 0}}};
        const std::size_t n = path.size() - 2;
        std::vector<std::vector<int>> above(kRows.size() + 1), below(kRows.size() + 1);
        above[0].assign(path.begin() + 1, path.end() - 1);
        below[0] = lower;
        for (std::size_t r = 0; r < kRows.size(); ++r)
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3 lip = position_[static_cast<std::size_t>(path[i + 1])];
                const double s = std::clamp(line_.across(lip.x()), -1.0, 1.0);
                const double full = std::pow(std::max(0.02, std::cos(0.5 * kPi * s)), 0.6);
                const Vec3 back = lip - Vec3(0.1 * lip.x() * kRows[r].back_mm / 34, 0,
                                             head_.mm(kRows[r].back_mm) * full);
                const Vec3 gap(0, head_.mm(kRows[r].gap_mm) * full, 0);
                above[r + 1].push_back(add(back + gap));
                below[r + 1].push_back(r + 1 < kRows.size() ? add(back - gap)
                                                            : above[r + 1].back());
            }
        // Wound opposite to the skin along shared edges.
        for (std::size_t r = 0; r < kRows.size(); ++r)
            for (std::size_t i = 0; i <= n; ++i) {
                const auto at = [&](const std::vector<int>& row, std::size_t k) {
                    return k == 0 ? path.front() : k == n + 1 ? path.back() : row[k - 1];
                };
                add_face({at(above[r], i + 1), at(above[r], i), at(above[r + 1], i),
                          at(above[r + 1], i + 1)},
                         group);
                add_face({at(below[r], i), at(below[r], i + 1), at(below[r + 1], i + 1),
                          at(below[r + 1], i)},
                         group);
            }
    }

    geom::PolygonMesh mesh(const std::vector<std::string>& group_names,
                           const std::vector<geom::Texture>& textures) const {
        geom::PolygonMesh out;
        out.textures = textures;
        Points points(static_cast<long>(position_.size()), 3);
        for (std::size_t v = 0; v < position_.size(); ++v)
            points.row(static_cast<long>(v)) = position_[v].transpose();
        out.positions = head_.frame.to_mesh(points);
        out.group_names = group_names;
        std::vector<Vec2> texcoords;
        for (const Polygon& polygon : polygons_) {
            for (std::size_t k = 0; k < polygon.vertex.size(); ++k) {
                out.corner_vertex.push_back(polygon.vertex[k]);
                if (textured_)
                    texcoords.push_back(polygon.texcoord.empty() ? Vec2(0, 0)
                                                                 : polygon.texcoord[k]);
            }
            out.face_begin.push_back(static_cast<int>(out.corner_vertex.size()));
            out.face_group.push_back(polygon.group);
            if (!textures.empty()) out.face_texture.push_back(polygon.texture);
        }
        out.corner_texcoord.resize(static_cast<long>(texcoords.size()), 2);
        for (std::size_t c = 0; c < texcoords.size(); ++c)
            out.corner_texcoord.row(static_cast<long>(c)) = texcoords[c].transpose();
        return out;
    }

    const Vec3& position(int v) const { return position_[static_cast<std::size_t>(v)]; }
    int laid_back() const { return laid_back_; }

  private:
    struct Corner {
        int vertex;
        Vec2 texcoord;
    };
    Corner corner(const Polygon& polygon, std::size_t k) const {
        return {polygon.vertex[k], textured_ ? polygon.texcoord[k] : Vec2(0, 0)};
    }

    bool near_lips(const Polygon& polygon) const {
        return std::all_of(polygon.vertex.begin(), polygon.vertex.end(), [&](int v) {
            return (position(v) - line_.at(position(v).x())).norm() < head_.mm(30);
        });
    }
    double height_of(int v) const {
        const Vec3& p = position(v);
        return p.y() - line_.at(p.x()).y();
    }
    bool may_be_cut(const Vec3& p) const {
        const Vec3 off = p - line_.at(p.x());
        // The furrow between the lips may be deep, down to the teeth, so depth counts less than height.
        return line_.spans(p.x()) && std::hypot(off.y(), 0.25 * off.z()) < head_.size * kFromLine_m;
    }
    double fraction_of_edge(int a, int b) const {
        const double at_a = height_of(a), at_b = height_of(b);
        return at_a / (at_a - at_b);
    }

    void mark_vertices_on_line() {
        for (std::size_t f = 0; f < polygons_.size(); ++f) {
            if (!is_skin_[f]) continue;
            const std::vector<int>& vertex = polygons_[f].vertex;
            for (const auto& [a, b] : edges_of(vertex)) {
                if (height_of(a) * height_of(b) > 0) continue;
                const double t = fraction_of_edge(a, b);
                if (t < kDegenerate && may_be_cut(position(a))) on_line_.insert(a);
                if (t > 1 - kDegenerate && may_be_cut(position(b))) on_line_.insert(b);
            }
        }
    }

    /// The edges of a polygon, and the diagonals of its triangle fan.
    static std::vector<Edge> edges_of(const std::vector<int>& vertex) {
        std::vector<Edge> out;
        for (std::size_t k = 0; k < vertex.size(); ++k)
            out.push_back({vertex[k], vertex[(k + 1) % vertex.size()]});
        for (std::size_t k = 2; k + 1 < vertex.size(); ++k) out.push_back({vertex[0], vertex[k]});
        return out;
    }

    /// The vertex of the cut on an edge; -1 if the edge is not crossed.
    int crossing(int a, int b) {
        if (on_line_.count(a) || on_line_.count(b)) return -1;
        if (height_of(a) * height_of(b) >= 0) return -1;
        const Edge edge = edge_of(a, b);
        const auto known = crossing_.find(edge);
        if (known != crossing_.end()) return known->second;
        const double t = fraction_of_edge(edge.first, edge.second);
        const Vec3 p = (1 - t) * position(edge.first) + t * position(edge.second);
        const int v = may_be_cut(p) ? add(p) : -1;
        if (v >= 0) on_line_.insert(v);
        return crossing_[edge] = v;
    }

    bool is_crossed(const Polygon& polygon) {
        bool crossed = false;
        for (const auto& [a, b] : edges_of(polygon.vertex))
            crossed = crossing(a, b) >= 0 || crossed;
        // A diagonal connects two opposite vertices on the line.
        int on_line = 0;
        for (int v : polygon.vertex) on_line += on_line_.count(v) > 0;
        return crossed || (on_line > 1 && polygon.vertex.size() > 3);
    }

    /// `whole`: the polygon that the triangle is a part of.
    void split_triangle(const Corner& a, const Corner& b, const Corner& c, const Polygon& whole,
                        std::vector<Polygon>& out) {
        const std::array<Corner, 3> corners{a, b, c};
        const auto between = [&](const Corner& p, const Corner& q) {
            const int v = crossing(p.vertex, q.vertex);
            const double t = v < 0 ? 0 : fraction_of_edge(p.vertex, q.vertex);
            return Corner{v, (1 - t) * p.texcoord + t * q.texcoord};
        };
        std::array<Corner, 3> mid;
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            mid[k] = between(corners[k], corners[(k + 1) % 3]);
            count += mid[k].vertex >= 0;
        }
        const auto face = [&](const Corner& p, const Corner& q, const Corner& r) {
            Polygon polygon{{p.vertex, q.vertex, r.vertex}, {}, whole.group, whole.texture};
            if (textured_) polygon.texcoord = {p.texcoord, q.texcoord, r.texcoord};
            out.push_back(std::move(polygon));
        };
        if (count == 0) return face(a, b, c);
        for (int k = 0; k < 3; ++k) {
            const Corner &p = corners[k], &q = corners[(k + 1) % 3], &r = corners[(k + 2) % 3];
            if (count == 1 && mid[k].vertex >= 0) {
                face(p, mid[k], r);
                face(mid[k], q, r);
                return;
            }
            // Two edges that meet in q
            const Corner &first = mid[k], &second = mid[(k + 1) % 3];
            if (first.vertex < 0 || second.vertex < 0) continue;
            face(first, q, second);
            face(p, first, second);
            face(p, second, r);
            return;
        }
    }

    int add(const Vec3& p) {
        position_.push_back(p);
        return static_cast<int>(position_.size()) - 1;
    }
    /// Adds a quad, or a triangle where corners coincide.
    void add_face(const std::vector<int>& vertex, int group) {
        std::vector<int> own;
        for (int v : vertex)
            if (std::find(own.begin(), own.end(), v) == own.end()) own.push_back(v);
        if (own.size() < 3) return;
        polygons_.push_back({own, {}, group});
    }

    const Head& head_;
    LipLine line_;
    bool textured_;
    int laid_back_ = 0;
    std::vector<Vec3> position_;
    std::vector<Polygon> polygons_;
    std::vector<char> is_skin_;  ///< polygons that may be cut
    std::set<int> on_line_;
    std::map<Edge, int> crossing_;
};

int nearest_vertex(const Head& head, const Vec3& p) {
    int best = head.skin(0, 0);
    for (long f = 0; f < head.skin.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if ((head.vertices.row(head.skin(f, k)).transpose() - p).squaredNorm() <
                (head.vertices.row(best).transpose() - p).squaredNorm())
                best = head.skin(f, k);
    return best;
}

}  // namespace

bool lips_are_closed(const Head& head) {
    const Vec3 mouth = head.landmark("sto");
    const double half = 0.6 * std::min(head.landmark("ch_l").x(), -head.landmark("ch_r").x());
    const auto inside = [&](int v) {
        const Vec3 p = head.vertices.row(v).transpose();
        return std::abs(p.x() - mouth.x()) < half && p.z() > mouth.z() - head.size * kBehind_m &&
               p.y() < head.landmark("sn").y() && p.y() > head.landmark("sl").y() - head.mm(4);
    };
    std::map<int, std::vector<int>> next;
    for (long f = 0; f < head.skin.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = head.skin(f, k), b = head.skin(f, (k + 1) % 3);
            if (!inside(a) || !inside(b)) continue;
            next[a].push_back(b);
            next[b].push_back(a);
        }
    std::set<int> seen;
    std::vector<int> open{nearest_vertex(head, head.landmark("ls"))};
    const int goal = nearest_vertex(head, head.landmark("li"));
    while (!open.empty()) {
        const int v = open.back();
        open.pop_back();
        if (v == goal) return true;
        if (!seen.insert(v).second) continue;
        for (int w : next[v]) open.push_back(w);
    }
    return false;
}

CutLips cut_lips(const geom::PolygonMesh& mesh, const Head& head,
                 const std::vector<int>& skin_groups, const std::string& place) {
    Cut cut(mesh, head, skin_groups);
    cut.split();
    const std::vector<int> path = cut.path();
    const double width = head.landmark("ch_l").x() - head.landmark("ch_r").x();
    const double reached =
        path.size() < 3 ? 0 : cut.position(path.back()).x() - cut.position(path.front()).x();
    constexpr std::size_t kFewest = 5;
    if (path.size() < kFewest || reached < 0.7 * width)
        throw Error(place, "skin between the corners of the mouth that can be cut along the lips",
                    "a cut over " + format_number(std::round(1e3 * reached)) + " of " +
                        format_number(std::round(1e3 * width)) + " mm");
    CutLips out;
    out.laid_back = cut.laid_back();
    out.lower = cut.part(path);
    out.upper.assign(path.begin() + 1, path.end() - 1);
    std::vector<std::string> names = mesh.group_names;
    names.push_back(kLiningGroup);
    cut.add_lining(path, out.lower, static_cast<int>(names.size()) - 1);
    for (int v : path) out.seam.push_back(cut.position(v));
    const double middle = head.landmark("sto").x();
    for (std::size_t i = 0; i < out.upper.size(); ++i)
        if (std::abs(cut.position(out.upper[i]).x() - middle) <
            std::abs(cut.position(out.upper[static_cast<std::size_t>(out.middle)]).x() - middle))
            out.middle = static_cast<int>(i);
    out.mesh = cut.mesh(names, mesh.textures);
    return out;
}

}  // namespace risorius::rig
