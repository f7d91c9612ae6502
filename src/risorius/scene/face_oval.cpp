// SPDX-License-Identifier: MIT
#include "risorius/scene/face_oval.h"

#include <algorithm>
#include <cmath>

namespace risorius::scene {

namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Convex hull by Andrew's monotone chain.
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
    if (points.size() < 3) return {};
    std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    std::vector<Vec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t begin = hull.size();
        for (const Vec2& point : points) {
            while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

/// The convex hull of a smooth curve through the corners. The curve is a centripetal Catmull-Rom spline, which has no loops between
/// close corners.
std::vector<Vec2> rounded(const std::vector<Vec2>& hull) {
    constexpr int kPieces = 8;
    const std::size_t n = hull.size();
    std::vector<Vec2> curve;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = hull[(i + n - 1) % n], &b = hull[i], &c = hull[(i + 1) % n],
                   &d = hull[(i + 2) % n];
        const double ab = std::sqrt((b - a).norm()), bc = std::sqrt((c - b).norm()),
                     cd = std::sqrt((d - c).norm());
        if (ab == 0 || bc == 0 || cd == 0) continue;
        const Vec2 slope_b = bc * ((b - a) / ab - (c - a) / (ab + bc)) + (c - b),
                   slope_c = bc * ((d - c) / cd - (d - b) / (bc + cd)) + (c - b);
        for (int piece = 0; piece < kPieces; ++piece) {
            const double t = static_cast<double>(piece) / kPieces, u = 1 - t;
            curve.push_back(u * u * (1 + 2 * t) * b + t * t * (3 - 2 * t) * c +
                            t * u * (u * slope_b - t * slope_c));
        }
    }
    return hull_of(std::move(curve));
}

}  // namespace

const std::vector<std::string>& FaceOval::landmarks() {
    static const std::vector<std::string> ids{"tr",   "fml_l", "fml_r", "fht_l", "fht_r",
                                              "ft_l", "ft_r",  "zy_l",  "zy_r",  "go_l",
                                              "go_r", "mmb_l", "mmb_r", "gn",    "me"};
    return ids;
}

FaceOval::FaceOval(std::vector<Vec2> points) : border_(rounded(hull_of(std::move(points)))) {}

bool FaceOval::contains(const Vec2& point) const {
    for (std::size_t i = 0; i < border_.size(); ++i)
        if (turn(border_[i], border_[(i + 1) % border_.size()], point) < 0) return false;
    return !border_.empty();
}

FaceOval::Span FaceOval::pixels_of_row(int y, int width_px) const {
    // Each edge of the border keeps the part of the row on its inner side.
    double left = 0, right = width_px;
    for (std::size_t i = 0; i < border_.size(); ++i) {
        const Vec2 &a = border_[i], &b = border_[(i + 1) % border_.size()];
        // turn(a, b, {x, y + 0.5}) = at_zero - x * rise
        const double rise = b.y() - a.y(), at_zero = turn(a, b, {0.0, y + 0.5});
        if (rise > 0)
            right = std::min(right, at_zero / rise);
        else if (rise < 0)
            left = std::max(left, at_zero / rise);
        else if (at_zero < 0)
            return {};
    }
    // Near the ends contains() decides, so that rounding is the same.
    const auto pixel = [&](double x) {
        return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(width_px)));
    };
    Span out{std::max(0, pixel(left) - 1), std::min(width_px, pixel(right) + 1)};
    while (out.first < out.end && !contains({out.first + 0.5, y + 0.5})) ++out.first;
    while (out.end > out.first && !contains({out.end - 0.5, y + 0.5})) --out.end;
    return out;
}

std::vector<float> FaceOval::soft_pixels(int width_px, int height_px, double rim) const {
    std::vector<float> out(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                           0);
    if (border_.empty()) return out;
    double left = 1e9, right = -1e9;
    for (const Vec2& point : border_) {
        left = std::min(left, point.x());
        right = std::max(right, point.x());
    }
    const double soft = rim * (right - left);
    const auto away = [&](const Vec2& point) {
        double squared = 1e18;
        for (std::size_t i = 0; i < border_.size(); ++i) {
            const Vec2 &a = border_[i], side = border_[(i + 1) % border_.size()] - a;
            const double length = side.squaredNorm(),
                         t = length > 0 ? std::clamp((point - a).dot(side) / length, 0.0, 1.0) : 0;
            squared = std::min(squared, (point - a - t * side).squaredNorm());
        }
        return std::sqrt(squared);
    };
    for (int y = 0; y < height_px; ++y) {
        const Span inside = pixels_of_row(y, width_px);
        for (int x = 0; x < width_px; ++x) {
            double weight = x >= inside.first && x < inside.end ? 1 : 0;
            if (weight == 0 && x > left - soft - 1 && x < right + soft + 1) {
                const double distance = away({x + 0.5, y + 0.5});
                if (distance < soft)
                    weight = 0.5 * (1 + std::cos(3.14159265358979 * distance / soft));
            }
            out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                static_cast<std::size_t>(x)] = static_cast<float>(weight);
        }
    }
    return out;
}

}  // namespace risorius::scene
