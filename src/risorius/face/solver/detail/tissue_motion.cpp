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
    const Points still = Points::Zero(x.rows(), 3);
    past_ = {x, x, x, x, still, still, head, Rigid::Identity()};
    next_head_ = head;
}

// Returns M. If the head jumps, M is limited so that it differs from the M before by kMaxFelt_m_s2 at most.
Rigid TissueMotion::felt(const Rigid& head) {
    const Rigid moved =
        head.isApprox(past_.head, 0.0) ? Rigid::Identity() : head.inverse() * past_.head;
    double jolt = 0;
    for (const double y : {-0.1, 0.1}) {  // chin and forehead
        const Vec3 p(0, y, 0.1);
        jolt = std::max(jolt, (moved * p - past_.moved_before * p).norm() / (step_s_ * step_s_));
    }
    if (jolt <= kMaxFelt_m_s2) return moved;
    const double fraction = kMaxFelt_m_s2 / jolt;
    Rigid out = Rigid::Identity();
    out.translate((1 - fraction) * past_.moved_before.translation() +
                  fraction * moved.translation());
    out.rotate(Eigen::Quaterniond(past_.moved_before.linear())
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
        for (long i = 0; i < past_.now.rows(); ++i) {
            const Rigid by = neck_.part(step_.moved, fraction_[static_cast<std::size_t>(i)]);
            carry(by, past_.space_now, past_.velocity, i);
            carry(by, past_.space_before, past_.velocity_before, i);
        }
    }
    step_.start = (4 * past_.now - past_.before) / 3;
    step_.expected = 2 * past_.now - past_.before;
    step_.aim = (4 * past_.space_now - past_.space_before) / 3 +
                effective_step_s() * (4 * past_.velocity - past_.velocity_before) / 3;
    return step_;
}

void TissueMotion::end(const Points& x) {
    past_.velocity_before.swap(past_.velocity);
    past_.velocity = (3 * x - 4 * past_.space_now + past_.space_before) / (2 * step_s_);
    past_.space_before.swap(past_.space_now);
    past_.space_now = x;
    past_.before.swap(past_.now);
    past_.now = x;
    past_.head = next_head_;
    past_.moved_before = step_.moved;
}

}  // namespace risorius::face
