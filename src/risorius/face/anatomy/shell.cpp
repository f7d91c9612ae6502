// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/shell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

#include "risorius/core/result_cache.h"
#include "risorius/geom/closest_point.h"
#include "risorius/geom/decimate.h"
#include "risorius/geom/mirror.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

// Lips are thin: one vertex more or less at their rims decides how they roll. So that a nose of another form, or a wider face, leaves
// them their vertices, the size of triangles about the mouth changes by steps only; the rest of the face makes up the number.
constexpr double kMouth_mm = 8, kOffMouth_mm = 16;  // from the line of the lips
constexpr double kStep = 1.0773, kSomeStep = 1.538441;

double stepped(double scale) {
    return kSomeStep * std::pow(kStep, std::round(std::log(scale / kSomeStep) / std::log(kStep)));
}

// Mean of area-weighted triangle normals around each vertex, weighted by a Gaussian of distance.
Points smooth_normals(const Points& vertices, const Triangles& triangles,
                      const std::vector<char>& wanted, double sigma) {
    struct Face {
        Vec3 centre, area_normal;
    };
    const double reach = 2.5 * sigma;
    std::map<std::array<int, 3>, std::vector<Face>> cells;
    const auto cell_of = [&](const Vec3& p) {
        return std::array<int, 3>{static_cast<int>(std::floor(p.x() / reach)),
                                  static_cast<int>(std::floor(p.y() / reach)),
                                  static_cast<int>(std::floor(p.z() / reach))};
    };
    for (long f = 0; f < triangles.rows(); ++f) {
        const Vec3 a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                   c = vertices.row(triangles(f, 2));
        const Vec3 centre = (a + b + c) / 3.0;
        cells[cell_of(centre)].push_back({centre, 0.5 * (b - a).cross(c - a)});
    }
    Points out = Points::Zero(vertices.rows(), 3);
    for (long v = 0; v < vertices.rows(); ++v) {
        if (!wanted[v]) continue;
        const Vec3 p = vertices.row(v).transpose();
        const auto home = cell_of(p);
        Vec3 sum = Vec3::Zero();
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                for (int k = -1; k <= 1; ++k) {
                    const auto found = cells.find({home[0] + i, home[1] + j, home[2] + k});
                    if (found == cells.end()) continue;
                    for (const Face& face : found->second)
                        sum += std::exp(-(face.centre - p).squaredNorm() / (2 * sigma * sigma)) *
                               face.area_normal;
                }
        if (sum.norm() > 0) out.row(v) = sum.normalized().transpose();
    }
    return out;
}

// Whether skin is a wall of a cavity, as of a nostril: across from other skin, and little of what it faces is open.
class Cavities {
  public:
    explicit Cavities(const rig::Head& head)
        : tree_(head.vertices, head.skin), across_m_(head.mm(20)) {
        // Spread evenly by the cosine law, about +z: Fibonacci's spiral
        constexpr double kGoldenAngle = 2.399963229728653;
        for (int k = 0; k < kRays; ++k) {
            const double squared = (k + 0.5) / kRays, r = std::sqrt(squared);
            rays_.push_back({r * std::cos(kGoldenAngle * k), r * std::sin(kGoldenAngle * k),
                             std::sqrt(1 - squared)});
        }
    }
    /// `normal` unit, outwards.
    bool hold(const Vec3& p, const Vec3& normal) const {
        const Vec3 origin = p + 1e-3 * across_m_ * normal;
        if (!tree_.cast(origin, normal, across_m_)) return false;
        const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u);
        int open = 0;
        for (const Vec3& ray : rays_)
            open += !tree_.cast(origin, ray.x() * u + ray.y() * w + ray.z() * normal, across_m_);
        return open < kMinOpen * kRays;
    }

  private:
    static constexpr int kRays = 64;
    static constexpr double kMinOpen = 0.35;  // at the very edge of a cavity it is a half
    geom::SurfaceTree tree_;
    double across_m_;
    std::vector<Vec3> rays_;
};

// Returns the largest connected piece of a list of triangles.
Triangles max_piece(const Triangles& triangles, long vertex_count) {
    std::vector<int> parent(static_cast<std::size_t>(vertex_count));
    for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = static_cast<int>(v);
    const auto find = [&](int v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (long f = 0; f < triangles.rows(); ++f)
        for (int k = 1; k < 3; ++k) {
            const int a = find(triangles(f, 0)), b = find(triangles(f, k));
            parent[std::max(a, b)] = std::min(a, b);
        }
    std::map<int, long> size;
    for (long f = 0; f < triangles.rows(); ++f) ++size[find(triangles(f, 0))];
    int best = -1;
    for (const auto& [root, count] : size)
        if (best < 0 || count > size[best]) best = root;
    std::vector<long> keep;
    for (long f = 0; f < triangles.rows(); ++f)
        if (find(triangles(f, 0)) == best) keep.push_back(f);
    Triangles out(static_cast<long>(keep.size()), 3);
    for (std::size_t i = 0; i < keep.size(); ++i)
        out.row(static_cast<long>(i)) = triangles.row(keep[i]);
    return out;
}

// Drops triangle fans that meet the shell in one vertex only (bow ties): their prisms would meet in a line.
Triangles without_bow_ties(const Triangles& triangles) {
    Triangles current = triangles;
    for (int pass = 0; pass < 10; ++pass) {
        std::unordered_map<int, std::vector<long>> around;
        for (long f = 0; f < current.rows(); ++f)
            for (int k = 0; k < 3; ++k) around[current(f, k)].push_back(f);
        std::set<long> drop;
        for (const auto& [v, faces] : around) {
            // Fans: faces joined by a shared edge at v.
            std::vector<int> fan(faces.size());
            for (std::size_t i = 0; i < fan.size(); ++i) fan[i] = static_cast<int>(i);
            const auto find = [&](int i) {
                while (fan[i] != i) i = fan[i];
                return i;
            };
            for (std::size_t i = 0; i < faces.size(); ++i)
                for (std::size_t j = i + 1; j < faces.size(); ++j) {
                    int shared = 0;
                    for (int a = 0; a < 3; ++a)
                        for (int b = 0; b < 3; ++b)
                            shared += current(faces[i], a) == current(faces[j], b);
                    if (shared >= 2) {
                        const int x = find(static_cast<int>(i)), y = find(static_cast<int>(j));
                        fan[std::max(x, y)] = std::min(x, y);
                    }
                }
            std::map<int, std::vector<long>> fans;
            for (std::size_t i = 0; i < faces.size(); ++i)
                fans[find(static_cast<int>(i))].push_back(faces[i]);
            if (fans.size() < 2) continue;
            std::size_t largest = 0;
            for (const auto& [root, members] : fans) largest = std::max(largest, members.size());
            bool kept = false;
            for (const auto& [root, members] : fans) {
                if (!kept && members.size() == largest) {
                    kept = true;
                    continue;
                }
                drop.insert(members.begin(), members.end());
            }
        }
        if (drop.empty()) break;
        Triangles next(current.rows() - static_cast<long>(drop.size()), 3);
        long row = 0;
        for (long f = 0; f < current.rows(); ++f)
            if (!drop.count(f)) next.row(row++) = current.row(f);
        current = next;
    }
    return current;
}

}  // namespace

std::vector<Vec3> lip_line(const rig::Head& head) {
    const auto mid = [&](const char* a, const char* b) {
        return Vec3(0.5 * (head.landmark(a) + head.landmark(b)));
    };
    return {head.landmark("ch_r"), mid("uli_r", "lli_r"), head.landmark("sto"),
            mid("uli_l", "lli_l"), head.landmark("ch_l")};
}

namespace {

// Builds a shell, step by step in the order of the public functions.
class ShellMaker {
  public:
    ShellMaker(const rig::Head& head, const std::array<EyeLids, 2>& lids)
        : head_(head),
          lids_(lids),
          lips_(lip_line(head)),
          count_(head.vertices.rows()),
          used_(static_cast<std::size_t>(count_), 0),
          border_(static_cast<std::size_t>(count_), 0),
          direction_given_(static_cast<std::size_t>(count_), 0) {}

    void choose_region();
    void find_directions();
    void make_directions_symmetric();
    void keep_what_faces_outwards();
    void set_sizes();
    void decimate(int vertices);
    Shell take() { return std::move(shell_); }

  private:
    Vec3 at(long v) const { return head_.vertices.row(v).transpose(); }
    Triangles facing_triangles() const;
    double wanted_size_mm(const Vec3& p) const;
    void number_vertices(const geom::Decimated& coarse);

    const rig::Head& head_;
    const std::array<EyeLids, 2>& lids_;
    const std::vector<Vec3> lips_;
    const long count_;                   // V
    Triangles face_ = Triangles(0, 3);   // region of the face
    std::vector<char> used_, border_;    // V, vertices of the region and of what lies next to it
    std::vector<char> direction_given_;  // V, near the mouth or an eye
    geom::MirrorPairs mirror_;           // of the region
    Triangles half_ = Triangles(0, 3);   // one side of the fine shell, if it has pairs
    Shell shell_;
};

void ShellMaker::choose_region() {
    const auto in_region = [&](const Vec3& p) {
        return p.z() > head_.mm(8) && p.y() > head_.mm(-135) && p.y() < head_.mm(112);
    };
    std::vector<char> inside(static_cast<std::size_t>(count_), 0);
    for (long v = 0; v < count_; ++v) inside[v] = in_region(at(v));
    std::vector<long> region;
    for (long f = 0; f < head_.skin.rows(); ++f) {
        const bool whole =
            inside[head_.skin(f, 0)] && inside[head_.skin(f, 1)] && inside[head_.skin(f, 2)];
        for (int k = 0; k < 3; ++k) (whole ? used_ : border_)[head_.skin(f, k)] = 1;
        if (whole) region.push_back(f);
    }
    face_.resize(static_cast<long>(region.size()), 3);
    for (std::size_t i = 0; i < region.size(); ++i)
        face_.row(static_cast<long>(i)) = head_.skin.row(region[i]);
}

// Computes the smooth outward direction. At mouth and eyes, where skin folds inwards, it is given.
void ShellMaker::find_directions() {
    shell_.direction = smooth_normals(head_.vertices, head_.skin, used_, head_.mm(7));
    for (long v = 0; v < count_; ++v) {
        if (!used_[v]) continue;
        const Vec3 p = at(v);
        Vec3 d = shell_.direction.row(v).transpose();
        const double from_mouth = geom::distance_to_polyline(p, lips_);
        const Vec3 out_of_mouth = Vec3(0.035 * p.x() / head_.mm(1), 0, 1).normalized();
        const double mouth = 1.0 - geom::smoothstep(head_.mm(6), head_.mm(18), from_mouth);
        d = ((1 - mouth) * d + mouth * out_of_mouth).normalized();
        double given = mouth;
        for (const EyeLids& lid : lids_) {
            const Vec3 r = p - lid.centre();
            const double eye =
                1.0 - geom::smoothstep(lid.zone_m(), lid.zone_m() + head_.mm(6.5), r.norm());
            d = ((1 - eye) * d + eye * r.normalized()).normalized();
            given = std::max(given, eye);
        }
        direction_given_[v] = given > 0.5;
        shell_.direction.row(v) = d.transpose();
    }
}

// A head with vertices in pairs gets a shell that is its own mirror image.
void ShellMaker::make_directions_symmetric() {
    mirror_ = geom::find_mirror_pairs(face_, head_.vertices, Vec3::UnitX(), 0.0);
    if (!mirror_.found()) return;
    for (long v = 0; v < count_; ++v) {
        if (!used_[v] || mirror_.side(static_cast<int>(v), head_.vertices) < 0) continue;
        const Vec3 here = shell_.direction.row(v).transpose(),
                   there = shell_.direction.row(mirror_.partner[v]).transpose();
        const Vec3 d = (here + mirror_.reflect(there)).normalized();
        shell_.direction.row(v) = d.transpose();
        shell_.direction.row(mirror_.partner[v]) = mirror_.reflect(d).transpose();
    }
}

// Drops triangles that face away from the direction, and the walls of nostrils: tissue under those would bind the wing of the nose to the
// septum and leave no depth for either.
Triangles ShellMaker::facing_triangles() const {
    constexpr double kMinFacing = 0.12;
    const Cavities cavities(head_);
    Triangles facing(face_.rows(), 3);
    long rows = 0;
    for (long f = 0; f < face_.rows(); ++f) {
        const int a = face_(f, 0), b = face_(f, 1), c = face_(f, 2);
        const Vec3 pa = at(a), pb = at(b), pc = at(c);
        const Vec3 n = (pb - pa).cross(pc - pa).normalized();
        const Vec3 d = (shell_.direction.row(a) + shell_.direction.row(b) + shell_.direction.row(c))
                           .transpose()
                           .normalized();
        if (n.dot(d) < kMinFacing) continue;
        const bool given = direction_given_[a] && direction_given_[b] && direction_given_[c];
        if (!given && cavities.hold((pa + pb + pc) / 3, n)) continue;
        facing.row(rows++) = face_.row(f);
    }
    facing.conservativeResize(rows, 3);
    return facing;
}

void ShellMaker::keep_what_faces_outwards() {
    const Triangles facing = facing_triangles();
    if (!mirror_.found()) {
        shell_.fine = max_piece(without_bow_ties(facing), count_);
        return;
    }
    // Dropping a fan may isolate others
    half_ = geom::first_half(facing, head_.vertices, mirror_);
    for (long before = -1; half_.rows() != before;) {
        before = half_.rows();
        const Triangles whole = geom::with_mirror_image(half_, mirror_);
        half_ =
            geom::paired_half(max_piece(without_bow_ties(whole), count_), head_.vertices, mirror_);
    }
    shell_.fine = geom::with_mirror_image(half_, mirror_);
}

// Size field: fine at lips and lids, coarse on forehead and cheek.
double ShellMaker::wanted_size_mm(const Vec3& p) const {
    double near = geom::distance_to_polyline(p, lips_);
    for (const EyeLids& lid : lids_) near = std::min(near, lid.margin_distance(p));
    for (const char* nose : {"sn", "ac_l", "ac_r"})
        near = std::min(near, (p - head_.landmark(nose)).norm() + head_.mm(4));
    return 2.6 + 6.0 * geom::smoothstep(head_.mm(3), head_.mm(48), near);
}

void ShellMaker::set_sizes() {
    shell_.spacing_m.assign(static_cast<std::size_t>(count_), 0);
    for (long v = 0; v < count_; ++v)
        if (used_[v]) shell_.spacing_m[v] = head_.mm(wanted_size_mm(at(v)));
}

// Scales the size field until the wanted number of vertices is left; that of the mouth in steps.
void ShellMaker::decimate(int vertices) {
    std::vector<double> off_mouth(static_cast<std::size_t>(count_), 1.0);
    for (long v = 0; v < count_; ++v)
        if (used_[v])
            off_mouth[v] = geom::smoothstep(head_.mm(kMouth_mm), head_.mm(kOffMouth_mm),
                                            geom::distance_to_polyline(at(v), lips_));
    geom::Decimated coarse;
    double low = 0.15, high = 4.0;
    std::vector<double> length(static_cast<std::size_t>(count_));
    for (int attempt = 0; attempt < 12; ++attempt) {
        const double scale = std::sqrt(low * high), of_mouth = stepped(scale);
        for (long v = 0; v < count_; ++v)
            length[v] = (of_mouth + off_mouth[v] * (scale - of_mouth)) * shell_.spacing_m[v];
        coarse = mirror_.found() ? geom::decimate_mirrored(half_, head_.vertices, length, mirror_)
                                 : geom::decimate(shell_.fine, head_.vertices, length, {});
        const int kept = static_cast<int>(coarse.kept.size());
        if (std::abs(kept - vertices) < vertices / 100) break;
        (kept > vertices ? low : high) = scale;
    }
    shell_.spacing_m = std::move(length);
    number_vertices(coarse);
}

void ShellMaker::number_vertices(const geom::Decimated& coarse) {
    shell_.vertex = coarse.kept;
    std::vector<int> index(static_cast<std::size_t>(count_), -1);
    for (std::size_t i = 0; i < coarse.kept.size(); ++i)
        index[coarse.kept[i]] = static_cast<int>(i);
    shell_.triangles = coarse.triangles;
    for (long f = 0; f < shell_.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) shell_.triangles(f, k) = index[coarse.triangles(f, k)];
    shell_.collapsed_to.assign(static_cast<std::size_t>(count_), -1);
    for (long v = 0; v < count_; ++v)
        if (coarse.collapsed_to[v] >= 0) shell_.collapsed_to[v] = index[coarse.collapsed_to[v]];
    for (int v : shell_.vertex) {
        shell_.fixed.push_back(border_[v]);
        if (mirror_.found()) shell_.mirrored.push_back(index[mirror_.partner[v]]);
    }
}

// The bindings name all members of a head, so that a new one does not compile until it is added here or left out on purpose. Those left out
// are not read by ShellMaker.
std::string key_of(const rig::Head& head, const std::array<EyeLids, 2>& lids,
                   const ShellOptions& options) {
    CacheKey key("face/anatomy/shell");
    const auto& [frame, size, vertices, carrier, jaw_fraction, role_of_group, skin, lining, welded,
                 landmarks, warped_landmarks, eyes, teeth_front_m, has_teeth] = head;
    key.add(size).add(vertices).add(carrier).add(skin).add(lining).add(welded);
    for (const auto& [id, place] : landmarks) key.add(id).add(place);
    key.add(teeth_front_m).add(has_teeth);
    for (const EyeLids& lid : lids) {
        key.add(lid.centre()).add(lid.zone_m());
        for (const std::vector<Vec3>* margin : {&lid.upper_margin(), &lid.lower_margin()})
            for (const Vec3& p : *margin) key.add(p);
    }
    return key.add(options.vertices).finish();
}

}  // namespace

Shell build_shell(const rig::Head& head, const Jaw& jaw, const std::array<EyeLids, 2>& lids,
                  const ShellOptions& options) {
    Shell shell = cached_result(
        key_of(head, lids, options),
        [&] {
            ShellMaker maker(head, lids);
            maker.choose_region();
            maker.find_directions();
            maker.make_directions_symmetric();
            maker.keep_what_faces_outwards();
            maker.set_sizes();
            maker.decimate(options.vertices);
            return maker.take();
        },
        [](Shell& of, const auto& visit) {
            auto& [fine, direction, vertex, triangles, collapsed_to, fixed, spacing_m, over_bite_m,
                   mirrored] = of;
            visit(fine);
            visit(direction);
            visit(vertex);
            visit(triangles);
            visit(collapsed_to);
            visit(fixed);
            visit(spacing_m);
            visit(over_bite_m);
            visit(mirrored);
        });
    shell.over_bite_m = bite_heights(head, jaw, shell);
    return shell;
}

Shell without_vertices(const Shell& shell, const rig::Head& head, const std::vector<char>& gone) {
    const int count = static_cast<int>(shell.vertex.size());
    const auto stays = [&](long f) {
        return !gone[shell.triangles(f, 0)] && !gone[shell.triangles(f, 1)] &&
               !gone[shell.triangles(f, 2)];
    };
    std::vector<char> held(static_cast<std::size_t>(count), 0);
    for (long f = 0; f < shell.triangles.rows(); ++f)
        if (stays(f))
            for (int k = 0; k < 3; ++k) held[shell.triangles(f, k)] = 1;
    std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(count));
    for (long f = 0; f < shell.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            for (int step : {1, 2})
                neighbours[shell.triangles(f, k)].push_back(shell.triangles(f, (k + step) % 3));

    Shell out = shell;
    out.vertex.clear();
    out.fixed.clear();
    out.over_bite_m.clear();
    out.mirrored.clear();
    std::vector<int> index(static_cast<std::size_t>(count), -1);
    for (int v = 0; v < count; ++v) {
        if (!held[v]) continue;
        index[v] = static_cast<int>(out.vertex.size());
        out.vertex.push_back(shell.vertex[v]);
        out.fixed.push_back(shell.fixed[v]);
        out.over_bite_m.push_back(shell.over_bite_m[v]);
    }
    if (!shell.mirrored.empty())
        for (int v = 0; v < count; ++v)
            if (held[v]) out.mirrored.push_back(index[shell.mirrored[v]]);
    const auto nearest = [&](int v) {
        double min = std::numeric_limits<double>::infinity();
        int best = -1;
        for (int w : neighbours[v]) {
            const double squared =
                (head.vertices.row(shell.vertex[w]) - head.vertices.row(shell.vertex[v]))
                    .squaredNorm();
            if (!held[w] || squared >= min) continue;
            min = squared;
            best = w;
        }
        return best;
    };
    std::vector<int> home = index;
    for (int v = 0; v < count; ++v)
        if (const int w = held[v] ? -1 : nearest(v); w >= 0) home[v] = index[w];
    for (int& to : out.collapsed_to)
        if (to >= 0) to = home[to];
    long rows = 0;
    for (long f = 0; f < shell.triangles.rows(); ++f) {
        if (!stays(f)) continue;
        for (int k = 0; k < 3; ++k) out.triangles(rows, k) = index[shell.triangles(f, k)];
        ++rows;
    }
    out.triangles.conservativeResize(rows, 3);
    return out;
}

}  // namespace risorius::face
