// SPDX-License-Identifier: MIT
/// \file
/// Rigid obstacles that soft bodies touch. A shape is given by its signed distance, and its place may move.
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
    /// Gradient of the gap. It points out of the shape. Its length is 1, or nearly 1 where the gap is interpolated.
    Vec3 gradient;
};

/// A shape in its own frame; p is a point in this frame, m. Several threads may call the functions.
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

/// Place and velocity of a rigid body at one time.
struct RigidState {
    Rigid place = Rigid::Identity();
    Vec3 velocity_m_per_s = Vec3::Zero();  ///< of the origin of `place`
    Vec3 spin_rad_per_s = Vec3::Zero();    ///< in world axes
};
using RigidMotion = std::function<RigidState(double t_s)>;

/// A body that stays at `place`.
RigidMotion standing(const Rigid& place);
/// A body that is at `start` at time 0, moves at constant velocity and rotates about its own origin at a constant rate.
RigidMotion steady(const Rigid& start, const Vec3& velocity_m_per_s,
                   const Vec3& spin_rad_per_s = Vec3::Zero());
/// A body that stays at `from` until `start_s`, moves to `to` with a smooth start and end until `end_s`, and stays there.
RigidMotion gliding(const Rigid& from, const Rigid& to, double start_s, double end_s);

/// The place for make_plane(): it moves the plane z = 0 to the plane through `point`. `normal` points out of the obstacle.
Rigid plane_place(const Vec3& point, const Vec3& normal);

/// A shape at its place at one time. Points p are in world coordinates, m.
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

/// A shape and its motion.
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
