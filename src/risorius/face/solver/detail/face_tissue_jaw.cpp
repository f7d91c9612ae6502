// SPDX-License-Identifier: MIT
// Tissue and jaw in one solve. Unknowns are the nodes relative to a face that rides on the mandible, and the jaw's coordinates:
//   x_i = d_i + w_i (T(q) - T(q_n)) X_i,   min over d, q of E_tissue(x, T(q)) + E_jaw(q)
// by L-BFGS; its metric has a block for the tissue and one for the jaw, second derivatives of the jaw's own energy and of riding
// tissue (at rest).
#include <Eigen/Cholesky>
#include <algorithm>

#include "risorius/core/dense_algebra.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/face/solver/detail/face_tissue.h"

namespace risorius::face {

namespace {

constexpr int kJawRows = 3;              // of coordinates below the nodes
constexpr double kDifference_m = 50e-6;  // of coordinates, for the stiffness of riding

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
    std::vector<tissue::ZeroLengthSprings::Tether>& held = tethers_->list();
    const double chin_back = jaw_.chin_back(moved);
    for (std::size_t i = 0; i < attachments_.size(); ++i) {
        const Vec3 rest = mesh_.nodes.row(held[i].node).transpose();
        held[i].target = attachments_[i].target(rest, moved, chin_back);
    }
    const std::array<Rigid, kBodies> bodies{Rigid::Identity(), moved};
    fibres_->set_body_positions(bodies);
    solids_->move_bodies(bodies);
    lip_drive_->move_mandible(moved);
    for (std::size_t c = 0; c < contacts_.list().size(); ++c)
        if (contacts_.list()[c].body == kMandibleBody)
            contacts_.list()[c].point = moved * contact_on_mandible_[c];
}

Wrench FaceTissue::mandible_gradient(const Points& x, const Points& gradient) const {
    Wrench sum;
    const std::vector<tissue::ZeroLengthSprings::Tether>& held = tethers_->list();
    for (std::size_t i = 0; i < attachments_.size(); ++i) {
        const double fraction = attachments_[i].jaw_weight;
        const Vec3& bulge = attachments_[i].floor_bulge;
        if (fraction == 0 && bulge.isZero(0.0)) continue;
        // Nodes that ride, and what their tether pulls its target with
        for (Layer layer : {kDeep, kMiddle, kSkin}) {
            const int node = node_of(attachments_[i].shell_vertex, layer);
            sum.add(fraction * gradient.row(node).transpose(),
                    mandible_ * Vec3(mesh_.nodes.row(node).transpose()));
        }
        const tissue::ZeroLengthSprings::Tether& t = held[i];
        const Vec3 off = x.row(t.node).transpose() - t.target;
        const Vec3 pull =
            t.kt_n_per_m * off + (t.kn_n_per_m - t.kt_n_per_m) * off.dot(t.normal) * t.normal;
        sum.add(-fraction * pull, mandible_ * Vec3(mesh_.nodes.row(t.node).transpose()));
        // The bulge goes with the chin's way back, -z
        sum.add(bulge.dot(pull) * Vec3::UnitZ(), mandible_ * jaw_.chin());
    }
    for (std::size_t p = 0; p < fibres_->points().size(); ++p) {
        const muscle::FibrePoint& point = fibres_->points()[p];
        if (point.count == 0 && point.body == kMandibleBody)
            sum.add(fibres_->point_gradient(static_cast<int>(p)), mandible_ * point.body_rest);
    }
    for (const tissue::Contacts::Contact& contact : contacts_.list()) {
        if (contact.body != kMandibleBody) continue;
        sum.add(-tissue::Contacts::pull_n(contact, x) * contact.normal, contact.point);
    }
    lip_drive_->add_mandible_gradient(x, sum);
    solids_->add_riding(mandible_, gradient, sum);
    sum.force_n -= solids_pull_[kMandibleBody].force_n;
    sum.torque_nm -= solids_pull_[kMandibleBody].torque_nm;
    return sum;
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
    // Solids hardly change volume: before they have found their shape they look far stiffer than a held jaw finds them
    inputs_.solids_relaxed = h >= kSettling_s;
    for (int k = 0; k < kMandibleCoordinates; ++k) {
        // Opening and forwards only: the other way, teeth and eminence are in the way
        const JawPose pose = jaw.joint().pose(kDifference_m * JawVector::Unit(k));
        carried_ = rest;
        carry_with_bone(carried_, Rigid::Identity(), pose.motion);
        move_mandible(pose.motion);
        step_energy(h, rest, relaxed, carried_, carried_gradient_);
        stiffness.col(k) =
            along(pose, mandible_gradient(carried_, carried_gradient_)) / kDifference_m;
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
        by_jaw += along(pose, mandible_gradient(carried_, carried_gradient_));
        gradient.topRows(rows) = carried_gradient_;
        put_jaw(by_jaw, gradient);
        return sum;
    };

    begin_step(h, start, activation);

    // The jaw alone first, the tissue being linear to it
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

    // Then both
    jaw.dynamics.energy(jaw.step, jaw.q, own, stiffness);
    const Eigen::LLT<JawMatrix> jaw_metric(stiffness + load.stiffness);
    const solve::SparseCholesky& tissue_metric = metric(h);
    Points tissue_part, tissue_move;
    const solve::StepReport report = newton_.minimise(
        energy,
        [&](const Points& b, Points& y) {
            y.resize(b.rows(), 3);
            tissue_part = b.topRows(rows);
            solids_->precondition(tissue_metric, tissue_part, tissue_move);
            y.topRows(rows) = tissue_move;
            put_jaw(jaw_metric.solve(jaw_of(b)), y);
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
