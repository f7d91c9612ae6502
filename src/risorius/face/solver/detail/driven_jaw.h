// SPDX-License-Identifier: MIT
/// \file
/// The mandible of a face. Either the channels of the jaw place it, or its muscles move it within the steps of the tissue. In the second
/// case, jaw and tissue act on each other.
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

/// The jaw of one face, with the choice of what moves it.
class DrivenJaw {
  public:
    /// Keeps references: all arguments must outlive it. By default, the channels place the jaw.
    DrivenJaw(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw);

    /// Sets what moves the jaw. `step_s` is the length of the steps that the tissue will make, s. If muscles move the jaw, the boundary
    /// conditions of the tissue are those of rest afterwards.
    void drive_by(track::JawDrive by, const track::ChannelTable& channels, double step_s,
                  FaceTissue& tissue);
    bool by_muscles() const { return dynamics_.has_value(); }
    const JawJoint& joint() const { return joint_; }
    /// Sets the height of the bite block, m; 0 removes it. Throws std::logic_error if channels place the jaw.
    void set_bite_block(double height_m);

    /// Returns the motion of the mandible from rest that the channels ask for.
    Rigid wanted(const track::Drive& drive) const;
    /// Returns the motion of the mandible from rest: that of the coordinates q if muscles move the jaw, else that of the channels.
    Rigid motion(const JawVector& q, const track::Drive& drive) const;
    /// Returns the excitation per column. If muscles move the jaw, it is at least the excitation with which they move the jaw as its
    /// channels say.
    Eigen::VectorXd excitation(const Eigen::VectorXd& excitation, const track::Drive& drive) const;

    /// Solves one step of the tissue of length h, s. If muscles move the jaw, the jaw is part of the solve: `state` is advanced by a
    /// step of length `jaw_h`, s. The other arguments are those of FaceTissue::implicit_step().
    StepStats implicit_step(FaceTissue& tissue, double h, double jaw_h, const Points& start,
                            const Points& aim, const Eigen::VectorXd& activation,
                            const JawDynamics::Carriage& carriage,
                            const solve::QuasiNewtonOptions& options, Points& x,
                            JawDynamics::State& state,
                            std::span<const Points> warm_start = {}) const;
    /// Finds the equilibrium of the tissue together with a jaw that muscles move, by long time steps.
    StepStats solve_equilibrium(FaceTissue& tissue, const Eigen::VectorXd& activation,
                                const Vec3& gravity_m_s2, const StaticOptions& options, Points& x,
                                JawDynamics::State& state) const;

    /// Returns length, stretch and isometric force of the jaw muscle of a column, at q. Returns std::nullopt for other columns and while
    /// channels place the jaw.
    std::optional<muscle::ChainSet::State> muscle_state(int column, const JawVector& q,
                                                        double activation) const;

    /// Returns the maximum isometric force of the jaw muscle of a column, N. Returns std::nullopt for other columns and while channels
    /// place the jaw.
    std::optional<double> greatest_force_n(int column) const;

    /// Writes tooth force and opening into the pose if muscles move the jaw.
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
