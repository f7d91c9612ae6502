// SPDX-License-Identifier: MIT
#include "risorius/contact/surface_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "risorius/contact/detail/carried_frame.h"

namespace risorius::contact {

namespace {

std::vector<int> nodes_of(const Triangles& triangles) {
    std::vector<int> nodes(triangles.data(), triangles.data() + triangles.size());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

/// Barycentric coordinates of p's projection onto the triangle's plane; it may lie outside the triangle.
Vec3 foot_on_plane(const Vec3& p, int triangle, const Triangles& triangles, const Points& x) {
    const Vec3 a = x.row(triangles(triangle, 0)).transpose();
    const Vec3 b = x.row(triangles(triangle, 1)).transpose();
    const Vec3 c = x.row(triangles(triangle, 2)).transpose();
    const Vec3 normal = (b - a).cross(c - a);
    const double of_b = (p - a).cross(c - a).dot(normal) / normal.squaredNorm();
    const double of_c = (b - a).cross(p - a).dot(normal) / normal.squaredNorm();
    return {1 - of_b - of_c, of_b, of_c};
}

double max_speed(const std::vector<int>& nodes, const Points& v) {
    double squared = 0;
    for (const int node : nodes) squared = std::max(squared, v.row(node).squaredNorm());
    return std::sqrt(squared);
}

}  // namespace

SurfaceContact::SurfaceContact(const Points& rest, const Triangles& first, const Triangles& second,
                               const ContactMaterial& material,
                               const SurfaceContactOptions& options)
    : material_(material), options_(options) {
    check(material_, "contact");
    surfaces_ = {ClosedSurface(rest, first, "first surface"),
                 ClosedSurface(rest, second, "second surface")};
    nodes_ = {nodes_of(first), nodes_of(second)};
    sides_ = {{surface_samples(rest, first, options.per_side), 0, 1, 0.5},
              {surface_samples(rest, second, options.per_side), 1, 0, 0.5}};
}

SurfaceContact::SurfaceContact(const Points& rest, std::vector<ContactSample> samples,
                               const Triangles& closed, const ContactMaterial& material,
                               const SurfaceContactOptions& options)
    : material_(material), options_(options) {
    check(material_, "contact");
    surfaces_ = {ClosedSurface(rest, closed, "closed surface")};
    std::vector<int> sampled;
    for (const ContactSample& sample : samples)
        for (int i = 0; i < sample.point.count(); ++i) sampled.push_back(sample.point.node(i));
    nodes_ = {nodes_of(closed), std::move(sampled)};
    sides_ = {{std::move(samples), -1, 0, 1.0}};
}

void SurfaceContact::begin_step(double, double step_s, const Points& x, const Points& v) {
    double reach = options_.search_m > 0 ? options_.search_m : 4 * material_.thickness_m;
    reach += material_.thickness_m;
    if (std::isfinite(step_s))
        reach += step_s * (max_speed(nodes_[0], v) + max_speed(nodes_[1], v));
    for (ClosedSurface& surface : surfaces_) surface.refit(x);
    pairs_.clear();
    for (std::size_t i = 0; i < sides_.size(); ++i) find_pairs(sides_[i], i == 0, reach, x);
}

void SurfaceContact::find_pairs(const Side& side, bool of_first, double reach_m, const Points& x) {
    const ClosedSurface& other = surfaces_[side.other];
    for (const ContactSample& sample : side.samples) {
        const Vec3 p = sample.point.of(x);
        const auto nearest = other.nearest(p, reach_m);
        if (!nearest) continue;
        const double distance = std::abs(nearest->gap_m);
        // The normal is the direction to the surface. Where the distance is nearly zero, that direction is undefined and the
        // surface's own normal replaces it.
        constexpr double kMeeting = 1e-3;  // in units of the thickness
        Vec3 normal = nearest->normal;
        if (distance > kMeeting * material_.thickness_m)
            normal = (p - nearest->point) / nearest->gap_m;
        if (nearest->gap_m < kMeeting * material_.thickness_m && side.own >= 0) {
            // The nearest way out may lead through a face next to the one it came in by (for instance when a cube is slightly
            // inside another, near its edge). But surfaces that touch face each other.
            Vec3 own_normal = Vec3::Zero();
            for (int i = 0; i < sample.point.count(); ++i)
                own_normal += sample.point.weight(i) *
                              surfaces_[side.own].vertex_normal(sample.point.node(i));
            own_normal.normalize();
            constexpr double kFacing = 0.3;  // cosine
            if (normal.dot(own_normal) > -kFacing) {
                // Starts off the surface, so that the ray does not end where it starts.
                const Vec3 from = p - 2 * kMeeting * material_.thickness_m * own_normal;
                const auto exit = other.tree().cast(from, -own_normal, reach_m);
                if (exit && other.face_normal(exit->triangle).dot(own_normal) < -kFacing) {
                    add_pair(side, sample, of_first, exit->triangle,
                             foot_on_plane(p, exit->triangle, other.triangles(), x),
                             other.face_normal(exit->triangle), x);
                    continue;
                }
            }
        }
        add_pair(side, sample, of_first, nearest->triangle, nearest->barycentric, normal, x);
    }
}

void SurfaceContact::add_pair(const Side& side, const ContactSample& sample, bool of_first,
                              int triangle, const Vec3& weights, const Vec3& normal,
                              const Points& x) {
    const ClosedSurface& other = surfaces_[side.other];
    if (other.face_normal(triangle).isZero(0)) return;  // degenerate: it has no frame
    const auto corners = other.triangles().row(triangle);
    Pair pair{&sample,
              {corners(0), corners(1), corners(2)},
              weights,
              Vec3::Zero(),
              side.fraction * material_.stiffness_pa_per_m * sample.area_m2,
              of_first,
              Vec3::Zero(),
              0,
              0};
    const CarriedFrame frame = frame_of(pair, x);
    pair.normal = frame.axes().transpose() * normal;
    pair.start = frame.place();
    const Penalty start = penalty(pair.normal.dot(pair.start), material_.thickness_m);
    pair.friction_n = material_.friction * pair.stiffness * start.pressure;
    pair.damping = material_.damping_s * pair.stiffness * start.slope;
    pairs_.push_back(pair);
}

CarriedFrame SurfaceContact::frame_of(const Pair& pair, const Points& x) {
    return {pair.sample->point.of(x),
            {x.row(pair.corners[0]).transpose(), x.row(pair.corners[1]).transpose(),
             x.row(pair.corners[2]).transpose()},
            pair.weights};
}

SurfaceContact::Slip SurfaceContact::slip_of(const Pair& pair, const Vec3& place) {
    const Vec3 slip = place - pair.start;
    const double apart = slip.dot(pair.normal);
    return {slip - apart * pair.normal, apart};
}

void SurfaceContact::scatter(const Pair& pair, const CarriedFrame& frame, const Vec3& y,
                             Points& out) {
    pair.sample->point.scatter(Vec3(frame.slope(0).transpose() * y), out);
    for (int i = 0; i < 3; ++i) out.row(pair.corners[i]) += y.transpose() * frame.slope(i + 1);
}

void SurfaceContact::add_force(double, const Points& x, const Points& v, Points& force) const {
    const bool dissipates = material_.friction > 0 || material_.damping_s > 0;
    for (const Pair& pair : pairs_) {
        const CarriedFrame frame = frame_of(pair, x);
        const Penalty penalty =
            contact::penalty(pair.normal.dot(frame.place()), material_.thickness_m);
        if (penalty.pressure == 0) continue;
        Vec3 y = pair.stiffness * penalty.pressure * pair.normal;
        if (dissipates) {
            Vec3 rate = frame.slope(0) * pair.sample->point.of(v);
            for (int i = 0; i < 3; ++i)
                rate += frame.slope(i + 1) * v.row(pair.corners[i]).transpose();
            const double apart = rate.dot(pair.normal);
            const Vec3 along = rate - apart * pair.normal;
            const SlipShape friction = slip_shape(along.norm(), material_.slip_speed_m_per_s);
            y -= material_.friction * pair.stiffness * penalty.pressure * friction.force_over_slip *
                 along;
            y -= material_.damping_s * pair.stiffness * penalty.slope * std::min(0.0, apart) *
                 pair.normal;
        }
        scatter(pair, frame, y, force);
    }
}

double SurfaceContact::energy(double, const Points& x) const {
    double energy = 0;
    for (const Pair& pair : pairs_)
        energy += pair.stiffness *
                  penalty(pair.normal.dot(frame_of(pair, x).place()), material_.thickness_m).energy;
    return energy;
}

double SurfaceContact::add_potential(const solve::ImplicitStep& step, const Points& x,
                                     Points& gradient) const {
    double sum = 0;
    const double e = material_.slip_speed_m_per_s * step.step_s;
    for (const Pair& pair : pairs_) {
        const CarriedFrame frame = frame_of(pair, x);
        const Penalty penalty =
            contact::penalty(pair.normal.dot(frame.place()), material_.thickness_m);
        const bool lags = step.rate_hz() > 0 && (pair.friction_n > 0 || pair.damping > 0);
        if (penalty.pressure == 0 && !lags) continue;
        sum += pair.stiffness * penalty.energy;
        Vec3 y = -pair.stiffness * penalty.pressure * pair.normal;
        if (lags) {
            const Slip slip = slip_of(pair, frame.place());
            const SlipShape friction = slip_shape(slip.along.norm(), e);
            const double nearing = std::min(0.0, slip.apart), c = pair.damping * step.rate_hz();
            sum += pair.friction_n * friction.potential + 0.5 * c * nearing * nearing;
            y +=
                pair.friction_n * friction.force_over_slip * slip.along + c * nearing * pair.normal;
        }
        scatter(pair, frame, y, gradient);
    }
    return sum;
}

void SurfaceContact::add_hessian(const solve::ImplicitStep& step, const Points& x,
                                 solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    const double e = material_.slip_speed_m_per_s * step.step_s;
    for (const Pair& pair : pairs_) {
        const CarriedFrame frame = frame_of(pair, x);
        const Penalty penalty =
            contact::penalty(pair.normal.dot(frame.place()), material_.thickness_m);
        const bool lags = step.rate_hz() > 0 && (pair.friction_n > 0 || pair.damping > 0);
        if (penalty.pressure == 0 && !lags) continue;
        const Mat3 along = pair.normal * pair.normal.transpose();
        Vec3 y = -pair.stiffness * penalty.pressure * pair.normal;
        Mat3 inner = pair.stiffness * penalty.slope * along;
        if (lags) {
            const Slip slip = slip_of(pair, frame.place());
            const SlipShape friction = slip_shape(slip.along.norm(), e);
            const Mat3 across = Mat3::Identity() - along;
            const double c = pair.damping * step.rate_hz();
            y += pair.friction_n * friction.force_over_slip * slip.along +
                 c * std::min(0.0, slip.apart) * pair.normal;
            inner += pair.friction_n * across * slip_curvature(slip.along, friction) * across;
            if (slip.apart < 0) inner += c * along;
        }
        // Blocks by p, a, b, c. The projection omits the rotation of the frame.
        const auto block = [&](int i, int j) {
            Mat3 sum = frame.slope(i).transpose() * inner * frame.slope(j);
            if (curvature == solve::Curvature::kExact) sum += frame.second_slope(y, i, j);
            return sum;
        };
        const solve::NodeBlend& p = pair.sample->point;
        p.scatter(block(0, 0), hessian);
        for (int i = 0; i < 3; ++i) {
            const Mat3 with_p = block(i + 1, 0);
            for (int k = 0; k < p.count(); ++k)
                hessian.add(pair.corners[i], p.node(k), p.weight(k) * with_p);
            for (int j = 0; j <= i; ++j)
                hessian.add(pair.corners[i], pair.corners[j], block(i + 1, j + 1));
        }
    }
}

void SurfaceContact::add_metric(double, solve::MetricBuilder& metric) const {
    for (const Side& side : sides_)
        for (const ContactSample& sample : side.samples)
            sample.point.scatter(0.5 * material_.stiffness_pa_per_m * sample.area_m2, metric);
}

double SurfaceContact::min_gap_m(const Points& x) const {
    double min = std::numeric_limits<double>::infinity();
    for (const Pair& pair : pairs_) min = std::min(min, pair.normal.dot(frame_of(pair, x).place()));
    return min;
}

Vec3 SurfaceContact::force_on_first(const Points& x) const {
    Vec3 sum = Vec3::Zero();
    for (const Pair& pair : pairs_) {
        const CarriedFrame frame = frame_of(pair, x);
        const Penalty penalty =
            contact::penalty(pair.normal.dot(frame.place()), material_.thickness_m);
        const Vec3 push =
            pair.stiffness * penalty.pressure * (frame.slope(0).transpose() * pair.normal);
        sum += pair.of_first ? push : Vec3(-push);
    }
    return sum;
}

}  // namespace risorius::contact
