// SPDX-License-Identifier: MIT
/// \file
/// The joint of mandible and skull: two condyles that slide on the articular eminences and rotate, ligaments that limit them, and the
/// teeth, on which the closed jaw rests.
///
///   q   open, slide left, slide right, side, hyoid x, y, z, all in m:
///       open   angle of rotation about the line through both condyles, rad, times the distance of the incisors from it, m
///       slide  forward travel of a condyle; its height follows the eminence
///       side   travel of both condyles to the subject's left
///       hyoid  displacement of the hyoid bone
///   E_stop = sum k/2 max(0, c(q))^2 over the limits      c  how far q is beyond a limit, m      k  stiffness, N/m
///
/// The condyles stay on their eminences: disc and capsule are assumed to be rigid across the path. Otherwise the equations would be stiff.
/// Sources of ranges and path: Hannam et al. 2008; Travers 2000; Ferrario 2005. The stiffness of the limits is chosen so that the largest
/// muscle forces exceed them by less than a millimetre.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/wrench.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

enum JawCoordinate { kOpen, kSlideLeft, kSlideRight, kSideways, kHyoid, kJawCoordinates = 7 };
inline constexpr int kMandibleCoordinates = 4;
using JawVector = Eigen::Matrix<double, kJawCoordinates, 1>;
using JawMatrix = Eigen::Matrix<double, kJawCoordinates, kJawCoordinates>;

/// Motion of the mandible from rest, and its derivatives by its four coordinates.
struct JawPose {
    Rigid motion = Rigid::Identity();
    Vec3 centre = Vec3::Zero();  ///< the middle between the condyles, m
    /// Rotation of the mandible, rad/m, and displacement of its centre, m/m, per coordinate.
    std::array<Vec3, kMandibleCoordinates> turn, shift;

    /// Returns the displacement of a point of the mandible per m of coordinate k. `place` is its current position, m.
    Vec3 velocity(int k, const Vec3& place) const {
        return shift[k] + turn[k].cross(place - centre);
    }
};

/// Returns the generalised force of a wrench on the mandible along each coordinate, N; zero along those of the hyoid.
JawVector along(const JawPose& pose, const Wrench& wrench);

/// Solves matrix x = right for x. The matrix is symmetric and positive. It is compiled only once, because it takes seconds.
JawVector solved_positive(const JawMatrix& matrix, const JawVector& right);

/// Position of the jaw in quantities that are usually measured.
struct JawPlace {
    double open_rad = 0;   ///< opening angle
    double open_m = 0;     ///< travel of the lower incisors in the direction of opening
    double forward_m = 0;  ///< mean slide of the condyles
    double side_m = 0;     ///< travel of the lower incisors to the subject's left
};

/// The joint of one head.
class JawJoint {
  public:
    JawJoint(const rig::Head& head, const rig::JawDescription& description);

    JawPose pose(const JawVector& q) const;
    JawPlace place(const JawVector& q) const;
    JawPlace place(const Rigid& motion) const;  ///< for any motion of the mandible from rest

    /// Returns E_stop, J, and adds its gradient and a positive approximation of its second derivative.
    double add_stops(const JawVector& q, const JawPose& pose, JawVector& gradient,
                     JawMatrix& hessian) const;

    /// Sets the force along kOpen, N, with which the molars are pressed together at rest.
    void close_with(double force_n);
    /// Puts a rigid object of this height between the incisors; 0: none.
    void set_bite_block(double height_m) { bite_block_m_ = height_m; }
    /// Return the bite force of the lower incisors, and of all teeth, N.
    double incisor_force_n(const JawVector& q) const;
    double tooth_force_n(const JawVector& q) const;

    /// Height h, m, of a condyle over its rest position after it has slid forward by s, m; and its slope dh/ds.
    struct Height {
        double value, slope;
    };
    Height eminence(double s) const;

    double size() const { return size_; }        ///< of the head, relative to the standard head
    double lever_m() const { return lever_m_; }  ///< incisors to hinge axis
    const Vec3& hinge() const { return hinge_; }
    const Vec3& incisor() const { return incisor_; }

  private:
    /// c of one limit, its gradient, and the positive part of its second derivative.
    struct Limit {
        double depth = 0;
        JawVector slope = JawVector::Zero();
        JawMatrix bend = JawMatrix::Zero();
    };
    /// A surface of the skull that a tooth rests on: allowed height, and its derivatives by the tooth's position.
    struct Guide {
        double height = 0;
        Vec3 slope = Vec3::Zero();
        Mat3 bend = Mat3::Zero();  ///< second derivative
    };
    Limit incisors(const JawPose& pose) const;
    Limit molars(const JawPose& pose, int side) const;
    static Limit tooth(const JawPose& pose, const Vec3& rest, const Vec3& up, const Guide& guide);

    double size_;
    Vec3 hinge_, incisor_;
    std::array<Vec3, 2> molar_;
    double half_width_m_, lever_m_;
    Vec3 opening_;  // direction in which the incisors begin to open
    double bite_block_m_ = 0, resting_depth_m_ = 0;
};

}  // namespace risorius::face
