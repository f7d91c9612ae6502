// SPDX-License-Identifier: MIT
// Nasal wing with nostril, and ear: lofts through the edge loops of the design tables.
#include <algorithm>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/headmodel/detail/skin.h"

namespace risorius::headmodel {
namespace {

std::vector<Vec3> loop_points(const std::map<std::string, std::vector<LoopPoint>>& loops,
                              const std::string& name, int count,
                              const std::function<double(double)>& place) {
    const auto found = loops.find(name);
    if (found == loops.end()) throw Error("design loops", "a loop named " + name, "none");
    std::vector<std::pair<double, Vec3>> through;
    for (const LoopPoint& p : found->second)
        through.emplace_back(std::fmod(place(p.place), count), p.point);
    std::rotate(through.begin(),
                std::min_element(through.begin(), through.end(),
                                 [](const auto& a, const auto& b) { return a.first < b.first; }),
                through.end());
    return curve_points(through, count, true);
}

/// What ridges and pits add at a place of the plane of the ear: outwards, and backwards where one overhangs.
Vec3 ear_relief(const std::map<std::string, std::vector<ReliefPoint>>& features, const Vec3& p) {
    constexpr double kSharpness = 3;  // of the joint where two ridges meet
    double ridges = 0, pits = 0, lean = 0;
    for (const auto& [name, line] : features) {
        double max = 0, leaning = 0;
        for (std::size_t k = 0; k + 1 < std::max<std::size_t>(line.size(), 2); ++k) {
            const ReliefPoint &a = line[k], &b = line[std::min(k + 1, line.size() - 1)];
            const Vec2 along = b.place - a.place, from = p.head<2>() - a.place;
            const double length = along.squaredNorm();
            const double t = length > 0 ? std::clamp(from.dot(along) / length, 0.0, 1.0) : 0.0;
            const double width = a.width_mm + t * (b.width_mm - a.width_mm),
                         height = a.height_mm + t * (b.height_mm - a.height_mm);
            const double fraction = std::exp(-(from - t * along).squaredNorm() / (width * width));
            if (std::abs(height * fraction) <= std::abs(max)) continue;
            max = height * fraction;
            leaning = fraction * (a.lean_mm + t * (b.lean_mm - a.lean_mm));
        }
        (max > 0 ? ridges : pits) += std::pow(std::abs(max), kSharpness);
        lean += leaning;
    }
    return {lean, 0, std::pow(ridges, 1 / kSharpness) - std::pow(pits, 1 / kSharpness)};
}

}  // namespace

void add_nasal_wing(Skin& skin, const std::vector<int>& block, const DesignTables& tables) {
    constexpr int kRows = 10, kAcross = 6, kRing = 2 * (kRows + kAcross);
    HalfMesh& mesh = skin.mesh;
    const auto named = [&](const char* name) {
        return loop_points(tables.nose_loops, name, kRing, [](double p) { return p; });
    };
    const std::vector<Vec3> crease = named("crease"), wing = named("wing"), under = named("under"),
                            edge = named("edge"), rim = named("rim");
    std::vector<int> previous = block;
    const auto ring = [&](const std::vector<Vec3>& points, Hold hold) {
        std::vector<int> ids;
        for (const Vec3& p : points) ids.push_back(mesh.add(p, hold));
        mesh.bridge(previous, ids, true);
        previous = ids;
    };
    const auto between = [&](const std::vector<Vec3>& before, const std::vector<Vec3>& a,
                             const std::vector<Vec3>& b, const std::vector<Vec3>& after) {
        std::vector<Vec3> points;
        for (int k = 0; k < kRing; ++k)
            points.push_back((9 * (a[k] + b[k]) - before[k] - after[k]) / 16);
        return points;
    };
    std::vector<Vec3> halfway;
    for (int k = 0; k < kRing; ++k)
        halfway.push_back(0.5 * (mesh.point[static_cast<std::size_t>(block[k])] + crease[k]));
    ring(halfway, Hold::kSmooth);
    // Beside the wing it is cheek and lip, which are hollow there.
    for (int k = kRows + 2; k < kRing - 2; ++k)
        mesh.hold[mesh.hold.size() - kRing + k] = Hold::kOnHead;
    ring(crease, Hold::kPinned);
    ring(between(halfway, crease, wing, under), Hold::kSmooth);
    ring(wing, Hold::kPinned);
    ring(between(crease, wing, under, edge), Hold::kSmooth);
    ring(under, Hold::kPinned);
    ring(edge, Hold::kPinned);
    ring(rim, Hold::kPinned);
    const std::size_t inner = mesh.point.size() - kRing;
    // Deep enough that who looks in looks into the dark
    mesh.adding = Region::kNostril;
    const std::vector<Vec3> vestibule = named("vestibule"), depth = named("depth");
    ring(between(edge, rim, vestibule, depth), Hold::kPinned);
    ring(vestibule, Hold::kPinned);
    std::vector<Vec3> halfway_in, end;
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : depth) centre += p / kRing;
    for (int k = 0; k < kRing; ++k) {
        halfway_in.push_back(0.5 * (vestibule[k] + depth[k]));
        end.push_back(centre + 0.6 * (depth[k] - centre) + 0.4 * (depth[k] - vestibule[k]));
    }
    ring(halfway_in, Hold::kPinned);
    ring(depth, Hold::kPinned);
    ring(end, Hold::kPinned);
    mesh.fill(previous, kRows, kAcross, Hold::kPinned);
    for (std::size_t v = inner; v < mesh.point.size(); ++v)
        skin.fixed.push_back(static_cast<int>(v));
}

void add_ear(Skin& skin, const std::vector<int>& block, const DesignTables& tables,
             const HeadSurface& head) {
    constexpr int kRows = 22, kAcross = 6, kRing = 2 * (kRows + kAcross);
    HalfMesh& mesh = skin.mesh;
    // The tables count 36 places, 12 along each long side. The mesh has its 56 where the outline is long or bends: along the front,
    // around the lobe, up the back, over the top. They begin after the corner of the block, so that none turns far.
    constexpr double kFront = 15, kLobe = 10, kBack = 18, kTop = kRing - kFront - kLobe - kBack,
                     kBegin = 3;
    const auto place = [](double p) {
        if (p <= 12) return kBegin + p * kFront / 12;
        if (p <= 18) return kBegin + kFront + (p - 12) * kLobe / 6;
        if (p <= 30) return kBegin + kFront + kLobe + (p - 18) * kBack / 12;
        return kBegin + kFront + kLobe + kBack + (p - 30) * kTop / 6;
    };
    const Vec3 origin(71, -2, -7);
    const Vec3 up = Vec3(0.05, 0.985, -0.16).normalized();
    const Vec3 back = (Vec3(0.42, 0, -0.907) - up * up.dot(Vec3(0.42, 0, -0.907))).normalized();
    const Vec3 out = back.cross(up);
    const auto in_space = [&](const Vec3& p) {
        return Vec3(origin + back * p.x() + up * p.y() + out * p.z());
    };
    const auto in_frame = [&](const Vec3& p) {
        const Vec3 d = p - origin;
        return Vec3(d.dot(back), d.dot(up), d.dot(out));
    };
    const auto named = [&](const char* name) {
        return loop_points(tables.ear_loops, name, kRing, place);
    };
    // Square to the plane of the ear, which the rays of the head surface are not
    const auto on_head = [&](const Vec3& flat) {
        Vec3 p = in_space(flat);
        for (int k = 0; k < 20; ++k) p += out * (head.project(p) - p).dot(out);
        return in_frame(p);
    };
    // In front the ear grows out of the cheek: there its first loops lie on the head.
    const auto attached = [&](int k) {
        const double from = place(1.2), to = place(12.6);
        constexpr double kSoft = 2;
        return std::clamp(std::min(k - from, to - k) / kSoft, 0.0, 1.0);
    };
    std::vector<Vec3> behind = named("behind"), edge = named("outline");
    const std::vector<Vec3> inner = named("inner");
    for (int k = 0; k < kRing; ++k) {
        behind[k] = on_head(behind[k]);
        edge[k] += attached(k) * (on_head(edge[k]) - edge[k]);
    }

    std::vector<int> previous = block;
    const auto ring = [&](const std::function<Vec3(int)>& at, Hold hold) {
        std::vector<int> ids;
        for (int k = 0; k < kRing; ++k) ids.push_back(mesh.add(at(k), hold));
        mesh.bridge(previous, ids, true);
        previous = ids;
    };
    ring(
        [&](int k) {
            return Vec3(0.5 *
                        (mesh.point[static_cast<std::size_t>(block[k])] + in_space(behind[k])));
        },
        Hold::kSmooth);
    ring([&](int k) { return in_space(behind[k]); }, Hold::kPinned);
    mesh.adding = Region::kEar;
    // The back of the auricle, up to the rounded edge of the helix
    const auto rear = [&](int k, double inwards, double deeper) {
        const Vec3 to_inner = (inner[k] - edge[k]).cwiseProduct(Vec3(1, 1, 0)).normalized();
        const double fraction = 1 - attached(k);
        Vec3 free = edge[k] + fraction * (inwards * to_inner - Vec3(0, 0, deeper));
        constexpr double kClear = 0.8;  // of the head
        free.z() = std::min(std::max(free.z(), on_head(free).z() + kClear), edge[k].z() - 0.2);
        const Vec3 bound = behind[k] + (edge[k] - behind[k]) * (1 - inwards / 6);
        return Vec3(free + attached(k) * (bound - free));
    };
    ring([&](int k) { return in_space(0.45 * behind[k] + 0.55 * rear(k, 2.2, 3.6)); },
         Hold::kSmooth);
    ring([&](int k) { return in_space(rear(k, 1.6, 3.2)); }, Hold::kPinned);
    ring([&](int k) { return in_space(rear(k, 0.3, 1.7)); }, Hold::kPinned);
    // The front is a relief over the plane of the ear: laid out flat first, then raised by its ridges and pits.
    const std::size_t first = mesh.point.size();
    for (const double f : {0.0, 0.07, 0.15, 0.24, 0.34, 0.45, 0.56, 0.67, 0.78, 0.89, 1.0})
        ring([&](int k) { return Vec3(edge[k] + f * (inner[k] - edge[k])); }, Hold::kPinned);
    mesh.fill(previous, kRows, kAcross, Hold::kPinned);
    for (std::size_t v = first; v < mesh.point.size(); ++v) {
        const auto ring_of = (v - first) / kRing;
        const double fraction = ring_of > 2 ? 1.0 : static_cast<double>(ring_of) / 3.0;
        const int k = static_cast<int>((v - first) % kRing);
        // Nothing is raised where the edge lies on the cheek.
        const double rise = ring_of > 2 ? 1.0 : 1 - attached(k) * (1 - fraction);
        mesh.point[v] =
            in_space(mesh.point[v] + rise * ear_relief(tables.ear_relief, mesh.point[v]));
    }
    // What is finer than the mesh would show as facets.
    std::vector<double> fraction(mesh.point.size(), 0.0);
    for (std::size_t v = first; v < mesh.point.size(); ++v) fraction[v] = 1;
    mesh.smooth(3, fraction);
}

}  // namespace risorius::headmodel
