// SPDX-License-Identifier: MIT
#include "risorius/geom/repair_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "risorius/geom/mesh_groups.h"

namespace risorius::geom {
namespace {

class Repairer {
  public:
    Repairer(PolygonMesh& mesh, const RepairOptions& options) : mesh_(mesh), options_(options) {}

    std::vector<std::string> repair() {
        list_once();
        drop_faces([this](int face) { return collapsed(face); },
                   "had less than three corners, a vertex twice or no area");
        std::set<std::vector<int>> seen;
        drop_faces([&](int face) { return !seen.insert(sorted_vertices(face)).second; },
                   "had the vertices of another one");
        drop_crowd();
        drop_loose_bits();
        turn_faces();
        return std::move(done_);
    }

  private:
    struct Side {
        int low, high, face;
        bool forward;
    };
    struct Neighbour {
        int face;
        bool flipped;  ///< runs along the common edge the same way
    };

    bool is_wanted(int face) const {
        return options_.groups.empty() ||
               std::find(options_.groups.begin(), options_.groups.end(),
                         mesh_.face_group[static_cast<std::size_t>(face)]) != options_.groups.end();
    }
    int vertex(int corner) const { return mesh_.corner_vertex[static_cast<std::size_t>(corner)]; }
    int first(int face) const { return mesh_.face_begin[static_cast<std::size_t>(face)]; }
    Vec3 position(int v) const { return mesh_.positions.row(v).transpose(); }

    std::vector<int> sorted_vertices(int face) const {
        std::vector<int> out(mesh_.corner_vertex.begin() + first(face),
                             mesh_.corner_vertex.begin() + first(face + 1));
        std::sort(out.begin(), out.end());
        return out;
    }

    double area_m2(int face) const {
        Vec3 doubled = Vec3::Zero();
        const Vec3 a = position(vertex(first(face)));
        for (int c = first(face) + 1; c + 1 < first(face + 1); ++c)
            doubled += (position(vertex(c)) - a).cross(position(vertex(c + 1)) - a);
        return 0.5 * doubled.norm() * options_.metres_per_unit * options_.metres_per_unit;
    }

    bool collapsed(int face) const {
        const std::vector<int> sorted = sorted_vertices(face);
        return sorted.size() < 3 ||
               std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end() ||
               !(area_m2(face) > options_.smallest_face_area_m2);
    }

    /// A vertex that follows itself in a face is listed once, where three others remain.
    void list_once() {
        std::vector<int> begin{0}, corners, kept;
        int count = 0;
        for (int f = 0; f < mesh_.face_count(); ++f) {
            std::vector<int> own;
            for (int c = first(f); c < first(f + 1); ++c) {
                const int next = c + 1 < first(f + 1) ? c + 1 : first(f);
                if (vertex(c) != vertex(next)) own.push_back(c);
            }
            const bool shorter = is_wanted(f) && own.size() >= 3 &&
                                 static_cast<int>(own.size()) < mesh_.corner_count(f);
            count += shorter ? 1 : 0;
            for (int c = first(f); c < first(f + 1); ++c)
                if (!shorter || std::find(own.begin(), own.end(), c) != own.end())
                    kept.push_back(c);
            begin.push_back(static_cast<int>(kept.size()));
        }
        if (count == 0) return;
        for (const int c : kept) corners.push_back(vertex(c));
        if (mesh_.corner_texcoord.rows() > 0)
            mesh_.corner_texcoord = TexCoords(mesh_.corner_texcoord(kept, Eigen::all));
        mesh_.face_begin = std::move(begin);
        mesh_.corner_vertex = std::move(corners);
        say(count, "freed of a vertex that followed itself");
    }

    /// Takes out the faces for which `is_wrong` says so.
    template <typename Test>
    void drop_faces(const Test& is_wrong, const std::string& why) {
        std::vector<bool> kept(static_cast<std::size_t>(mesh_.face_count()), true);
        int dropped = 0;
        for (int f = 0; f < mesh_.face_count(); ++f)
            if (is_wanted(f) && is_wrong(f)) {
                kept[static_cast<std::size_t>(f)] = false;
                ++dropped;
            }
        if (dropped == 0) return;
        keep_faces(mesh_, kept);
        say(dropped, "taken out: " + std::string(dropped == 1 ? "it " : "they ") + why);
    }
    void say(int count, const std::string& what) {
        done_.push_back((count == 1 ? "one face was " : std::to_string(count) + " faces were ") +
                        what);
    }

    std::vector<Side> sides() const {
        std::vector<Side> out;
        for (int f = 0; f < mesh_.face_count(); ++f) {
            if (!is_wanted(f)) continue;
            for (int c = first(f); c < first(f + 1); ++c) {
                const int a = vertex(c), b = vertex(c + 1 < first(f + 1) ? c + 1 : first(f));
                out.push_back({std::min(a, b), std::max(a, b), f, a < b});
            }
        }
        std::stable_sort(out.begin(), out.end(), [](const Side& a, const Side& b) {
            return std::pair(a.low, a.high) < std::pair(b.low, b.high);
        });
        return out;
    }

    /// Calls `at` with each run of sides at one edge.
    template <typename Call>
    static void for_each_edge(const std::vector<Side>& all, const Call& at) {
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            while (end < all.size() && all[end].low == all[begin].low &&
                   all[end].high == all[begin].high)
                ++end;
            at(begin, end);
        }
    }

    /// Faces across the edges of each face that have just two.
    std::vector<std::vector<Neighbour>> neighbours() const {
        std::vector<std::vector<Neighbour>> out(static_cast<std::size_t>(mesh_.face_count()));
        const std::vector<Side> all = sides();
        for_each_edge(all, [&](std::size_t begin, std::size_t end) {
            if (end - begin != 2) return;
            const Side &a = all[begin], &b = all[begin + 1];
            out[static_cast<std::size_t>(a.face)].push_back({b.face, a.forward == b.forward});
            out[static_cast<std::size_t>(b.face)].push_back({a.face, a.forward == b.forward});
        });
        return out;
    }

    /// The piece of each face, -1 for faces that are not mended; and the faces in each piece.
    std::vector<int> pieces(std::vector<std::vector<int>>& faces_of) const {
        const auto beside = neighbours();
        std::vector<int> piece(beside.size(), -1);
        for (int f = 0; f < mesh_.face_count(); ++f) {
            if (!is_wanted(f) || piece[static_cast<std::size_t>(f)] >= 0) continue;
            const int number = static_cast<int>(faces_of.size());
            std::vector<int> open{f};
            piece[static_cast<std::size_t>(f)] = number;
            for (std::size_t i = 0; i < open.size(); ++i)
                for (const Neighbour& next : beside[static_cast<std::size_t>(open[i])])
                    if (int& other = piece[static_cast<std::size_t>(next.face)]; other < 0) {
                        other = number;
                        open.push_back(next.face);
                    }
            faces_of.push_back(std::move(open));
        }
        return piece;
    }

    void drop_crowd() {
        std::vector<std::vector<int>> faces_of;
        const std::vector<int> piece = pieces(faces_of);
        const std::vector<Side> all = sides();
        std::set<int> dropped;
        for_each_edge(all, [&](std::size_t begin, std::size_t end) {
            if (end - begin < 3) return;
            std::vector<int> faces;
            for (std::size_t i = begin; i < end; ++i)
                if (!dropped.count(all[i].face)) faces.push_back(all[i].face);
            const auto size_of = [&](int face) {
                return faces_of[static_cast<std::size_t>(piece[static_cast<std::size_t>(face)])]
                    .size();
            };
            std::stable_sort(faces.begin(), faces.end(), [&](int a, int b) {
                return std::pair(size_of(a), area_m2(a)) > std::pair(size_of(b), area_m2(b));
            });
            for (std::size_t i = 2; i < faces.size(); ++i) dropped.insert(faces[i]);
        });
        drop_faces([&](int face) { return dropped.count(face) > 0; },
                   "met an edge where two others meet");
    }

    void drop_loose_bits() {
        std::vector<std::vector<int>> faces_of;
        const std::vector<int> piece = pieces(faces_of);
        std::size_t largest = 0;
        for (const auto& faces : faces_of) largest = std::max(largest, faces.size());
        drop_faces(
            [&](int face) {
                const auto& own =
                    faces_of[static_cast<std::size_t>(piece[static_cast<std::size_t>(face)])];
                return static_cast<double>(own.size()) <
                       options_.loose_bit * static_cast<double>(largest);
            },
            "lay loose beside the surface");
    }

    /// Six times the volume between a face and a point.
    double volume(int face, const Vec3& middle) const {
        double sum = 0;
        const Vec3 a = position(vertex(first(face))) - middle;
        for (int c = first(face) + 1; c + 1 < first(face + 1); ++c)
            sum += a.dot((position(vertex(c)) - middle).cross(position(vertex(c + 1)) - middle));
        return sum;
    }

    /// Whether a piece faces inwards once its faces are turned. For a small open piece, such as one between seams, its shape does
    /// not tell; there most of its faces decide.
    bool faces_inwards(const std::vector<int>& faces, const std::vector<int>& turned,
                       const std::vector<std::vector<Neighbour>>& beside) const {
        Vec3 low = position(vertex(first(faces[0]))), high = low;
        bool closed = true;
        std::size_t to_turn = 0;
        for (const int face : faces) {
            const auto f = static_cast<std::size_t>(face);
            closed = closed && static_cast<int>(beside[f].size()) == mesh_.corner_count(face);
            to_turn += turned[f] == 1 ? 1U : 0U;
            for (int c = first(face); c < first(face + 1); ++c) {
                low = low.cwiseMin(position(vertex(c)));
                high = high.cwiseMax(position(vertex(c)));
            }
        }
        if (!closed && 2 * faces.size() < turned.size()) return 2 * to_turn > faces.size();
        double enclosed = 0;
        for (const int face : faces)
            enclosed += volume(face, 0.5 * (low + high)) *
                        (turned[static_cast<std::size_t>(face)] == 1 ? -1 : 1);
        return enclosed < 0;
    }

    void turn_faces() {
        const auto beside = neighbours();
        std::vector<int> turned(beside.size(),
                                -1);  // 1: to be turned, as seen from the first face of its piece
        int count = 0;
        for (int f = 0; f < mesh_.face_count(); ++f) {
            if (!is_wanted(f) || turned[static_cast<std::size_t>(f)] >= 0) continue;
            std::vector<int> faces{f};
            turned[static_cast<std::size_t>(f)] = 0;
            for (std::size_t i = 0; i < faces.size(); ++i)
                for (const Neighbour& next : beside[static_cast<std::size_t>(faces[i])])
                    if (int& other = turned[static_cast<std::size_t>(next.face)]; other < 0) {
                        other = turned[static_cast<std::size_t>(faces[i])] ^ (next.flipped ? 1 : 0);
                        faces.push_back(next.face);
                    }
            const bool inwards = faces_inwards(faces, turned, beside);
            for (const int face : faces) {
                if ((turned[static_cast<std::size_t>(face)] == 1) == inwards) continue;
                turn(face);
                ++count;
            }
        }
        if (count > 0) say(count, "turned to face as its neighbours do, or outwards");
    }

    void turn(int face) {
        std::reverse(mesh_.corner_vertex.begin() + first(face),
                     mesh_.corner_vertex.begin() + first(face + 1));
        if (mesh_.corner_texcoord.rows() == 0) return;
        for (int a = first(face), b = first(face + 1) - 1; a < b; ++a, --b)
            mesh_.corner_texcoord.row(a).swap(mesh_.corner_texcoord.row(b));
    }

    PolygonMesh& mesh_;
    const RepairOptions& options_;
    std::vector<std::string> done_;
};

}  // namespace

std::vector<std::string> repair_mesh(PolygonMesh& mesh, const RepairOptions& options) {
    return Repairer(mesh, options).repair();
}

}  // namespace risorius::geom
