// SPDX-License-Identifier: MIT
#include "risorius/contact/obstacle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "risorius/core/json_cursor.h"
#include "risorius/core/rotations.h"

namespace risorius::contact {

namespace {

class Plane : public Shape {
  public:
    Distance distance(const Vec3& p) const override { return {p.z(), Vec3::UnitZ()}; }
    Mat3 curvature(const Vec3&) const override { return Mat3::Zero(); }
};

/// All points within a radius of a segment; a sphere when its ends coincide.
class Capsule : public Shape {
  public:
    Capsule(const Vec3& start, const Vec3& end, double radius)
        : start_(start), axis_(end - start), radius_(radius) {}

    Distance distance(const Vec3& p) const override {
        const Vec3 off = from_axis(p);
        const double length = off.norm();
        if (length > 0) return {length - radius_, off / length};
        // On the axis itself, all directions out are equally short.
        return {-radius_, axis_.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(axis_.unitOrthogonal())};
    }

    Mat3 curvature(const Vec3& p) const override {
        const Vec3 off = from_axis(p);
        const double length = off.norm();
        if (!(length > 0)) return Mat3::Zero();
        Mat3 across = Mat3::Identity() - off * off.transpose() / (length * length);
        const double s = fraction(p);
        // No curvature along the side.
        if (s > 0 && s < 1) across -= axis_ * axis_.transpose() / axis_.squaredNorm();
        return across / length;
    }

  private:
    double fraction(const Vec3& p) const {
        const double squared = axis_.squaredNorm();
        return squared > 0 ? std::clamp((p - start_).dot(axis_) / squared, 0.0, 1.0) : 0.0;
    }
    Vec3 from_axis(const Vec3& p) const { return p - start_ - fraction(p) * axis_; }

    Vec3 start_, axis_;
    double radius_;
};

Eigen::Quaterniond turn_from_z(const Vec3& direction) {
    constexpr double kNearOpposite = -1 + 1e-12;
    if (direction.normalized().z() >= kNearOpposite) return turn_between(Vec3::UnitZ(), direction);
    const Eigen::Quaterniond half_turn(0, 1, 0, 0);  // about x
    return turn_between(-Vec3::UnitZ(), direction) * half_turn;
}

void check_size(double value, const std::string& place) {
    if (!(value > 0 && std::isfinite(value))) throw Error(place, "(0, inf)", format_number(value));
}

}  // namespace

std::shared_ptr<const Shape> make_plane() { return std::make_shared<Plane>(); }

std::shared_ptr<const Shape> make_sphere(double radius_m, const std::string& place) {
    check_size(radius_m, place + "/radius_m");
    return std::make_shared<Capsule>(Vec3::Zero(), Vec3::Zero(), radius_m);
}

std::shared_ptr<const Shape> make_capsule(const Vec3& start, const Vec3& end, double radius_m,
                                          const std::string& place) {
    check_size(radius_m, place + "/radius_m");
    if (!start.allFinite() || !end.allFinite()) throw Error(place, "finite ends", "NaN or inf");
    check_size((end - start).norm(), place + "/length_m");
    return std::make_shared<Capsule>(start, end, radius_m);
}

RigidMotion standing(const Rigid& place) {
    return [place](double) { return RigidState{place}; };
}

RigidMotion steady(const Rigid& start, const Vec3& velocity_m_per_s, const Vec3& spin_rad_per_s) {
    return [=](double t_s) {
        RigidState state{start, velocity_m_per_s, spin_rad_per_s};
        const double rate = spin_rad_per_s.norm();
        if (rate > 0)
            state.place.linear() =
                Eigen::AngleAxisd(rate * t_s, spin_rad_per_s / rate) * start.linear();
        state.place.translation() = start.translation() + t_s * velocity_m_per_s;
        return state;
    };
}

RigidMotion gliding(const Rigid& from, const Rigid& to, double start_s, double end_s) {
    const Eigen::AngleAxisd turn(Mat3(to.linear() * from.linear().transpose()));
    const Vec3 way = to.translation() - from.translation();
    return [=](double t_s) {
        // Cubic ease: speed and place are continuous at both ends.
        const double duration = end_s - start_s;
        const double s = std::clamp((t_s - start_s) / duration, 0.0, 1.0);
        const double fraction = s * s * (3 - 2 * s), rate = 6 * s * (1 - s) / duration;
        RigidState state{from, rate * way, rate * turn.angle() * turn.axis()};
        state.place.linear() =
            Eigen::AngleAxisd(fraction * turn.angle(), turn.axis()) * from.linear();
        state.place.translation() = from.translation() + fraction * way;
        return state;
    };
}

Rigid plane_place(const Vec3& point, const Vec3& normal) {
    Rigid place = Rigid::Identity();
    place.linear() = turn_from_z(normal).toRotationMatrix();
    place.translation() = point;
    return place;
}

Distance PlacedShape::distance(const Vec3& p) const {
    Distance distance = shape_->distance(to_shape_ * p);
    distance.gradient = state_.place.linear() * distance.gradient;
    return distance;
}

Mat3 PlacedShape::curvature(const Vec3& p) const {
    const Mat3 turn = state_.place.linear();
    return turn * shape_->curvature(to_shape_ * p) * turn.transpose();
}

Vec3 PlacedShape::velocity(const Vec3& p) const {
    return state_.velocity_m_per_s + state_.spin_rad_per_s.cross(p - state_.place.translation());
}

Obstacle::Obstacle(std::shared_ptr<const Shape> shape, RigidMotion motion)
    : shape_(std::move(shape)), motion_(std::move(motion)) {}

}  // namespace risorius::contact
