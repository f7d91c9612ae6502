// SPDX-License-Identifier: MIT
/// \file
/// Finds contact pairs once per step, to be frozen for the length of a solve: deep tissue and lips against bone and teeth
/// (skull and mandible apart), upper lip against lower, lids against the eyeball.
///
/// The penetration every pair has at rest is subtracted, so that rest is free of force. Planes are blended from the points
/// around, so that they move smoothly as tissue slides over them: taking the nearest alone makes held poses tremble.
/// The lips' planes turn with the lips: a rim faces the other rim, red lip faces forward. A plane stands for what lies in
/// front of it only, so that a lip may tuck in behind the other.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/attachments.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/tissue/contacts.h"

namespace risorius::face {

/// Contact::body of contacts that no bone carries.
enum ContactBody { kGlobeBody = kBodies, kLipBody };

class ContactSearch {
  public:
    ContactSearch(const rig::Head& head, const Jaw& jaw, const Shell& shell, const TissueMesh& mesh,
                  const std::array<EyeLids, 2>& lids, double stiffness_pa_per_m);

    /// Pairs for node positions x with the mandible moved.
    /// `gaze`: turn of each eye, whose cornea bulges. `of`: rows of x whose pairs are wanted; empty: all.
    std::vector<tissue::Contacts::Contact> find(const Points& x, const Rigid& mandible,
                                                const std::array<Mat3, 2>& gaze,
                                                const std::vector<char>& of = {}) const;

    /// Nodes that may ever touch something and the greatest stiffness they may see, for the constant metric.
    const std::vector<int>& nodes() const { return nodes_; }
    const std::vector<double>& node_stiffness() const { return node_stiffness_; }

    /// Deepest penetration of the pairs, m; of those with the bodies from `first` to `last` only.
    static double deepest(const std::vector<tissue::Contacts::Contact>& pairs, const Points& x,
                          int first = 0, int last = kLipBody);

  private:
    struct BonePoint {
        Vec3 point, normal;
    };
    struct DeepNode {
        int node;
        double stiffness;
        double reach;                      // how far a plane stands for the bone around it, m
        std::vector<int> skull, mandible;  // nearest bone points at rest
    };
    struct LipNode {
        int node, deep;  // the ends of its column
        double stiffness, stick;
        Vec3 normal, column;  // at rest
    };
    struct LidNode {
        int node;
        int side;
        double stiffness;
        double rest_gap;
    };
    struct Search;  // one call of find()
    static constexpr int kLipNeighbours = 3;
    using NearestFew = std::array<std::pair<double, int>, kLipNeighbours + 1>;

    static BonePoint blended_plane(const Vec3& p, double reach, const std::vector<int>& candidates,
                                   const std::vector<BonePoint>& bone);
    static std::vector<Vec3> turned_normals(const std::vector<LipNode>& lip, const Points& x);
    static NearestFew nearest_few(const Vec3& p, const std::vector<LipNode>& lip, const Points& x);
    void find_bone(const DeepNode& node, int body, int slot, Search& search) const;
    void find_lip(const std::vector<LipNode>& lip, const std::vector<LipNode>& other,
                  const std::vector<Vec3>& facing, int first_slot, Search& search) const;
    void find_lip_node(const LipNode& node, const std::vector<LipNode>& other,
                       const std::vector<Vec3>& facing, int slot, Search& search) const;
    void find_lids(int first_slot, Search& search) const;

    Points rest_;
    std::vector<BonePoint> skull_, mandible_;
    std::vector<DeepNode> deep_;
    std::vector<LipNode> upper_, lower_;
    std::vector<LidNode> lid_;
    std::array<rig::EyeGeometry, 2> eyes_;
    double lip_reach_m_, lip_aside_m_, stick_m_;
    std::vector<int> nodes_;
    std::vector<double> node_stiffness_;
};

}  // namespace risorius::face
