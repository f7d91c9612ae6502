// SPDX-License-Identifier: MIT
/// \file
/// Computes the visible face from the positions of the tissue: the tissue carries the skin, the skin folds where it is compressed, and
/// lids, eyes, teeth, tongue, lashes and neck follow.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/skin/detail/face_pose.h"
#include "risorius/face/skin/detail/lid_pull.h"
#include "risorius/face/skin/detail/mouth_lining.h"
#include "risorius/face/skin/detail/rigid_followers.h"
#include "risorius/face/skin/detail/skin_binding.h"
#include "risorius/face/skin/detail/skin_layer.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// The state from which a pose is computed.
struct FaceMoment {
    const Points& x;                    ///< nodes of the tissue, n x 3, m
    const Eigen::VectorXd& activation;  ///< per column of the rig's channels, 0..1
    const track::Drive& drive;
    Rigid mandible;  ///< motion from rest
};

/// Computes poses of one head.
class FacePoser {
  public:
    /// Keeps references; all arguments must outlive it.
    FacePoser(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
              const JawJoint& joint, const std::array<EyeLids, 2>& lids, const Shell& shell,
              const TissueMesh& mesh);
    FacePoser(const FacePoser&) = delete;
    FacePoser& operator=(const FacePoser&) = delete;

    /// Return the state of the lids, and the rotation of the eyes in the head, left and right. Without `pull`, the lids are those that
    /// their own muscles and the gaze move: to them the tissue is attached. Brow and cheek move the visible lids in addition.
    std::array<LidPose, 2> lids(const Eigen::VectorXd& activation, const track::Drive& drive,
                                const std::array<LidPull, 2>& pull = {}) const {
        return {lid(0, activation, drive, pull[0]), lid(1, activation, drive, pull[1])};
    }
    std::array<Mat3, 2> gaze(const track::Drive& drive) const;

    /// Returns the pose of a moment.
    FacePose pose(const FaceMoment& moment) const { return pose(moment, Folds::kFormed, nullptr); }
    /// Makes a pose from `vertices`, V x 3, m, head frame: applies the motion of eyes and head of the drive. Adds no folds.
    FacePose posed(Points vertices, const track::Drive& drive, const Rigid& mandible) const;
    /// Sets FacePose::fold_depth of such a pose from the strain of its skin.
    void fold(FacePose& pose, const Eigen::VectorXd& activation) const {
        pose.fold_depth = skin_.fold_depth(activation, pose.vertices);
    }
    /// Applies the transpose of the derivative of pose(): converts a gradient by the vertices, V x 3, to the gradient by the nodes of the
    /// tissue, n x 3. Folds are left out.
    Points pull_back(const FaceMoment& moment, const Points& slope) const;

    /// Applies the motion of the head to soft points, see RigidFollowers::turn_with_head().
    void turn_with_head(const Rigid& head, const Points& rest, Points& points) const {
        follow_.turn_with_head(head, rest, points);
    }
    /// See SkinBinding::row().
    std::vector<std::pair<int, double>> binding_of(int vertex) const {
        return binding_.row(vertex);
    }
    const WrinkleLines& lines() const { return skin_.lines(); }
    const RigidFollowers& followers() const { return follow_; }

  private:
    LidPose lid(int side, const Eigen::VectorXd& activation, const track::Drive& drive,
                const LidPull& pull) const;
    Points skin_displacement(const Points& x) const;
    FollowDrive follow_drive(const FaceMoment& moment, const std::array<LidPull, 2>& pull) const;
    Points pull_through(const FaceMoment& moment, const Points& surface, const Points& slope) const;
    /// Whether the pose contains what the skin layer adds to the motion of the tissue. pull_back() leaves it out.
    enum class Folds { kFormed, kLeftOut };
    /// `pulled`, if given, is a gradient by the vertices. It is converted to the gradient by the skin vertices as the tissue moves them,
    /// before the other parts follow.
    FacePose pose(const FaceMoment& moment, Folds folds, Points* pulled) const;

    const rig::Head& head_;
    const rig::RigDescription& rig_;
    const JawJoint& joint_;
    const std::array<EyeLids, 2>& lids_;
    const Shell& shell_;
    const TissueMesh& mesh_;
    track::ChannelTable channels_;
    SkinBinding binding_;
    LidPullMeasure lid_pull_;
    RigidFollowers follow_;
    SkinLayer skin_;
    MouthLining lining_;
};

}  // namespace risorius::face
