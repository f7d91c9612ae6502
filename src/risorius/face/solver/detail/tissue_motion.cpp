// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/tissue_motion.h"

#include <algorithm>

namespace risorius::face {

TissueMotion::TissueMotion(const Neck& neck, const Points& rest, double step_s)
    : neck_(neck), step_s_(step_s) {
    for (long i = 0; i < rest.rows(); ++i)
        fraction_.push_back(neck.fraction(rest.row(i).transpose()));
    start(rest, Rigid::Identity());
}

void TissueMotion::start(const Points& x, const Rigid& head) {
    now_ = before_ = space_now_ = space_before_ = x;
    velocity_ = velocity_before_ = Points::Zero(x.rows(), 3);
    head_ = next_head_ = head;
    moved_before_ = Rigid::Identity();
}

// Returns M. If the head jumps, M is limited so that it differs from the M before by kMaxFelt_m_s2 at most.
Rigid TissueMotion::felt(const Rigid& head) {
    const Rigid moved = head.isApprox(head_, 0.0) ? Rigid::Identity() : head.inverse() * head_;
    double jolt = 0;
    for (const double y : {-0.1, 0.1}) {  // chin and forehead
        const Vec3 p(0, y, 0.1);
        jolt = std::max(jolt, (moved * p - moved_before_ * p).norm() / (step_s_ * step_s_));
    }
    if (jolt <= kMaxFelt_m_s2) return moved;
    const double fraction = kMaxFelt_m_s2 / jolt;
    Rigid out = Rigid::Identity();
    out.translate((1 - fraction) * moved_before_.translation() + fraction * moved.translation());
    out.rotate(Eigen::Quaterniond(moved_before_.linear())
                   .slerp(fraction, Eigen::Quaterniond(moved.linear())));
    return out;
}

const TissueMotion::Step& TissueMotion::begin(const Rigid& head) {
    next_head_ = head;
    step_.moved = felt(head);
    if (!step_.moved.isApprox(Rigid::Identity(), 0.0)) {
        const auto carry = [](const Rigid& by, Points& points, Points& vectors, long i) {
            points.row(i) = (by * Vec3(points.row(i).transpose())).transpose();
            vectors.row(i) = (by.linear() * Vec3(vectors.row(i).transpose())).transpose();
        };
        for (long i = 0; i < now_.rows(); ++i) {
            const Rigid by = neck_.part(step_.moved, fraction_[static_cast<std::size_t>(i)]);
            carry(by, space_now_, velocity_, i);
            carry(by, space_before_, velocity_before_, i);
        }
    }
    step_.start = (4 * now_ - before_) / 3;
    step_.expected = 2 * now_ - before_;
    step_.aim = (4 * space_now_ - space_before_) / 3 +
                effective_step_s() * (4 * velocity_ - velocity_before_) / 3;
    return step_;
}

void TissueMotion::end(const Points& x) {
    velocity_before_.swap(velocity_);
    velocity_ = (3 * x - 4 * space_now_ + space_before_) / (2 * step_s_);
    space_before_.swap(space_now_);
    space_now_ = x;
    before_.swap(now_);
    now_ = x;
    head_ = next_head_;
    moved_before_ = step_.moved;
}

}  // namespace risorius::face
