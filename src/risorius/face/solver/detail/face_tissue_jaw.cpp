// SPDX-License-Identifier: MIT
// One solve for tissue and jaw. The unknowns are the nodes relative to a face that follows the mandible, and the coordinates of the jaw:
//   x_i = d_i + w_i (T(q) - T(q_n)) X_i,   min over d, q of E_tissue(x, T(q)) + E_jaw(q)
// The method is L-BFGS. Its metric has one block for the tissue and one for the jaw. The latter is the second derivative of the energy
// of the jaw, plus that of the resting tissue which follows it.
#include <algorithm>

#include "risorius/core/dense_algebra.h"
#include "risorius/face/solver/detail/face_tissue.h"

namespace risorius::face {

namespace {

constexpr int kJawRows = 3;  // rows of the unknowns that hold q, below the nodes
constexpr double kDifference_m =
    50e-6;  // step of the difference quotient for the stiffness of the tissue

JawVector jaw_of(const Points& unknowns) {
    JawVector q;
    for (int k = 0; k < kJawCoordinates; ++k)
        q[k] = unknowns(unknowns.rows() - kJawRows + k / 3, k % 3);
    return q;
}

void put_jaw(const JawVector& q, Points& unknowns) {
    unknowns.bottomRows<kJawRows>().setZero();
    for (int k = 0; k < kJawCoordinates; ++k)
        unknowns(unknowns.rows() - kJawRows + k / 3, k % 3) = q[k];
}

}  // namespace

void FaceTissue::move_mandible(const Rigid& moved) {
    mandible_ = moved;
    terms_.move_mandible(moved);
}

const JawMatrix& FaceTissue::ride_stiffness(double h) const {
    return std::find_if(ride_stiffness_.begin(), ride_stiffness_.end(),
                        [&](const auto& known) { return known.first == h; })
        ->second;
}

void FaceTissue::prepare(double h, const JawDynamics& jaw) {
    metric(h);
    const Points& rest = rest_;
    const Eigen::VectorXd relaxed = Eigen::VectorXd::Zero(rig_.channels().column_count());
    set_boundary_conditions({});
    find_contacts(rest);
    begin_step(h, rest, relaxed);
    JawMatrix stiffness = JawMatrix::Zero();
    // Volume muscles hardly change volume. Before they have adapted their shape, they seem far stiffer than they are for a held jaw
    inputs_.solids_relaxed = h >= kSettling_s;
    for (int k = 0; k < kMandibleCoordinates; ++k) {
        // One-sided difference in the opening direction; the other way, teeth and eminence would touch
        const JawPose pose = jaw.joint().pose(kDifference_m * JawVector::Unit(k));
        carried_ = rest;
        carry_with_bone(carried_, Rigid::Identity(), pose.motion);
        move_mandible(pose.motion);
        step_energy(h, rest, relaxed, carried_, carried_gradient_);
        stiffness.col(k) =
            along(pose, terms_.mandible_gradient(mandible_, carried_, carried_gradient_)) /
            kDifference_m;
    }
    inputs_.solids_relaxed = false;
    set_boundary_conditions({});
    stiffness = positive_part(0.5 * (stiffness + stiffness.transpose()));
    std::erase_if(ride_stiffness_, [&](const auto& known) { return known.first == h; });
    ride_stiffness_.push_back({h, stiffness});
}

StepStats FaceTissue::implicit_step(double h, const Points& start, const Points& aim,
                                    const Eigen::VectorXd& activation,
                                    const solve::QuasiNewtonOptions& options, Points& x,
                                    JawInStep& jaw) {
    const long rows = x.rows();
    const JawJoint& joint = jaw.dynamics.joint();
    const Rigid from = joint.pose(jaw.q).motion;
    const auto energy = [&](const Points& unknowns, Points& gradient) {
        const JawVector q = jaw_of(unknowns);
        const JawPose pose = joint.pose(q);
        move_mandible(pose.motion);
        carried_ = unknowns.topRows(rows);
        carry_with_bone(carried_, from, pose.motion);
        carried_gradient_.resize(rows, 3);
        double sum = step_energy(h, aim, activation, carried_, carried_gradient_);
        JawVector by_jaw;
        JawMatrix unused;
        sum += jaw.dynamics.energy(jaw.step, q, by_jaw, unused);
        by_jaw += along(pose, terms_.mandible_gradient(mandible_, carried_, carried_gradient_));
        gradient.topRows(rows) = carried_gradient_;
        put_jaw(by_jaw, gradient);
        return sum;
    };

    begin_step(h, start, activation);

    // First the jaw alone, with linear forces of the tissue
    Points unknowns(rows + kJawRows, 3), gradient(rows + kJawRows, 3);
    unknowns.topRows(rows) = x;
    put_jaw(jaw.q, unknowns);
    energy(unknowns, gradient);
    JawVector own;
    JawMatrix stiffness;
    jaw.dynamics.energy(jaw.step, jaw.q, own, stiffness);
    const JawLoad load{jaw.q, jaw_of(gradient) - own, ride_stiffness(h)};
    jaw.dynamics.minimise(jaw.step, jaw.q, &load);
    put_jaw(jaw.q, unknowns);

    // Then jaw and tissue together
    jaw.dynamics.energy(jaw.step, jaw.q, own, stiffness);
    const JawMatrix jaw_metric = stiffness + load.stiffness;
    const solve::SparseCholesky& tissue_metric = metric(h);
    Points tissue_part, tissue_move;
    const solve::StepReport report = newton_.minimise(
        energy,
        [&](const Points& b, Points& y) {
            y.resize(b.rows(), 3);
            tissue_part = b.topRows(rows);
            solids_->precondition(tissue_metric, tissue_part, tissue_move);
            y.topRows(rows) = tissue_move;
            put_jaw(solved_positive(jaw_metric, jaw_of(b)), y);
        },
        unknowns, options);
    jaw.q = jaw_of(unknowns);
    const Rigid to = joint.pose(jaw.q).motion;
    move_mandible(to);
    x = unknowns.topRows(rows);
    carry_with_bone(x, from, to);
    refine(h, start, aim, activation, options, x);
    return end_step(report, x);
}

}  // namespace risorius::face
