// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/surface_sections.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "risorius/core/error.h"
#include "risorius/geom/surface_topology.h"

namespace risorius::muscle::detail {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Second moments of area about the centroid, divided by the area.
Eigen::Matrix2d spread_of(const Loop& loop) {
    const Vec2 centroid = loop_centroid(loop);
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    double twice_area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i] - centroid, b = loop[(i + 1) % loop.size()] - centroid;
        const double part = cross(a, b);
        const Vec2 s = a + b;
        sum += part / 12 * (a * a.transpose() + b * b.transpose() + s * s.transpose());
        twice_area += part;
    }
    return sum / twice_area;
}

void check_closed(const Points& points, const Triangles& triangles, const std::string& place,
                  const geom::SurfaceEdges& edges) {
    const auto edge_at = [&](int e) {
        const auto [a, b] = edges.vertices[static_cast<std::size_t>(e)];
        return "the edge of points " + std::to_string(a) + " and " + std::to_string(b);
    };
    for (int e = 0; e < edges.count(); ++e) {
        const int count = edges.triangle_count(e);
        if (count != 2)
            throw Error(place + "/triangles", "a closed surface: two triangles at every edge",
                        std::to_string(count) + " at " + edge_at(e));
        const auto i = static_cast<std::size_t>(edges.triangle_begin[static_cast<std::size_t>(e)]);
        if (triangles(edges.triangle[i], edges.side[i]) ==
            triangles(edges.triangle[i + 1], edges.side[i + 1]))
            throw Error(place + "/triangles", "neighbours turned to the same side",
                        "others at " + edge_at(e));
    }
    const int pieces = geom::surface_pieces(triangles, static_cast<int>(points.rows())).count();
    if (pieces != 1)
        throw Error(place + "/triangles", "a surface of one piece", std::to_string(pieces));
}

}  // namespace

double loop_area(const Loop& loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        twice += cross(loop[i] - loop[0], loop[(i + 1) % loop.size()] - loop[0]);
    return twice / 2;
}

Vec2 loop_centroid(const Loop& loop) {
    Vec2 sum = Vec2::Zero();
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i] - loop[0], b = loop[(i + 1) % loop.size()] - loop[0];
        sum += cross(a, b) / 3 * (a + b);
        twice += cross(a, b);
    }
    return loop[0] + sum / twice;
}

Vec2 loop_spread(const Loop& loop) { return spread_of(loop).diagonal(); }

double loop_tilt(const Loop& loop) {
    const Eigen::Matrix2d m = spread_of(loop);
    return 0.5 * std::atan2(2 * m(0, 1), m(0, 0) - m(1, 1));
}

bool crosses_itself(const Loop& loop) {
    const std::size_t count = loop.size();
    const auto side = [](const Vec2& a, const Vec2& b, const Vec2& p) {
        return cross(b - a, p - a);
    };
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 2; j < count; ++j) {
            if (i == 0 && j + 1 == count) continue;
            const Vec2 &a = loop[i], &b = loop[i + 1], &c = loop[j], &d = loop[(j + 1) % count];
            if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
        }
    return false;
}

bool encloses(const Loop& loop, const Vec2& point) {
    bool inside = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i] - point, b = loop[(i + 1) % loop.size()] - point;
        if ((a.y() > 0) == (b.y() > 0)) continue;
        if (a.x() + (b.x() - a.x()) * a.y() / (a.y() - b.y()) > 0) inside = !inside;
    }
    return inside;
}

SectionedSurface::SectionedSurface(const Points& points, const Triangles& triangles,
                                   const std::string& place)
    : points_(points), triangles_(triangles) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        if (!points.row(i).allFinite())
            throw Error(place + "/points_m/" + std::to_string(i), "three finite numbers", "others");
    if (triangles.rows() < 4)
        throw Error(place + "/triangles", "at least 4", std::to_string(triangles.rows()));
    if (triangles.minCoeff() < 0 || triangles.maxCoeff() >= points.rows())
        throw Error(place + "/triangles", "indices of points", "others");
    const geom::SurfaceEdges edges = geom::surface_edges(triangles);
    check_closed(points, triangles, place, edges);
    edges_ = edges.vertices;
    edge_of_side_.resize(static_cast<std::size_t>(triangles.rows()));
    for (int e = 0; e < edges.count(); ++e)
        for (int k = edges.triangle_begin[static_cast<std::size_t>(e)];
             k < edges.triangle_begin[static_cast<std::size_t>(e) + 1]; ++k) {
            const auto i = static_cast<std::size_t>(k);
            edge_of_side_[static_cast<std::size_t>(edges.triangle[i])]
                         [static_cast<std::size_t>(edges.side[i])] = e;
        }

    // Sums over tetrahedra from one point of the surface.
    const Vec3 from = points.row(triangles(0, 0)).transpose();
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const Vec3 a = points.row(triangles(t, 0)).transpose() - from,
                   b = points.row(triangles(t, 1)).transpose() - from,
                   c = points.row(triangles(t, 2)).transpose() - from, s = a + b + c;
        const double part = a.dot(b.cross(c)) / 6;
        volume_ += part;
        first += part / 4 * s;
        second += part / 20 *
                  (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    if (!(volume_ > 0))
        throw Error(place + "/triangles", "a surface turned outward", "one turned inward");
    first /= volume_;
    centroid_ = from + first;
    spread_ = second / volume_ - first * first.transpose();
}

Vec3 SectionedSurface::long_axis(double& slenderness) const {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(spread_);
    slenderness = std::sqrt(eigen.eigenvalues()[2] / std::max(eigen.eigenvalues()[1], 0.0));
    Vec3 axis = eigen.eigenvectors().col(2);
    int max;
    axis.cwiseAbs().maxCoeff(&max);
    return axis[max] < 0 ? Vec3(-axis) : axis;
}

std::array<double, 2> SectionedSurface::extent(const Vec3& axis) const {
    std::array<double, 2> range = {std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity()};
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const double at = (points_.row(triangles_(t, k)).transpose() - centroid_).dot(axis);
            range = {std::min(range[0], at), std::max(range[1], at)};
        }
    return range;
}

double SectionedSurface::way_out(const Vec3& from, const Vec3& direction) const {
    double min = std::numeric_limits<double>::infinity();
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
        const Vec3 a = points_.row(triangles_(t, 0)).transpose(),
                   e1 = points_.row(triangles_(t, 1)).transpose() - a,
                   e2 = points_.row(triangles_(t, 2)).transpose() - a;
        const Vec3 p = direction.cross(e2);
        const double determinant = e1.dot(p);
        if (determinant == 0) continue;
        const Vec3 s = from - a, q = s.cross(e1);
        const double u = s.dot(p) / determinant, v = direction.dot(q) / determinant;
        const double at = e2.dot(q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && at > 0) min = std::min(min, at);
    }
    return min;
}

std::vector<Loop> SectionedSurface::loops(const PathFrame& frame) const {
    Eigen::VectorXd above(points_.rows());
    for (Eigen::Index i = 0; i < points_.rows(); ++i)
        above[i] = (points_.row(i).transpose() - frame.at).dot(frame.along);
    // As seen against the path, a triangle's piece of the loop runs from the side that goes down to the side that comes up.
    std::vector<int> next(edges_.size(), -1);
    for (Eigen::Index t = 0; t < triangles_.rows(); ++t) {
        int down = -1, up = -1;
        for (int k = 0; k < 3; ++k) {
            const bool from = above[triangles_(t, k)] >= 0;
            const bool to = above[triangles_(t, (k + 1) % 3)] >= 0;
            const int edge =
                edge_of_side_[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)];
            if (from && !to) down = edge;
            if (!from && to) up = edge;
        }
        if (down >= 0) next[static_cast<std::size_t>(down)] = up;
    }
    std::vector<Loop> loops;
    for (std::size_t start = 0; start < next.size(); ++start) {
        if (next[start] < 0) continue;
        Loop loop;
        for (std::size_t edge = start; next[edge] >= 0;) {
            const auto [a, b] = edges_[edge];
            const double fraction = above[a] / (above[a] - above[b]);
            const Vec3 p =
                ((1 - fraction) * points_.row(a) + fraction * points_.row(b)).transpose() -
                frame.at;
            const Vec2 corner(p.dot(frame.across), p.dot(frame.outward));
            // Where the plane meets a vertex, several edges give the same corner.
            if (loop.empty() || corner != loop.back()) loop.push_back(corner);
            const int to = next[edge];
            next[edge] = -1;
            edge = static_cast<std::size_t>(to);
        }
        while (loop.size() > 1 && loop.back() == loop.front()) loop.pop_back();
        if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
}

}  // namespace risorius::muscle::detail
