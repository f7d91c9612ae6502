// SPDX-License-Identifier: MIT
/// \file
/// The mandible of a face: placed by channels, or moved by its muscles within the steps of the tissue, which it then carries and is
/// held by.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/detail/jaw_dynamics.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"
#include "risorius/face/anatomy/detail/jaw_synergies.h"
#include "risorius/face/skin/detail/face_pose.h"
#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/face/solver/detail/static_solver.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/solve/quasi_newton.h"
#include "risorius/track/channels.h"

namespace risorius::face {

class DrivenJaw {
  public:
    /// Keeps references: all arguments must outlive it. Placed by channels until told otherwise.
    DrivenJaw(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw);

    /// `step_s`: of the steps that the tissue is going to make. Leaves the tissue prescribed at rest where muscles move the jaw.
    void drive_by(track::JawDrive by, const track::ChannelTable& channels, double step_s,
                  FaceTissue& tissue);
    bool by_muscles() const { return dynamics_.has_value(); }
    const JawJoint& joint() const { return joint_; }
    /// Throws std::logic_error where channels place the jaw.
    void set_bite_block(double height_m);

    /// Where the channels want it.
    Rigid wanted(const track::Drive& drive) const;
    /// Where it is, at q, or where the drive wants it.
    Rigid motion(const JawVector& q, const track::Drive& drive) const;
    /// Per column, with what the channels of the jaw ask of muscles that move it.
    Eigen::VectorXd excitation(const Eigen::VectorXd& excitation, const track::Drive& drive) const;

    /// One step of the tissue, and of the jaw, from `state` to `state`, if muscles move it; `jaw_h` is the jaw's own.
    StepStats implicit_step(FaceTissue& tissue, double h, double jaw_h, const Points& start,
                            const Points& aim, const Eigen::VectorXd& activation,
                            const JawDynamics::Carriage& carriage,
                            const solve::QuasiNewtonOptions& options, Points& x,
                            JawDynamics::State& state,
                            std::span<const Points> warm_start = {}) const;
    /// Tissue and a jaw that muscles move come to rest together, in long steps of time.
    StepStats solve_equilibrium(FaceTissue& tissue, const Eigen::VectorXd& activation,
                                const Vec3& gravity_m_s2, const StaticOptions& options, Points& x,
                                JawDynamics::State& state) const;

    /// Length and isometric force of the jaw muscle of a column, at q; nothing while channels place the jaw, and for other columns.
    std::optional<muscle::ChainSet::State> muscle_state(int column, const JawVector& q,
                                                        double activation) const;

    /// What only a jaw that muscles move can tell.
    void report(const JawVector& q, FacePose& pose) const;

  private:
    const rig::Head& head_;
    const rig::RigDescription& rig_;
    const Jaw& jaw_;
    JawJoint joint_;
    std::optional<JawDynamics> dynamics_;
    std::optional<JawSynergies> synergies_;
};

}  // namespace risorius::face
