// SPDX-License-Identifier: MIT
/// \file
/// Finds the contact pairs of the face: deep tissue and lips against skull, mandible and teeth, upper lip against lower lip, lids
/// against the eyeball. The pairs are found before a solve and stay the same within it.
///
/// The penetration of a pair at rest is subtracted, so that there is no force at rest. Contact planes are blended from several points
/// of the surface, so that they turn smoothly as tissue slides over it; with the nearest point alone, held poses would tremble. The
/// planes of the lips turn with the lips: those at the rim face the other rim, those on the red lip face forwards. A plane acts only on
/// nodes in front of it, so that one lip can move behind the other.
///
/// The distance from a lip is a mean over the tangent planes of its nearest nodes (Oztireli, Guennebaud & Gross 2009, Computer Graphics
/// Forum 28(2)). A node has no weight when another one is about to take its place.
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

/// Values of Contact::body for surfaces that are not bone, after those of BodyIndex.
enum ContactBody { kGlobeBody = kBodies, kLipBody };

/// The search on one head.
class ContactSearch {
  public:
    /// `stiffness_pa_per_m`: contact stiffness per area.
    ContactSearch(const rig::Head& head, const Jaw& jaw, const Shell& shell, const TissueMesh& mesh,
                  const std::array<EyeLids, 2>& lids, double stiffness_pa_per_m);

    /// Returns the pairs at node positions x, n x 3, m. `mandible` is its motion from rest, `gaze` the rotation of each eye; the
    /// bulge of the cornea turns with the eye. `of` flags the rows of x whose pairs are wanted; if it is empty, all pairs are.
    std::vector<tissue::Contacts::Contact> find(const Points& x, const Rigid& mandible,
                                                const std::array<Mat3, 2>& gaze,
                                                const std::vector<char>& of = {}) const;

    /// Return the nodes that may ever be in contact, and the maximum contact stiffness of each, N/m. The constant metric needs them.
    const std::vector<int>& nodes() const { return nodes_; }
    const std::vector<double>& node_stiffness() const { return node_stiffness_; }

    /// Returns the pairs of nodes, one on each lip, that are near each other at rest: those of contacts of the lips in most poses.
    std::vector<std::pair<int, int>> neighbours_across_lips() const;

    /// Returns the maximum penetration of the pairs whose body is in `first`..`last`, m.
    static double deepest(const std::vector<tissue::Contacts::Contact>& pairs, const Points& x,
                          int first = 0, int last = kLipBody);

  private:
    struct BonePoint {
        Vec3 point, normal;
    };
    struct DeepNode {
        int node;
        double stiffness;
        double reach;                      // radius of the bone that its plane stands for, m
        std::vector<int> skull, mandible;  // nearest bone points at rest
    };
    struct LipNode {
        int node, deep;  // skin end and deep end of its column
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
    static constexpr int kLipNeighbours = tissue::Contacts::kMostOthers;
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
