// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/mouth_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include "risorius/geom/plane_section.h"

namespace risorius::talk {

namespace {

/// How far the surface of a lip reaches from its landmark, mm, along the surface.
constexpr double kLipReach_mm = 26;
constexpr double kMiddle_mm[] = {-3, 0, 3}, kSides_mm[] = {-9, 9};
constexpr double kSpan_mm = 12;  // half the width in which area and contact are measured
constexpr int kSections = 13;
constexpr double kContact_mm = 0.3;
constexpr double kIncisors_mm[] = {-3, 0, 3};

struct Neighbour {
    int vertex;
    double length;
};

/// Distances along edges from one vertex, up to a limit.
std::map<int, double> distances(const std::vector<std::vector<Neighbour>>& edges, int from,
                                double limit) {
    std::map<int, double> out;
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        next;
    next.push({0, from});
    while (!next.empty()) {
        const auto [length, vertex] = next.top();
        next.pop();
        if (out.contains(vertex)) continue;
        out[vertex] = length;
        for (const Neighbour& one : edges[static_cast<std::size_t>(vertex)])
            if (length + one.length < limit) next.push({length + one.length, one.vertex});
    }
    return out;
}

/// Least distance of two segments that do not cross; 0 when they do.
double distance(const std::pair<Vec2, Vec2>& one, const std::pair<Vec2, Vec2>& two) {
    const auto to_segment = [](const Vec2& p, const Vec2& a, const Vec2& b) {
        const Vec2 d = b - a;
        const double squared = d.squaredNorm();
        const double s = squared > 0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
        return (a + s * d - p).norm();
    };
    const auto side = [](const Vec2& a, const Vec2& b, const Vec2& p) {
        return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x();
    };
    if (side(one.first, one.second, two.first) * side(one.first, one.second, two.second) < 0 &&
        side(two.first, two.second, one.first) * side(two.first, two.second, one.second) < 0)
        return 0;
    return std::min({to_segment(one.first, two.first, two.second),
                     to_segment(one.second, two.first, two.second),
                     to_segment(two.first, one.first, one.second),
                     to_segment(two.second, one.first, one.second)});
}

}  // namespace

MouthMeasures::MouthMeasures(const rig::Head& head, const rig::RigDescription& rig)
    : landmarks_(head, rig), millimetre_(head.mm(1)) {
    const Points& rest = head.vertices;
    const auto welded = [&](int v) { return head.welded[static_cast<std::size_t>(v)]; };
    std::vector<std::vector<Neighbour>> edges(static_cast<std::size_t>(rest.rows()));
    std::vector<std::array<int, 3>> triangles;
    for (const Triangles* part : {&head.skin, &head.lining})
        for (long f = 0; f < part->rows(); ++f) {
            std::array<int, 3> corners;
            for (int k = 0; k < 3; ++k)
                corners[static_cast<std::size_t>(k)] = welded((*part)(f, k));
            triangles.push_back(corners);
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = corners[k], b = corners[(k + 1) % 3];
                const double length = (rest.row(a) - rest.row(b)).norm();
                edges[static_cast<std::size_t>(a)].push_back({b, length});
                edges[static_cast<std::size_t>(b)].push_back({a, length});
            }
        }
    const double limit = kLipReach_mm * millimetre_;
    const auto upper = distances(edges, welded(landmarks_.vertex("ls")), limit),
               lower = distances(edges, welded(landmarks_.vertex("li")), limit);
    const auto nearer = [](const auto& one, const auto& other, int v) {
        const auto a = one.find(v), b = other.find(v);
        return a != one.end() && (b == other.end() || a->second < b->second);
    };
    const auto lip = [&](const auto& own, const auto& other) {
        Triangles out(static_cast<long>(triangles.size()), 3);
        long count = 0;
        for (const std::array<int, 3>& t : triangles)
            if (std::all_of(t.begin(), t.end(), [&](int v) { return nearer(own, other, v); }))
                out.row(count++) << t[0], t[1], t[2];
        out.conservativeResize(count, 3);
        return out;
    };
    upper_ = lip(upper, lower);
    lower_ = lip(lower, upper);
    middle_x_ = head.landmark("ls").x();
    if (head.has_teeth)
        for (const double x_mm : kIncisors_mm) {
            Vec3 best(0, std::numeric_limits<double>::infinity(), 0);
            for (long v = 0; v < rest.rows(); ++v)
                if (head.carrier[static_cast<std::size_t>(v)] == rig::Carrier::kSkull &&
                    std::abs(rest(v, 0) - middle_x_ - x_mm * millimetre_) < 1.5 * millimetre_ &&
                    rest(v, 2) > head.teeth_front_m - 5 * millimetre_ && rest(v, 1) < best.y())
                    best = rest.row(v).transpose();
            if (std::isfinite(best.y())) incisors_.push_back(best);
        }
    face::FacePose pose;
    pose.vertices = rest;
    pose.head = Rigid::Identity();
    rest_width_ = rest_upper_ = 0;
    rest_lower_ = landmarks_.at("li", rest);
    const Mouth mouth = at(pose);
    rest_width_ = mouth.width;
    rest_upper_ = mouth.upper_protrusion;
    // Meshes are drawn with their lips a little apart.
    rest_gap_ = mouth.gap;
}

Mouth MouthMeasures::at(const face::FacePose& pose) const {
    // Back to the head frame
    Points vertices = pose.vertices;
    const Rigid back = pose.head.inverse();
    if (!back.isApprox(Rigid::Identity()))
        vertices =
            ((vertices * back.linear().transpose()).rowwise() + back.translation().transpose())
                .eval();
    Mouth out;
    const double to_mm = 1e3;
    const auto gap_at = [&](double x_mm) {
        const auto upper = geom::plane_section(upper_, vertices, middle_x_ + x_mm * millimetre_),
                   lower = geom::plane_section(lower_, vertices, middle_x_ + x_mm * millimetre_);
        double least = std::numeric_limits<double>::infinity();
        for (const auto& one : upper)
            for (const auto& two : lower) least = std::min(least, distance(one, two));
        return std::isfinite(least) ? std::max(0.0, to_mm * least - rest_gap_) : 0.0;
    };
    for (const double x : kMiddle_mm) out.gap_middle = std::max(out.gap_middle, gap_at(x));
    for (const double x : kSides_mm) out.gap_side = std::max(out.gap_side, gap_at(x));
    out.gap = std::max(out.gap_middle, out.gap_side);
    const double step_mm = 2 * kSpan_mm / (kSections - 1);
    for (int i = 0; i < kSections; ++i) {
        const double gap = gap_at(-kSpan_mm + i * step_mm);
        out.area_mm2 += gap * step_mm * millimetre_ * to_mm;
        if (gap < kContact_mm) out.contact_mm += step_mm * millimetre_ * to_mm;
    }
    out.width = to_mm * landmarks_.distance("ch_l", "ch_r", vertices) - rest_width_;
    out.upper_protrusion = to_mm * landmarks_.at("ls", vertices).z() - rest_upper_;
    out.lower_protrusion =
        to_mm * (landmarks_.at("li", vertices).z() - (pose.mandible * rest_lower_).z());
    out.jaw = to_mm * pose.jaw.open_m;
    if (!incisors_.empty()) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& edge : incisors_) {
            const Vec2 point(edge.y(), edge.z());
            for (const auto& one : geom::plane_section(lower_, vertices, edge.x()))
                nearest = std::min(nearest, distance({point, point}, one));
        }
        if (std::isfinite(nearest)) out.teeth = to_mm * nearest;
    }
    return out;
}

}  // namespace risorius::talk
