// SPDX-License-Identifier: MIT
#include "risorius/geom/closest_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace risorius::geom {
namespace {

constexpr int kLeafSize = 4;
// Each node has half the triangles of its parent, so the depth is at most 32.
constexpr int kStackSize = 128;

TrianglePoint at_barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c,
                             const Vec3& w) {
    const Vec3 point = w(0) * a + w(1) * b + w(2) * c;
    return {point, w, (p - point).squaredNorm()};
}

/// Weight of b at the point of the segment from a to b that is nearest to p.
double segment_weight(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double length2 = (b - a).squaredNorm();
    return length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
}

double squared_distance_to_box(const Vec3& p, const Vec3& low, const Vec3& high) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double outside = std::max({low(k) - p(k), 0.0, p(k) - high(k)});
        sum += outside * outside;
    }
    return sum;
}

/// Distance at which the ray enters the box; infinity when it misses. `inverse` may be infinite along an axis.
double entry_distance(const Vec3& origin, const Vec3& inverse, const Vec3& low, const Vec3& high,
                      double farthest) {
    double enter = 0.0, leave = farthest;
    for (int k = 0; k < 3; ++k) {
        double t0 = (low(k) - origin(k)) * inverse(k), t1 = (high(k) - origin(k)) * inverse(k);
        if (t0 > t1) std::swap(t0, t1);
        // 0 * infinity is NaN when the ray runs inside a face of the box. That axis then sets no limit.
        if (t0 > enter) enter = t0;
        if (t1 < leave) leave = t1;
    }
    // Boxes of flat triangles have no thickness, and rounding must not miss them.
    constexpr double kSlack = 1e-12;
    return enter <= leave + kSlack * std::max(1.0, std::abs(leave))
               ? enter
               : std::numeric_limits<double>::infinity();
}

/// Distance along the ray and barycentric weights, after Moeller & Trumbore 1997, J. Graphics Tools 2(1).
std::optional<RayHit> meet(const Vec3& origin, const Vec3& direction,
                           const std::array<Vec3, 3>& corner) {
    const Vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const Vec3 across = direction.cross(e2);
    const double determinant = e1.dot(across);
    if (determinant == 0) return std::nullopt;  // parallel, or a triangle without area
    const Vec3 from_corner = origin - corner[0];
    const double u = from_corner.dot(across) / determinant;
    const Vec3 q = from_corner.cross(e1);
    const double v = direction.dot(q) / determinant;
    // A ray through a shared edge must hit one of its triangles, whatever the rounding.
    constexpr double kEdgeSlack = 1e-12;
    if (!(u >= -kEdgeSlack && v >= -kEdgeSlack && u + v <= 1 + kEdgeSlack)) return std::nullopt;
    RayHit hit;
    hit.distance = e2.dot(q) / determinant;
    hit.barycentric = Vec3(1 - u - v, u, v);
    return hit;
}

}  // namespace

TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                        const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const Vec3 normal = ab.cross(ac);
    const double scale = std::max(ab.squaredNorm(), ac.squaredNorm());
    // The triangle is thinner than rounding can resolve: the result is the nearest point of its three sides.
    constexpr double kFlat = 1e-24;
    if (!(normal.squaredNorm() > kFlat * scale * scale)) {
        const double s = segment_weight(p, a, b), t = segment_weight(p, b, c),
                     u = segment_weight(p, c, a);
        TrianglePoint best = at_barycentric(p, a, b, c, Vec3(1 - s, s, 0));
        for (const Vec3& w : {Vec3(0, 1 - t, t), Vec3(u, 0, 1 - u)}) {
            const TrianglePoint other = at_barycentric(p, a, b, c, w);
            if (other.squared_distance < best.squared_distance) best = other;
        }
        return best;
    }

    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return at_barycentric(p, a, b, c, Vec3(1, 0, 0));
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return at_barycentric(p, a, b, c, Vec3(0, 1, 0));
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double v = d1 / (d1 - d3);
        return at_barycentric(p, a, b, c, Vec3(1 - v, v, 0));
    }
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return at_barycentric(p, a, b, c, Vec3(0, 0, 1));
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double w = d2 / (d2 - d6);
        return at_barycentric(p, a, b, c, Vec3(1 - w, 0, w));
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at_barycentric(p, a, b, c, Vec3(0, 1 - w, w));
    }
    const double sum = va + vb + vc;
    const double v = vb / sum, w = vc / sum;
    return at_barycentric(p, a, b, c, Vec3(1 - v - w, v, w));
}

SurfaceTree::SurfaceTree(const Points& positions, const Triangles& triangles)
    : triangles_(triangles) {
    const int count = triangle_count();
    if (count == 0) return;
    std::vector<Vec3> centres(static_cast<std::size_t>(count));
    for (int t = 0; t < count; ++t)
        centres[t] = (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) +
                      positions.row(triangles(t, 2)))
                         .transpose();
    order_.resize(static_cast<std::size_t>(count));
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.resize(1);
    nodes_.reserve(static_cast<std::size_t>(count));
    build(0, 0, count, centres);
    refit(positions);
}

void SurfaceTree::build(int node, int first, int count, const std::vector<Vec3>& centres) {
    if (count <= kLeafSize) {
        // Lowest index first, so that ties inside a leaf are resolved.
        std::sort(order_.begin() + first, order_.begin() + first + count);
        nodes_[node].first = first;
        nodes_[node].count = count;
        return;
    }
    Vec3 low = centres[order_[first]], high = low;
    for (int i = first + 1; i < first + count; ++i) {
        low = low.cwiseMin(centres[order_[i]]);
        high = high.cwiseMax(centres[order_[i]]);
    }
    const Vec3 extent = high - low;
    const int axis =
        extent(0) >= extent(1) && extent(0) >= extent(2) ? 0 : (extent(1) >= extent(2) ? 1 : 2);
    const int half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half,
                     order_.begin() + first + count, [&](int a, int b) {
                         if (centres[a](axis) != centres[b](axis))
                             return centres[a](axis) < centres[b](axis);
                         return a < b;
                     });
    const int left = static_cast<int>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = left;
    build(left, first, half, centres);
    build(left + 1, first + half, count - half, centres);
}

void SurfaceTree::fit(Node& node) const {
    if (node.count == 0) {
        node.low = nodes_[node.first].low.cwiseMin(nodes_[node.first + 1].low);
        node.high = nodes_[node.first].high.cwiseMax(nodes_[node.first + 1].high);
        return;
    }
    node.low = node.high = corners_[node.first][0];
    for (int i = node.first; i < node.first + node.count; ++i)
        for (const Vec3& corner : corners_[i]) {
            node.low = node.low.cwiseMin(corner);
            node.high = node.high.cwiseMax(corner);
        }
}

void SurfaceTree::refit(const Points& positions) {
    corners_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i)
        for (int k = 0; k < 3; ++k)
            corners_[i][k] = positions.row(triangles_(order_[i], k)).transpose();
    // Children come after their parent, so the reverse order is bottom-up.
    for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) fit(*node);
}

std::optional<SurfacePoint> SurfaceTree::closest(const Vec3& p, double max_distance) const {
    if (nodes_.empty()) return std::nullopt;
    SurfacePoint best;
    best.squared_distance = max_distance * max_distance;
    struct Visit {
        int node;
        double squared_distance;
    };
    std::array<Visit, kStackSize> stack;
    int depth = 0;
    stack[depth++] = {0, squared_distance_to_box(p, nodes_[0].low, nodes_[0].high)};
    while (depth > 0) {
        const Visit visit = stack[--depth];
        // A box that is as far as the best triangle so far, up to rounding, may contain an equally near triangle of lower
        // index.
        constexpr double kRounding = 1e-12;
        if (visit.squared_distance * (1 - kRounding) > best.squared_distance) continue;
        const Node& node = nodes_[visit.node];
        if (node.count == 0) {
            Visit near{node.first, 0}, far{node.first + 1, 0};
            near.squared_distance =
                squared_distance_to_box(p, nodes_[near.node].low, nodes_[near.node].high);
            far.squared_distance =
                squared_distance_to_box(p, nodes_[far.node].low, nodes_[far.node].high);
            if (far.squared_distance < near.squared_distance) std::swap(near, far);
            stack[depth++] = far;
            stack[depth++] = near;
            continue;
        }
        for (int i = node.first; i < node.first + node.count; ++i) {
            const TrianglePoint found =
                closest_point_on_triangle(p, corners_[i][0], corners_[i][1], corners_[i][2]);
            const bool nearer = found.squared_distance < best.squared_distance;
            const bool equal = found.squared_distance == best.squared_distance &&
                               (best.triangle < 0 || order_[i] < best.triangle);
            if (!nearer && !equal) continue;
            static_cast<TrianglePoint&>(best) = found;
            best.triangle = order_[i];
        }
    }
    if (best.triangle < 0) return std::nullopt;
    return best;
}

std::optional<RayHit> SurfaceTree::cast(const Vec3& origin, const Vec3& direction,
                                        double max_distance) const {
    if (nodes_.empty()) return std::nullopt;
    const Vec3 inverse = direction.cwiseInverse();
    RayHit best;
    best.distance = max_distance;
    std::array<int, kStackSize> stack;
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const Node& node = nodes_[stack[--depth]];
        const double entry = entry_distance(origin, inverse, node.low, node.high, best.distance);
        if (std::isinf(entry)) continue;
        if (node.count == 0) {
            stack[depth++] = node.first + 1;
            stack[depth++] = node.first;
            continue;
        }
        for (int i = node.first; i < node.first + node.count; ++i) {
            const std::optional<RayHit> hit = meet(origin, direction, corners_[i]);
            if (!hit || hit->distance < 0 || hit->distance > best.distance) continue;
            if (hit->distance == best.distance && best.triangle >= 0 && order_[i] > best.triangle)
                continue;
            best = *hit;
            best.triangle = order_[i];
        }
    }
    if (best.triangle < 0) return std::nullopt;
    best.point = origin + best.distance * direction;
    return best;
}

Mat3 triangle_frame(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 side = b - a, normal = side.cross(c - a);
    if (!(normal.squaredNorm() > 0)) return Mat3::Identity();
    Mat3 frame;
    frame.col(0) = side.normalized();
    frame.col(2) = normal.normalized();
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
}

namespace {

std::array<Vec3, 3> corners_of(int triangle, const Points& positions, const Triangles& triangles) {
    return {positions.row(triangles(triangle, 0)).transpose(),
            positions.row(triangles(triangle, 1)).transpose(),
            positions.row(triangles(triangle, 2)).transpose()};
}

}  // namespace

SurfaceBinding bind_to_surface(const Vec3& p, const SurfacePoint& foot, const Points& positions,
                               const Triangles& triangles) {
    const auto [a, b, c] = corners_of(foot.triangle, positions, triangles);
    const Vec3 on_surface =
        foot.barycentric(0) * a + foot.barycentric(1) * b + foot.barycentric(2) * c;
    return {foot.triangle, foot.barycentric,
            triangle_frame(a, b, c).transpose() * (p - on_surface)};
}

std::vector<SurfaceBinding> bind_to_surface(const Points& points, const SurfaceTree& tree,
                                            const Points& positions, const Triangles& triangles) {
    std::vector<SurfaceBinding> bindings;
    bindings.reserve(static_cast<std::size_t>(points.rows()));
    for (long i = 0; i < points.rows(); ++i) {
        const Vec3 p = points.row(i).transpose();
        const std::optional<SurfacePoint> foot = tree.closest(p);
        assert(foot && "the surface has triangles and the point is finite");
        bindings.push_back(bind_to_surface(p, *foot, positions, triangles));
    }
    return bindings;
}

Vec3 bound_point(const SurfaceBinding& binding, const Points& positions,
                 const Triangles& triangles) {
    const auto [a, b, c] = corners_of(binding.triangle, positions, triangles);
    const Vec3& w = binding.barycentric;
    return w(0) * a + w(1) * b + w(2) * c + triangle_frame(a, b, c) * binding.offset;
}

}  // namespace risorius::geom
