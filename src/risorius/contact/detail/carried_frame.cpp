// SPDX-License-Identifier: MIT
#include "risorius/contact/detail/carried_frame.h"

#include "risorius/core/cross_matrix.h"

namespace risorius::contact {

namespace {

/// Derivative of b - a by corner i.
constexpr double kAlong[3] = {-1, 1, 0};

/// Derivative by corner j of the side that belongs to the rotation by corner i: b - c, c - a, a - b.
double side_fraction(int i, int j) { return j == i ? 0.0 : (j == (i + 1) % 3 ? 1.0 : -1.0); }

}  // namespace

CarriedFrame::CarriedFrame(const Vec3& p, const std::array<Vec3, 3>& corners, const Vec3& weights)
    : weights_(weights) {
    const Vec3 side = corners[1] - corners[0];
    const Vec3 normal = side.cross(corners[2] - corners[0]);
    length_ = side.norm();
    twice_area_ = normal.norm();
    axes_.col(0) = side / length_;
    axes_.col(2) = normal / twice_area_;
    axes_.col(1) = axes_.col(2).cross(axes_.col(0));
    offset_ = p - weights(0) * corners[0] - weights(1) * corners[1] - weights(2) * corners[2];
    place_ = axes_.transpose() * offset_;

    // The normal tilts when corners leave the plane. The first side determines the rest of the rotation.
    const Vec3 e2 = axes_.col(1), e3 = axes_.col(2);
    const Mat3 d_cross = cross_matrix(offset_), back = axes_.transpose();
    spin_[0].setZero();
    slope_[0] = back;
    for (int i = 0; i < 3; ++i) {
        turn_[i] = (corners[(i + 1) % 3] - corners[(i + 2) % 3]) / twice_area_;
        spin_[i + 1] = -turn_[i] * e3.transpose() + kAlong[i] / length_ * e3 * e2.transpose();
        slope_[i + 1] = back * (d_cross * spin_[i + 1] - weights_(i) * Mat3::Identity());
    }
}

Mat3 CarriedFrame::second_slope(const Vec3& y, int first, int second) const {
    // The first derivative by p is Y = R y; by corner i it is -w_i Y + spin_i^T m with m = Y x d.
    const Vec3 Y = axes_ * y, m = Y.cross(offset_);
    const Mat3& spin = spin_[second];
    const Mat3 dY = -cross_matrix(Y) * spin;
    if (first == 0) return dY;
    const int i = first - 1, j = second - 1;
    const Vec3 e1 = axes_.col(0), e2 = axes_.col(1), e3 = axes_.col(2);
    const double fraction = second == 0 ? 1.0 : -weights_(j);
    const Mat3 dm = -cross_matrix(offset_) * dY + fraction * cross_matrix(Y);
    Mat3 sum = -weights_(i) * dY + spin_[first].transpose() * dm;
    if (second == 0) return sum;

    // The change of spin_i itself.
    const Mat3 de3 = -cross_matrix(e3) * spin, de2 = -cross_matrix(e2) * spin;
    // Gradient of the area by corner j, divided by the area.
    const Vec3 area_fraction = -e3.cross(turn_[j]);
    const double k = kAlong[i] / length_, tip = e3.dot(m);
    sum -= turn_[i].dot(m) * de3;
    sum -=
        e3 * (side_fraction(i, j) / twice_area_ * m - turn_[i].dot(m) * area_fraction).transpose();
    sum += k * tip * de2;
    sum -= k / length_ * tip * kAlong[j] * e2 * e1.transpose();
    sum += k * e2 * (de3.transpose() * m).transpose();
    return sum;
}

}  // namespace risorius::contact
