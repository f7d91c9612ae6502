// SPDX-License-Identifier: MIT
#include "risorius/contact/obstacle_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace risorius::contact {

ObstacleContact::ObstacleContact(std::vector<ContactSample> samples,
                                 std::shared_ptr<const Obstacle> obstacle,
                                 const ContactMaterial& material)
    : samples_(std::move(samples)), obstacle_(std::move(obstacle)), material_(material) {
    check(material_, "contact");
}

void ObstacleContact::begin_step(double t_s, double, const Points& x, const Points&) {
    lagged_.clear();
    if (material_.friction == 0 && material_.damping_s == 0) return;
    const PlacedShape shape = obstacle_->at(t_s);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Vec3 p = samples_[i].point.of(x);
        const Distance distance = shape.distance(p);
        const Penalty penalty = contact::penalty(distance.gap_m, material_.thickness_m);
        if (penalty.pressure == 0) continue;
        const double stiffness = material_.stiffness_pa_per_m * samples_[i].area_m2;
        const double length = distance.gradient.norm();
        lagged_.push_back({static_cast<int>(i), p, distance.gradient / length,
                           material_.friction * stiffness * penalty.pressure * length,
                           material_.damping_s * stiffness * penalty.slope});
    }
}

Vec3 ObstacleContact::force_on(const PlacedShape& shape, const ContactSample& sample,
                               const Points& x, const Points& v) const {
    const Vec3 p = sample.point.of(x);
    const Distance distance = shape.distance(p);
    const Penalty penalty = contact::penalty(distance.gap_m, material_.thickness_m);
    if (penalty.pressure == 0) return Vec3::Zero();
    const double stiffness = material_.stiffness_pa_per_m * sample.area_m2;
    Vec3 force = stiffness * penalty.pressure * distance.gradient;
    if (material_.friction == 0 && material_.damping_s == 0) return force;
    const double length = distance.gradient.norm();
    const Vec3 normal = distance.gradient / length;
    const Vec3 slip = sample.point.of(v) - shape.velocity(p);
    const double apart = slip.dot(normal);
    const Vec3 along = slip - apart * normal;
    const SlipShape friction = slip_shape(along.norm(), material_.slip_speed_m_per_s);
    force -= material_.friction * stiffness * penalty.pressure * length * friction.force_over_slip *
             along;
    force -= material_.damping_s * stiffness * penalty.slope * std::min(0.0, apart) * normal;
    return force;
}

void ObstacleContact::add_force(double t_s, const Points& x, const Points& v, Points& force) const {
    const PlacedShape shape = obstacle_->at(t_s);
    for (const ContactSample& sample : samples_) {
        const Vec3 f = force_on(shape, sample, x, v);
        if (f != Vec3::Zero()) sample.point.scatter(f, force);
    }
}

double ObstacleContact::energy(double t_s, const Points& x) const {
    const PlacedShape shape = obstacle_->at(t_s);
    double energy = 0;
    for (const ContactSample& sample : samples_)
        energy += material_.stiffness_pa_per_m * sample.area_m2 *
                  penalty(shape.distance(sample.point.of(x)).gap_m, material_.thickness_m).energy;
    return energy;
}

Rigid ObstacleContact::carried(const solve::ImplicitStep& step) const {
    return obstacle_->at(step.end_s).place() *
           obstacle_->at(step.end_s - step.step_s).place().inverse();
}

ObstacleContact::Slip ObstacleContact::slip_of(const Lagged& lagged, const Rigid& carried,
                                               const Points& x) const {
    const Vec3 slip = samples_[lagged.sample].point.of(x) - carried * lagged.start;
    const double apart = slip.dot(lagged.normal);
    return {slip - apart * lagged.normal, apart};
}

double ObstacleContact::add_potential(const solve::ImplicitStep& step, const Points& x,
                                      Points& gradient) const {
    const PlacedShape shape = obstacle_->at(step.end_s);
    double sum = 0;
    for (const ContactSample& sample : samples_) {
        const Distance distance = shape.distance(sample.point.of(x));
        const Penalty penalty = contact::penalty(distance.gap_m, material_.thickness_m);
        if (penalty.pressure == 0) continue;
        const double stiffness = material_.stiffness_pa_per_m * sample.area_m2;
        sum += stiffness * penalty.energy;
        sample.point.scatter(Vec3(-stiffness * penalty.pressure * distance.gradient), gradient);
    }
    if (step.rate_hz() == 0 || lagged_.empty()) return sum;
    const Rigid motion = carried(step);
    const double e = material_.slip_speed_m_per_s * step.step_s;
    for (const Lagged& lagged : lagged_) {
        const Slip slip = slip_of(lagged, motion, x);
        const SlipShape friction = slip_shape(slip.along.norm(), e);
        const double nearing = std::min(0.0, slip.apart), c = lagged.damping * step.rate_hz();
        sum += lagged.friction_n * friction.potential + 0.5 * c * nearing * nearing;
        samples_[lagged.sample].point.scatter(
            Vec3(lagged.friction_n * friction.force_over_slip * slip.along +
                 c * nearing * lagged.normal),
            gradient);
    }
    return sum;
}

void ObstacleContact::add_hessian(const solve::ImplicitStep& step, const Points& x,
                                  solve::Curvature curvature,
                                  solve::HessianBuilder& hessian) const {
    const PlacedShape shape = obstacle_->at(step.end_s);
    for (const ContactSample& sample : samples_) {
        const Vec3 p = sample.point.of(x);
        const Distance distance = shape.distance(p);
        const Penalty penalty = contact::penalty(distance.gap_m, material_.thickness_m);
        if (penalty.pressure == 0) continue;
        const double stiffness = material_.stiffness_pa_per_m * sample.area_m2;
        Mat3 block =
            stiffness * (penalty.slope * distance.gradient * distance.gradient.transpose() -
                         penalty.pressure * shape.curvature(p));
        if (curvature == solve::Curvature::kPositive) block = positive_part(block);
        sample.point.scatter(block, hessian);
    }
    if (step.rate_hz() == 0 || lagged_.empty()) return;
    const Rigid motion = carried(step);
    const double e = material_.slip_speed_m_per_s * step.step_s;
    for (const Lagged& lagged : lagged_) {
        const Slip slip = slip_of(lagged, motion, x);
        const Mat3 along = lagged.normal * lagged.normal.transpose();
        const Mat3 across = Mat3::Identity() - along;
        const SlipShape friction = slip_shape(slip.along.norm(), e);
        Mat3 block = lagged.friction_n * across * slip_curvature(slip.along, friction) * across;
        if (slip.apart < 0) block += lagged.damping * step.rate_hz() * along;
        samples_[lagged.sample].point.scatter(block, hessian);
    }
}

void ObstacleContact::add_metric(double, solve::MetricBuilder& metric) const {
    for (const ContactSample& sample : samples_)
        sample.point.scatter(0.5 * material_.stiffness_pa_per_m * sample.area_m2, metric);
}

double ObstacleContact::min_gap_m(double t_s, const Points& x) const {
    const PlacedShape shape = obstacle_->at(t_s);
    double min = std::numeric_limits<double>::infinity();
    for (const ContactSample& sample : samples_)
        min = std::min(min, shape.distance(sample.point.of(x)).gap_m);
    return min;
}

int ObstacleContact::touching(double t_s, const Points& x) const {
    const PlacedShape shape = obstacle_->at(t_s);
    return static_cast<int>(std::count_if(samples_.begin(), samples_.end(), [&](const auto& s) {
        return shape.distance(s.point.of(x)).gap_m < material_.thickness_m;
    }));
}

Vec3 ObstacleContact::total_force(double t_s, const Points& x, const Points& v) const {
    const PlacedShape shape = obstacle_->at(t_s);
    Vec3 sum = Vec3::Zero();
    for (const ContactSample& sample : samples_) sum += force_on(shape, sample, x, v);
    return sum;
}

}  // namespace risorius::contact
