// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/jaw_joint.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace risorius::face {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Of the average adult, mm in the head frame
const Vec3 kIncisor(0, -52.0, 86.5), kStomion(0, -52.5, 94.0);
const Vec3 kMolarLeft(22.6, -48.0, 58.4);
const Vec3 kOcclusalNormal = Vec3(0, 0.982, -0.19).normalized();
constexpr double kHalfWidth_mm = 50;
constexpr double kOverbite_mm = 1.7, kOverjet_mm = 1.8;
constexpr double kCusp_mm = 1.0, kFossa_mm = 3.0;  // height of the cusps, distance to leave a fossa

// Path of a condyle on the eminence: 12 mm forward, 5 mm down, from -40 to -10 degrees
constexpr double kPath_mm = 12, kPathDrop_mm = -5;
const double kFirstSlope = std::tan(-40 * kDegree), kLastSlope = std::tan(-10 * kDegree);

// Limits. The temporomandibular ligament limits the rotation on resting condyles; the limit grows as they slide forward. Other ligaments
// let a condyle slide less far in a closed jaw than in an open one.
constexpr double kForwardEnd_mm = 12.5, kForwardEndClosed_mm = 8.5, kFreeTurn_deg = 15;
constexpr double kForwardStop_n_per_m = 60e3;
constexpr double kRetrusion_mm = 0.7, kBackPad_n_per_m = 40e3, kBackStop_n_per_m = 400e3;
constexpr double kHingeTurn_deg = 17, kFullTurn_deg = 32, kTurnStop_n_m = 80;  // per rad
constexpr double kCapsule_n_per_m = 100e3;                                     // sideways
constexpr double kTooth_n_per_m = 2e6;

// 0 to 1 with level ends, and its derivative.
double blend(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}
double blend_slope(double t) { return t <= 0 || t >= 1 ? 0.0 : 6 * t * (1 - t); }

}  // namespace

JawVector along(const JawPose& pose, const Wrench& wrench) {
    JawVector work = JawVector::Zero();
    const Vec3 torque = wrench.torque_nm - pose.centre.cross(wrench.force_n);
    for (int k = 0; k < kMandibleCoordinates; ++k)
        work[k] = wrench.force_n.dot(pose.shift[k]) + torque.dot(pose.turn[k]);
    return work;
}

JawVector solved_positive(const JawMatrix& matrix, const JawVector& right) {
    return matrix.llt().solve(right);
}

JawJoint::JawJoint(const rig::Head& head, const rig::JawDescription& description)
    : size_(head.size) {
    hinge_ = head.mm(1.0) * description.hinge_mm;
    // The front teeth lie behind the lips of this head, the others as in the average head
    incisor_ = head.landmark("sto") + head.mm(1.0) * (kIncisor - kStomion);
    const double ahead = incisor_.z() - head.mm(kIncisor.z());
    for (int side = 0; side < 2; ++side) {
        molar_[side] = head.mm(1.0) * kMolarLeft;
        molar_[side].z() += 0.5 * ahead;
        if (side == 1) molar_[side].x() *= -1;
    }
    half_width_m_ = head.mm(kHalfWidth_mm);
    const Vec3 arm = incisor_ - hinge_;
    lever_m_ = std::hypot(arm.y(), arm.z());
    opening_ = Vec3(0, -arm.z(), arm.y()) / lever_m_;
}

JawJoint::Height JawJoint::eminence(double s) const {
    const double end = kPath_mm * 1e-3 * size_, drop = kPathDrop_mm * 1e-3 * size_;
    if (s <= 0) return {kFirstSlope * s, kFirstSlope};
    if (s >= end) return {drop + kLastSlope * (s - end), kLastSlope};
    // Cubic Hermite interpolation
    const double t = s / end, u = 1 - t;
    return {
        end * (kFirstSlope * t * u * u - kLastSlope * t * t * u) + drop * blend(t),
        kFirstSlope * u * (1 - 3 * t) - kLastSlope * t * (2 - 3 * t) + drop / end * blend_slope(t)};
}

void JawJoint::close_with(double force_n) {
    const double arm = molars(pose(JawVector::Zero()), 0).slope[kOpen];
    resting_depth_m_ = std::max(0.0, force_n / (2 * kTooth_n_per_m * -arm));
}

JawPose JawJoint::pose(const JawVector& q) const {
    const Height left = eminence(q[kSlideLeft]), right = eminence(q[kSlideRight]);
    const double width = 2 * half_width_m_;
    const double ds = q[kSlideLeft] - q[kSlideRight], dy = left.value - right.value;
    const double across = std::hypot(width, ds), squared = across * across + dy * dy;
    const double yaw = std::atan2(-ds, width), roll = std::atan2(dy, across),
                 turn = q[kOpen] / lever_m_;

    JawPose pose;
    pose.centre = hinge_ + Vec3(q[kSideways], 0.5 * (left.value + right.value),
                                0.5 * (q[kSlideLeft] + q[kSlideRight]));
    const Mat3 yawed = Eigen::AngleAxisd(yaw, Vec3::UnitY()).toRotationMatrix();
    const Mat3 axes = yawed * Eigen::AngleAxisd(roll, Vec3::UnitZ()).toRotationMatrix();
    pose.motion.linear() = axes * Eigen::AngleAxisd(turn, Vec3::UnitX()).toRotationMatrix();
    pose.motion.translation() = pose.centre - pose.motion.linear() * hinge_;

    pose.turn[kOpen] = axes.col(0) / lever_m_;
    pose.shift[kOpen].setZero();
    pose.turn[kSideways].setZero();
    pose.shift[kSideways] = Vec3::UnitX();
    for (const auto& [k, sign, slope] :
         {std::tuple{kSlideLeft, 1.0, left.slope}, std::tuple{kSlideRight, -1.0, right.slope}}) {
        const double yaw_rate = -sign * width / (across * across);
        const double roll_rate = sign * (across * slope - dy * ds / across) / squared;
        pose.turn[k] = yaw_rate * Vec3::UnitY() + roll_rate * yawed.col(2);
        pose.shift[k] = Vec3(0, 0.5 * slope, 0.5);
    }
    return pose;
}

JawPlace JawJoint::place(const JawVector& q) const {
    const Vec3 moved = pose(q).motion * incisor_ - incisor_;
    return {q[kOpen] / lever_m_, moved.dot(opening_), 0.5 * (q[kSlideLeft] + q[kSlideRight]),
            moved.x()};
}

JawPlace JawJoint::place(const Rigid& motion) const {
    // A jaw given as a motion: its turn about the transverse axis, and where its hinge went
    const Vec3 moved = motion * incisor_ - incisor_;
    const Vec3 ahead = motion.linear() * Vec3::UnitZ();
    return {std::atan2(-ahead.y(), std::hypot(ahead.x(), ahead.z())), moved.dot(opening_),
            (motion * hinge_ - hinge_).z(), moved.x()};
}

// A point of the mandible below a surface of the skull: c = up . (moved - rest) - guide(moved - rest).
JawJoint::Limit JawJoint::tooth(const JawPose& pose, const Vec3& rest, const Vec3& up,
                                const Guide& guide) {
    const Vec3 now = pose.motion * rest;
    Eigen::Matrix<double, 3, kMandibleCoordinates> moves;
    for (int k = 0; k < kMandibleCoordinates; ++k) moves.col(k) = pose.velocity(k, now);
    Limit limit;
    limit.depth = up.dot(now - rest) - guide.height;
    limit.slope.head<kMandibleCoordinates>() = moves.transpose() * (up - guide.slope);
    limit.bend.topLeftCorner<kMandibleCoordinates, kMandibleCoordinates>() =
        -moves.transpose() * guide.bend * moves;
    return limit;
}

JawJoint::Limit JawJoint::incisors(const JawPose& pose) const {
    // Moving forward, the lower incisors slide down the back of the upper ones
    const double overbite = 1e-3 * size_ * kOverbite_mm, overjet = 1e-3 * size_ * kOverjet_mm;
    const double t = (pose.motion * incisor_ - incisor_).z() / overjet;
    Guide guide{-overbite * blend(t) - bite_block_m_,
                Vec3(0, 0, -overbite / overjet * blend_slope(t))};
    if (t > 0 && t < 0.5) guide.bend(2, 2) = -overbite * (6 - 12 * t) / (overjet * overjet);
    return tooth(pose, incisor_, Vec3::UnitY(), guide);
}

JawJoint::Limit JawJoint::molars(const JawPose& pose, int side) const {
    // Out of the fossa in any direction, cusps lie on cusps
    const double cusp = 1e-3 * size_ * kCusp_mm, way = 1e-3 * size_ * kFossa_mm;
    Vec3 aside = pose.motion * molar_[side] - molar_[side];
    aside.y() = 0;
    const double t = aside.norm() / way;
    Guide guide{-cusp * blend(t)};
    if (t < 1) {
        const double rise = cusp / (way * way);
        guide.slope = -rise * 6 * (1 - t) * aside;
        const Vec3 outward = t > 0 ? Vec3(aside.normalized()) : Vec3::Zero();
        guide.bend = -rise * (6 * (1 - t) * Vec3(1, 0, 1).asDiagonal().toDenseMatrix() -
                              std::min(6 * t, 6 * (1 - t)) * outward * outward.transpose());
    }
    return tooth(pose, molar_[side], kOcclusalNormal, guide);
}

double JawJoint::add_stops(const JawVector& q, const JawPose& pose, JawVector& gradient,
                           JawMatrix& hessian) const {
    double energy = 0;
    const auto stop = [&](const Limit& limit, double stiffness) {
        if (limit.depth <= 0) return;
        energy += 0.5 * stiffness * limit.depth * limit.depth;
        gradient += stiffness * limit.depth * limit.slope;
        hessian += stiffness * (limit.slope * limit.slope.transpose() + limit.depth * limit.bend);
    };
    const double mm = 1e-3 * size_;
    const double turn = q[kOpen] / lever_m_;
    const double farther = (kForwardEnd_mm - kForwardEndClosed_mm) * mm / (kFreeTurn_deg * kDegree);
    for (const int k : {kSlideLeft, kSlideRight}) {
        stop({q[k] - kForwardEnd_mm * mm, JawVector::Unit(k)}, kForwardStop_n_per_m);
        Limit closed{q[k] - kForwardEndClosed_mm * mm - farther * turn, JawVector::Unit(k)};
        closed.slope[kOpen] = -farther / lever_m_;
        stop(closed, kForwardStop_n_per_m);
        stop({-q[k], -JawVector::Unit(k)}, kBackPad_n_per_m);
        stop({-q[k] - kRetrusion_mm * mm, -JawVector::Unit(k)}, kBackStop_n_per_m);
    }
    const double per_slide = (kFullTurn_deg - kHingeTurn_deg) * kDegree / (kPath_mm * mm);
    Limit ligament{
        turn - kHingeTurn_deg * kDegree - per_slide * 0.5 * (q[kSlideLeft] + q[kSlideRight]),
        JawVector::Unit(kOpen) / lever_m_};
    ligament.slope[kSlideLeft] = ligament.slope[kSlideRight] = -0.5 * per_slide;
    stop(ligament, kTurnStop_n_m);
    energy += 0.5 * kCapsule_n_per_m * q[kSideways] * q[kSideways];
    gradient[kSideways] += kCapsule_n_per_m * q[kSideways];
    hessian(kSideways, kSideways) += kCapsule_n_per_m;
    stop(incisors(pose), kTooth_n_per_m);
    for (int side = 0; side < 2; ++side) {
        Limit molar = molars(pose, side);
        molar.depth += resting_depth_m_;
        stop(molar, kTooth_n_per_m);
    }
    return energy;
}

double JawJoint::incisor_force_n(const JawVector& q) const {
    return kTooth_n_per_m * std::max(0.0, incisors(pose(q)).depth);
}

double JawJoint::tooth_force_n(const JawVector& q) const {
    const JawPose now = pose(q);
    double depth = std::max(0.0, incisors(now).depth);
    for (int side = 0; side < 2; ++side)
        depth += std::max(0.0, molars(now, side).depth + resting_depth_m_);
    return kTooth_n_per_m * depth;
}

}  // namespace risorius::face
