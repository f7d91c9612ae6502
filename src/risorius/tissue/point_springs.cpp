// SPDX-License-Identifier: MIT
#include "risorius/tissue/point_springs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "risorius/core/json_cursor.h"

namespace risorius::tissue {

namespace {

/// Length and direction from the fixed end to the point. The direction is arbitrary where they coincide.
struct Line {
    double length;
    Vec3 direction;
};

Line line_of(const PointSpring& spring, const Points& x) {
    const Vec3 d = spring.at.of(x) - spring.tied_to;
    const double length = d.norm();
    return {length, length > 0 ? Vec3(d / length) : Vec3::UnitZ()};
}

/// Second derivative of k/2 (l - l0)^2 by the point.
Mat3 curvature_of(const Line& line, double k, double l0, solve::Curvature curvature) {
    if (l0 == 0) return k * Mat3::Identity();
    constexpr double kMin_m = 1e-12;  // the energy has a cusp where the point meets the fixed end
    double across = k * (1 - l0 / std::max(line.length, kMin_m));
    if (curvature == solve::Curvature::kPositive) across = std::max(across, 0.0);
    const Mat3 along = line.direction * line.direction.transpose();
    return k * along + across * (Mat3::Identity() - along);
}

void check_at_least_zero(double value, const std::string& place) {
    if (!(value >= 0 && std::isfinite(value))) throw Error(place, "[0, inf)", format_number(value));
}

}  // namespace

void check(const PointSpring& spring, const std::string& place) {
    check_at_least_zero(spring.stiffness_n_per_m, place + "/stiffness_n_per_m");
    check_at_least_zero(spring.rest_length_m, place + "/rest_length_m");
    check_at_least_zero(spring.damping_ns_per_m, place + "/damping_ns_per_m");
    if (!spring.tied_to.allFinite())
        throw Error(place + "/tied_to", "finite numbers", "NaN or inf");
    if (spring.at.count() == 0) throw Error(place + "/at", "a point of the body", "no nodes");
}

PointSprings::PointSprings(std::vector<PointSpring> springs) : springs_(std::move(springs)) {}

void PointSprings::add_force(double, const Points& x, const Points& v, Points& force) const {
    for (const PointSpring& spring : springs_) {
        const Line line = line_of(spring, x);
        const Vec3 velocity = spring.at.of(v);
        const Vec3 rate = spring.rest_length_m == 0
                              ? velocity
                              : Vec3(velocity.dot(line.direction) * line.direction);
        const Vec3 pull =
            spring.stiffness_n_per_m * (line.length - spring.rest_length_m) * line.direction;
        spring.at.scatter(Vec3(-pull - spring.damping_ns_per_m * rate), force);
    }
}

double PointSprings::energy(double, const Points& x) const {
    double energy = 0;
    for (const PointSpring& spring : springs_) {
        const double longer = line_of(spring, x).length - spring.rest_length_m;
        energy += 0.5 * spring.stiffness_n_per_m * longer * longer;
    }
    return energy;
}

double PointSprings::add_potential(const solve::ImplicitStep& step, const Points& x,
                                   Points& gradient) const {
    double sum = 0;
    for (const PointSpring& spring : springs_) {
        const Line line = line_of(spring, x);
        const double longer = line.length - spring.rest_length_m;
        Vec3 slope = spring.stiffness_n_per_m * longer * line.direction;
        sum += 0.5 * spring.stiffness_n_per_m * longer * longer;
        const double c = spring.damping_ns_per_m * step.rate_hz();
        if (c > 0 && spring.rest_length_m == 0) {
            const Vec3 moved = spring.at.of(x) - spring.at.of(step.start);
            sum += 0.5 * c * moved.squaredNorm();
            slope += c * moved;
        } else if (c > 0) {
            const double lengthened = line.length - line_of(spring, step.start).length;
            sum += 0.5 * c * lengthened * lengthened;
            slope += c * lengthened * line.direction;
        }
        spring.at.scatter(slope, gradient);
    }
    return sum;
}

void PointSprings::add_hessian(const solve::ImplicitStep& step, const Points& x,
                               solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    for (const PointSpring& spring : springs_) {
        const Line line = line_of(spring, x);
        Mat3 block = curvature_of(line, spring.stiffness_n_per_m, spring.rest_length_m, curvature);
        const double c = spring.damping_ns_per_m * step.rate_hz();
        // The damper's potential is that of a spring whose rest length is its length at the start of the step.
        if (c > 0)
            block += spring.rest_length_m == 0
                         ? Mat3(c * Mat3::Identity())
                         : curvature_of(line, c, line_of(spring, step.start).length, curvature);
        spring.at.scatter(block, hessian);
    }
}

void PointSprings::add_metric(double step_s, solve::MetricBuilder& metric) const {
    for (const PointSpring& spring : springs_)
        spring.at.scatter(spring.stiffness_n_per_m + spring.damping_ns_per_m / step_s, metric);
}

void PointSprings::add_secant(double, const Points& x, const Points& v, bool,
                              solve::MetricBuilder& K, solve::MetricBuilder& damping,
                              Points& force) const {
    for (const PointSpring& spring : springs_) {
        const Line line = line_of(spring, x);
        const double k =
            spring.rest_length_m == 0
                ? spring.stiffness_n_per_m
                : spring.stiffness_n_per_m * (line.length - spring.rest_length_m) / line.length;
        if (k >= 0) {
            spring.at.scatter(k, K);
            spring.at.scatter(Vec3(k * spring.tied_to), force);
        } else {  // compressed: a negative matrix would spoil the solve
            spring.at.scatter(Vec3(spring.stiffness_n_per_m * (spring.rest_length_m - line.length) *
                                   line.direction),
                              force);
        }
        if (spring.rest_length_m == 0)
            spring.at.scatter(spring.damping_ns_per_m, damping);
        else
            spring.at.scatter(Vec3(-spring.damping_ns_per_m * spring.at.of(v).dot(line.direction) *
                                   line.direction),
                              force);
    }
}

InteractiveSpring::InteractiveSpring(double stiffness_n_per_m, double damping_ns_per_m)
    : stiffness_n_per_m_(stiffness_n_per_m), damping_ns_per_m_(damping_ns_per_m), now_({}) {
    for (const double value : {stiffness_n_per_m, damping_ns_per_m})
        if (!(value >= 0 && std::isfinite(value)))
            throw std::invalid_argument("an interactive spring's stiffness and damping are >= 0");
}

void InteractiveSpring::attach(const solve::NodeBlend& at, const Vec3& free_end) {
    attach(at, free_end, stiffness_n_per_m_, damping_ns_per_m_);
}

void InteractiveSpring::attach(const solve::NodeBlend& at, const Vec3& free_end,
                               double stiffness_n_per_m, double damping_ns_per_m) {
    const std::lock_guard lock(mutex_);
    wanted_ = {{at, free_end, stiffness_n_per_m, 0.0, damping_ns_per_m}};
}

void InteractiveSpring::move(const Vec3& free_end) {
    const std::lock_guard lock(mutex_);
    if (!wanted_.empty()) wanted_.front().tied_to = free_end;
}

void InteractiveSpring::release() {
    const std::lock_guard lock(mutex_);
    wanted_.clear();
}

Vec3 InteractiveSpring::free_end() const {
    return attached() ? now_.list().front().tied_to : Vec3(Vec3::Zero());
}

void InteractiveSpring::begin_step(double, double, const Points&, const Points&) {
    const std::lock_guard lock(mutex_);
    now_.list() = wanted_;
}

}  // namespace risorius::tissue
