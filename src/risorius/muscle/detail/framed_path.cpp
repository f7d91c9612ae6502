// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/framed_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"

namespace risorius::muscle {

namespace {

constexpr int kSamplesPerSpan = 64;

Vec3 perpendicular(const Vec3& v, const Vec3& to) { return v - v.dot(to) * to; }

Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis) * v;
}

/// Angle by which `from` must be rotated about `axis` to meet `to`. Both are perpendicular to it.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) {
    return std::atan2(axis.dot(from.cross(to)), from.dot(to));
}

/// Double reflection: carries the frame's n from one sample to the next.
Vec3 carried(const Vec3& n, const Vec3& from, const Vec3& t_from, const Vec3& to,
             const Vec3& t_to) {
    const Vec3 v1 = to - from;
    const double c1 = v1.squaredNorm();
    if (!(c1 > 0)) return n;
    const Vec3 n_left = n - 2 / c1 * v1.dot(n) * v1;
    const Vec3 t_left = t_from - 2 / c1 * v1.dot(t_from) * v1;
    const Vec3 v2 = t_to - t_left;
    const double c2 = v2.squaredNorm();
    return c2 > 0 ? Vec3(n_left - 2 / c2 * v2.dot(n_left) * v2) : n_left;
}

Vec3 plane_normal(const Points& loop) {
    Vec3 area = Vec3::Zero();
    for (Eigen::Index i = 0; i < loop.rows(); ++i) {
        const Vec3 a = loop.row(i) - loop.row(0);
        const Vec3 b = loop.row((i + 1) % loop.rows()) - loop.row(0);
        area += a.cross(b);
    }
    return area;
}

}  // namespace

FramedPath::FramedPath(const Points& through, const Points& outward, bool closed,
                       const std::string& place)
    : through_(through), closed_(closed) {
    const Eigen::Index count = through.rows(), min = closed ? 3 : 2;
    const auto item = [&](const char* list, Eigen::Index i) {
        return place + "/" + list + "/" + std::to_string(i);
    };
    if (count < min)
        throw Error(place + "/path_m", "at least " + std::to_string(min) + " points",
                    std::to_string(count));
    for (Eigen::Index i = 0; i < count; ++i)
        if (!through.row(i).allFinite())
            throw Error(item("path_m", i), "three finite numbers", "others");
    for (int i = 0; i < spans(); ++i) {
        const double chord = (point(i + 1) - point(i)).norm();
        if (!(chord > 0))
            throw Error(item("path_m", (i + 1) % count), "a point apart from its neighbours",
                        "the same place twice");
        gap_.push_back(std::sqrt(chord));
    }
    if (outward.rows() > 1 && outward.rows() != count)
        throw Error(place + "/outward", "one direction, or one per point of the path",
                    std::to_string(outward.rows()));

    length_.push_back(0);
    Vec3 last = point(0), at, first, second;
    for (int span = 0; span < spans(); ++span)
        for (int k = 1; k <= kSamplesPerSpan; ++k) {
            evaluate(span, static_cast<double>(k) / kSamplesPerSpan, at, first, second);
            length_.push_back(length_.back() + (at - last).norm());
            last = at;
        }

    if (outward.rows() == 0) {
        const Vec3 t = frame_of_sample(0, 0).along;
        const Vec3 plane = closed ? plane_normal(through) : Vec3::Zero();
        Vec3 start = plane.norm() > 0 ? Vec3(plane.normalized()) : Vec3::UnitZ();
        constexpr double kMinSine = 0.1;
        for (const Vec3& other : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
            if (perpendicular(start, t).norm() < kMinSine) start = other;
        carry_outward(perpendicular(start, t).normalized());
        return;
    }
    std::vector<Vec3> given;
    for (Eigen::Index i = 0; i < outward.rows(); ++i) {
        const Vec3 row = outward.row(i).transpose();
        if (!row.allFinite() || !(row.norm() > 0))
            throw Error(item("outward", i), "a direction", "no finite length above 0");
        given.push_back(row.normalized());
    }
    for (std::size_t k = 0; k < length_.size(); ++k) {
        const auto span = k / kSamplesPerSpan;
        const double u = static_cast<double>(k % kSamplesPerSpan) / kSamplesPerSpan;
        const Vec3& a = given[given.size() > 1 ? span % given.size() : 0];
        const Vec3& b = given[given.size() > 1 ? (span + 1) % given.size() : 0];
        const Vec3 t =
            frame_of_sample(std::min(k, length_.size() - 2), k + 1 < length_.size() ? 0 : 1).along;
        const Vec3 n = perpendicular(u > 0 ? Vec3((1 - u) * a + u * b) : a, t);
        constexpr double kMinSine = 0.05;
        if (!(n.norm() > kMinSine))
            throw Error(
                item("outward", given.size() > 1 ? static_cast<Eigen::Index>(span) % count : 0),
                "a direction across the path",
                "one along it " + format_number(std::round(1e3 * length_[k]) / 1e3) +
                    " m from its start");
        outward_.push_back(n.normalized());
    }
}

Vec3 FramedPath::point(int i) const {
    const int count = static_cast<int>(through_.rows());
    return through_.row(closed_ ? (i + count) % count : i).transpose();
}

Vec3 FramedPath::slope(int i) const {
    const int count = spans();
    const auto speed = [&](int span) {
        const int k = (span + count) % count;
        return Vec3((point(k + 1) - point(k)) / gap_[static_cast<std::size_t>(k)]);
    };
    const auto gap = [&](int span) {
        return gap_[static_cast<std::size_t>((span + count) % count)];
    };
    if (closed_ || (i > 0 && i < count))
        return (gap(i) * speed(i - 1) + gap(i - 1) * speed(i)) / (gap(i - 1) + gap(i));
    if (count == 1) return speed(0);
    // At an end, the slope of the parabola through the three outermost points.
    const int outer = i == 0 ? 0 : count - 1, inner = i == 0 ? 1 : count - 2;
    return speed(outer) + gap(outer) * (speed(outer) - speed(inner)) / (gap(outer) + gap(inner));
}

void FramedPath::evaluate(int span, double u, Vec3& at, Vec3& first, Vec3& second) const {
    const double h = gap_[static_cast<std::size_t>(span)];
    const int next = closed_ ? (span + 1) % spans() : span + 1;
    const Vec3 p = point(span), q = point(span + 1), a = h * slope(span), b = h * slope(next);
    const Vec3 c2 = 3 * (q - p) - 2 * a - b, c3 = 2 * (p - q) + a + b;
    at = p + u * (a + u * (c2 + u * c3));
    first = (a + u * (2 * c2 + 3 * u * c3)) / h;
    second = (2 * c2 + 6 * u * c3) / (h * h);
}

PathFrame FramedPath::frame_of_sample(std::size_t sample, double fraction) const {
    const int span = static_cast<int>(sample / kSamplesPerSpan);
    const double u = (static_cast<double>(sample % kSamplesPerSpan) + fraction) / kSamplesPerSpan;
    PathFrame frame;
    Vec3 first, second;
    evaluate(span, u, frame.at, first, second);
    const double speed = first.norm();
    frame.along = first / speed;
    frame.bend = perpendicular(second, frame.along) / (speed * speed);
    frame.knot = span + u;
    return frame;
}

void FramedPath::carry_outward(const Vec3& first) {
    const std::size_t last = length_.size() - 1;
    const auto sample = [&](std::size_t k) {
        return k < last ? frame_of_sample(k, 0) : frame_of_sample(last - 1, 1);
    };
    outward_.assign(1, first);
    PathFrame before = sample(0);
    for (std::size_t k = 1; k <= last; ++k) {
        const PathFrame here = sample(k);
        const Vec3 n = carried(outward_.back(), before.at, before.along, here.at, here.along);
        outward_.push_back(perpendicular(n, here.along).normalized());
        before = here;
    }
    if (!closed_) return;
    const double missing = angle_about(before.along, outward_.back(), first);
    for (std::size_t k = 0; k <= last; ++k)
        outward_[k] = turned(outward_[k], sample(k).along, missing * length_[k] / length_.back());
}

PathFrame FramedPath::frame(double s) const {
    const double wanted = std::clamp(s, 0.0, 1.0) * length_.back();
    const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, wanted);
    const auto k = static_cast<std::size_t>(above - length_.begin()) - 1;
    const double fraction =
        std::clamp((wanted - length_[k]) / (length_[k + 1] - length_[k]), 0.0, 1.0);
    PathFrame frame = frame_of_sample(k, fraction);
    const Vec3 n = (1 - fraction) * outward_[k] + fraction * outward_[k + 1];
    frame.outward = turned(perpendicular(n, frame.along).normalized(), frame.along, turn_);
    frame.across = frame.outward.cross(frame.along);
    return frame;
}

double value_along(const std::vector<double>& values, bool closed, double knot) {
    const int count = static_cast<int>(values.size());
    if (count == 1) return values[0];
    const int spans = closed ? count : count - 1;
    const auto at = [&](int i) {
        return values[static_cast<std::size_t>(closed ? (i + count) % count
                                                      : std::clamp(i, 0, count - 1))];
    };
    const int span = std::clamp(static_cast<int>(knot), 0, spans - 1);
    const double u = std::clamp(knot - span, 0.0, 1.0);
    const auto rise = [&](int i) { return at(i + 1) - at(i); };
    const auto slope = [&](int i) {
        if (!closed && i == 0) return rise(0);
        if (!closed && i == count - 1) return rise(count - 2);
        const double a = rise(i - 1), b = rise(i);
        return a * b > 0 ? 2 * a * b / (a + b) : 0.0;
    };
    const double a = slope(span), b = slope(span + 1), p = at(span), d = rise(span);
    return p + u * (a + u * (3 * d - 2 * a - b + u * (a + b - 2 * d)));
}

}  // namespace risorius::muscle
