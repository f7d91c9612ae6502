// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/driven_jaw.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

namespace risorius::face {

namespace {

constexpr double kRestStep_s = 0.5;        // length of the time steps towards equilibrium
constexpr int kIterationsOfRestStep = 20;  // per step; each step searches contacts once
constexpr double kRests_m = 5e-6;          // equilibrium: a step moves the nodes less, RMS
constexpr double kRestTolerance_m = 1e-6;
constexpr int kRestMemory = 6;
constexpr double kRestStepCap_m = 6e-3;

}  // namespace

DrivenJaw::DrivenJaw(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw)
    : head_(head), rig_(rig), jaw_(jaw), joint_(head, rig.jaw) {}

void DrivenJaw::drive_by(track::JawDrive by, const track::ChannelTable& channels, double step_s,
                         FaceTissue& tissue) {
    if (by == track::JawDrive::kChannels) {
        dynamics_.reset();
        synergies_.reset();
    } else if (!dynamics_) {
        std::set<std::string> solids;  // these pull in the tissue, not in JawDynamics
        for (const rig::SolidMuscle& solid : rig_.solids) solids.insert(solid.muscle);
        dynamics_.emplace(head_, rig_, solids);
        for (const double h : {step_s, kRestStep_s}) tissue.prepare(h, *dynamics_);
        const auto reach = [&](double open, double forward, double side) {
            return joint_.place(jaw_.motion(open, forward, side));
        };
        // The synergies are computed with lines of action for all muscles; a volume muscle acts nearly like its line
        synergies_.emplace(JawDynamics(head_, rig_), channels,
                           JawSynergies::Ranges{reach(1, 0, 0).open_m, reach(0, 1, 0).forward_m,
                                                reach(0, 0, 1).side_m},
                           tissue.ride_stiffness(kRestStep_s));
    }
}

void DrivenJaw::set_bite_block(double height_m) {
    if (!dynamics_) throw std::logic_error("a bite block in a jaw that channels place");
    dynamics_->joint().set_bite_block(height_m);
}

Rigid DrivenJaw::wanted(const track::Drive& drive) const {
    return jaw_.motion(drive.at(track::Kinematic::kJawOpen),
                       drive.at(track::Kinematic::kJawForward),
                       drive.at(track::Kinematic::kJawSide));
}

Rigid DrivenJaw::motion(const JawVector& q, const track::Drive& drive) const {
    return dynamics_ ? joint_.pose(q).motion : wanted(drive);
}

Eigen::VectorXd DrivenJaw::excitation(const Eigen::VectorXd& excitation,
                                      const track::Drive& drive) const {
    if (!dynamics_) return excitation;
    return excitation.cwiseMax(synergies_->excitation(drive.at(track::Kinematic::kJawOpen),
                                                      drive.at(track::Kinematic::kJawForward),
                                                      drive.at(track::Kinematic::kJawSide)));
}

StepStats DrivenJaw::implicit_step(FaceTissue& tissue, double h, double jaw_h, const Points& start,
                                   const Points& aim, const Eigen::VectorXd& activation,
                                   const JawDynamics::Carriage& carriage,
                                   const solve::QuasiNewtonOptions& options, Points& x,
                                   JawDynamics::State& state,
                                   std::span<const Points> warm_start) const {
    if (!dynamics_) return tissue.implicit_step(h, start, aim, activation, options, x, warm_start);
    JawInStep step{*dynamics_, dynamics_->begin(jaw_h, state, activation, carriage), state.q};
    const StepStats figures = tissue.implicit_step(h, start, aim, activation, options, x, step);
    state = dynamics_->end(step.step, step.q);
    return figures;
}

StepStats DrivenJaw::solve_equilibrium(FaceTissue& tissue, const Eigen::VectorXd& activation,
                                       const Vec3& gravity_m_s2, const StaticOptions& options,
                                       Points& x, JawDynamics::State& state) const {
    StepStats figures;
    while (figures.iterations < options.iterations && !(options.stopped && options.stopped())) {
        tissue.find_contacts(x);
        const Points start = x;
        state.velocity = JawDynamics::still();
        const StepStats part = implicit_step(tissue, kRestStep_s, kRestStep_s, start, start,
                                             activation, {.gravity_m_s2 = gravity_m_s2},
                                             {.iterations = kIterationsOfRestStep,
                                              .memory = kRestMemory,
                                              .step_cap_m = kRestStepCap_m,
                                              .tolerance_rms_m = kRestTolerance_m},
                                             x, state);
        figures.iterations += std::max(1, part.iterations);
        figures.evaluations += part.evaluations;
        figures.contact_depth_m = part.contact_depth_m;
        figures.lip_depth_m = part.lip_depth_m;
        figures.bone_depth_m = part.bone_depth_m;
        figures.muscle_volume_error = part.muscle_volume_error;
        const double moved = std::sqrt((x - start).squaredNorm() / static_cast<double>(x.rows()));
        figures.last_step_rms_m = moved;
        if (moved < kRests_m) {
            figures.converged = true;
            break;
        }
    }
    return figures;
}

std::optional<muscle::ChainSet::State> DrivenJaw::muscle_state(int column, const JawVector& q,
                                                               double activation) const {
    if (!dynamics_) return std::nullopt;
    const JawMuscles& muscles = dynamics_->muscles();
    const JawPose pose = joint_.pose(q);
    const Vec3 hyoid = q.segment<3>(kHyoid);
    for (std::size_t m = 0; m < muscles.list().size(); ++m) {
        if (muscles.list()[m].column != column) continue;
        const double length_m = muscles.fibre_length_m(m, pose, hyoid);
        return muscle::ChainSet::State{.length_m = length_m,
                                       .stretch = length_m / muscles.list()[m].optimal_m,
                                       .force_n = muscles.isometric_n(m, pose, hyoid, activation)};
    }
    return std::nullopt;
}

std::optional<double> DrivenJaw::greatest_force_n(int column) const {
    if (!dynamics_) return std::nullopt;
    for (const JawMuscle& muscle : dynamics_->muscles().list())
        if (muscle.column == column) return muscle.f0_n;
    return std::nullopt;
}

void DrivenJaw::report(const JawVector& q, FacePose& pose) const {
    if (!dynamics_) return;
    pose.tooth_force_n = dynamics_->joint().tooth_force_n(q);
    pose.jaw_open = pose.jaw.open_m / joint_.place(jaw_.motion(1, 0, 0)).open_m;
}

}  // namespace risorius::face
