// How a face looks when its tissue is where it is: the skin is carried by the tissue, folds where it is pressed together, and lids,
// eyes, teeth, tongue, lashes and neck ride along.
#pragma once

#include <Eigen/Core>
#include <array>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/skin/detail/face_pose.h"
#include "risorius/face/skin/detail/mouth_lining.h"
#include "risorius/face/skin/detail/rigid_followers.h"
#include "risorius/face/skin/detail/skin_binding.h"
#include "risorius/face/skin/detail/skin_layer.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// What a pose is made from.
struct FaceMoment {
    const Points& x;                    ///< nodes of the tissue, m
    const Eigen::VectorXd& activation;  ///< of each column of the rig's channels
    const track::Drive& drive;
    Rigid mandible;
};

class FacePoser {
  public:
    /// Whatever is given has to outlive it.
    FacePoser(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
              const JawJoint& joint, const std::array<EyeLids, 2>& lids, const Shell& shell,
              const TissueMesh& mesh);
    FacePoser(const FacePoser&) = delete;
    FacePoser& operator=(const FacePoser&) = delete;

    /// How lids stand, left and right, and how far eyes are turned in the head.
    std::array<LidPose, 2> lids(const Eigen::VectorXd& activation,
                                const track::Drive& drive) const {
        return {lid(0, activation, drive), lid(1, activation, drive)};
    }
    std::array<Mat3, 2> gaze(const track::Drive& drive) const;

    /// The jaw is told of as channels place it.
    FacePose pose(const FaceMoment& moment) const { return pose(moment, Folds::kFormed, nullptr); }
    /// `vertices`: the face from elsewhere; eyes and head are turned as the drive says, its skin has no folds yet.
    FacePose posed(Points vertices, const track::Drive& drive, const Rigid& mandible) const;
    /// Folds such a face, by the strain of its own skin.
    void fold(FacePose& pose, const Eigen::VectorXd& activation) const {
        pose.fold_depth = skin_.fold_depth(activation, pose.vertices);
    }
    /// The slope of a number by the vertices (V x 3) to that by the nodes of the tissue, folds left out.
    Points pull_back(const FaceMoment& moment, const Points& slope) const;

    /// The head's turn on soft points, as in follow.h.
    void turn_with_head(const Rigid& head, const Points& rest, Points& points) const {
        follow_.turn_with_head(head, rest, points);
    }
    const WrinkleLines& lines() const { return skin_.lines(); }

  private:
    LidPose lid(int side, const Eigen::VectorXd& activation, const track::Drive& drive) const;
    Points skin_displacement(const Points& x) const;
    Points pull_through(const FollowDrive& drive, const Points& surface, const Points& slope) const;
    /// What the skin's own layer adds to what the tissue does: no part of what is pulled back.
    enum class Folds { kFormed, kLeftOut };
    /// `pulled`, when given, is a slope by the vertices and becomes that by the skin before anything rides on it.
    FacePose pose(const FaceMoment& moment, Folds folds, Points* pulled) const;

    const rig::Head& head_;
    const rig::RigDescription& rig_;
    const JawJoint& joint_;
    const Shell& shell_;
    const TissueMesh& mesh_;
    track::ChannelTable channels_;
    SkinBinding binding_;
    RigidFollowers follow_;
    SkinLayer skin_;
    MouthLining lining_;
};

}  // namespace risorius::face
