// SPDX-License-Identifier: MIT
/// \file
/// Rigid obstacles that soft bodies touch: shapes given by signed distances, with a place that may move.
///
///   gap   signed distance from the surface, m, negative inside
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "risorius/core/types.h"

namespace risorius::contact {

/// The gap at a point, and its gradient.
struct Distance {
    double gap_m;
    /// Of the gap, pointing out of the shape; its length is 1, or nearly 1 where the gap is interpolated.
    Vec3 gradient;
};

/// A shape in its own frame. Queries may run in parallel.
class Shape {
  public:
    virtual ~Shape() = default;
    virtual Distance distance(const Vec3& p) const = 0;
    virtual Mat3 curvature(const Vec3& p) const = 0;  ///< second derivative of the gap, 1/m
};

/// The half-space z < 0.
std::shared_ptr<const Shape> make_plane();
/// A sphere around the origin. make_sphere() and make_capsule() throw Error, with a place that begins with `place`, unless
/// every size is > 0 and finite.
std::shared_ptr<const Shape> make_sphere(double radius_m, const std::string& place = "sphere");
/// All points within `radius_m` of the segment from `start` to `end`.
std::shared_ptr<const Shape> make_capsule(const Vec3& start, const Vec3& end, double radius_m,
                                          const std::string& place = "capsule");

/// Place and velocity of a rigid body.
struct RigidState {
    Rigid place = Rigid::Identity();
    Vec3 velocity_m_per_s = Vec3::Zero();  ///< of the origin of its place
    Vec3 spin_rad_per_s = Vec3::Zero();    ///< in world axes
};
using RigidMotion = std::function<RigidState(double t_s)>;

/// Stays at `place`.
RigidMotion standing(const Rigid& place);
/// At `start` at time 0, moving at constant velocity and rotating about its own origin at a constant rate.
RigidMotion steady(const Rigid& start, const Vec3& velocity_m_per_s,
                   const Vec3& spin_rad_per_s = Vec3::Zero());
/// Stays at `from`, moves to `to` between the two times with a smooth start and end, and stays there.
RigidMotion gliding(const Rigid& from, const Rigid& to, double start_s, double end_s);

/// The place that moves the plane z = 0 to the plane through `point` whose `normal` points out of the solid.
Rigid plane_place(const Vec3& point, const Vec3& normal);

/// A shape at its place at one time.
class PlacedShape {
  public:
    PlacedShape(const Shape& shape, const RigidState& state)
        : shape_(&shape), state_(state), to_shape_(state.place.inverse()) {}

    Distance distance(const Vec3& p) const;
    Mat3 curvature(const Vec3& p) const;
    Vec3 velocity(const Vec3& p) const;  ///< velocity of the shape's material at p, m/s
    const Rigid& place() const { return state_.place; }

  private:
    const Shape* shape_;
    RigidState state_;
    Rigid to_shape_;
};

/// A shape with its motion.
class Obstacle {
  public:
    explicit Obstacle(std::shared_ptr<const Shape> shape, RigidMotion motion);
    explicit Obstacle(std::shared_ptr<const Shape> shape, const Rigid& place = Rigid::Identity())
        : Obstacle(std::move(shape), standing(place)) {}

    PlacedShape at(double t_s) const { return {*shape_, motion_(t_s)}; }

  private:
    std::shared_ptr<const Shape> shape_;
    RigidMotion motion_;
};

}  // namespace risorius::contact
