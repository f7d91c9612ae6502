// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/contact_search.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/rotations.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr int kCandidates = 40;
constexpr double kFarEnough_m = 3e-3;
constexpr double kLipStiffness = 2.0;  // of lip on lip / of lip on bone
constexpr double kStick_pa = 150;  // saliva between the lips, per lip: a bridge about 0.5 mm wide

std::vector<int> nearest(const Vec3& p, const auto& points) {
    std::vector<std::pair<double, int>> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        order.push_back({(points[i].point - p).squaredNorm(), static_cast<int>(i)});
    const std::size_t count = std::min<std::size_t>(kCandidates, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<long>(count), order.end());
    std::vector<int> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(order[i].second);
    return out;
}

}  // namespace

ContactSearch::ContactSearch(const rig::Head& head, const Jaw& jaw, const Shell& shell,
                             const TissueMesh& mesh, const std::array<EyeLids, 2>& lids,
                             double stiffness_pa_per_m)
    : rest_(mesh.nodes) {
    const std::vector<Vec3> lips = lip_line(head);
    const int count = static_cast<int>(shell.vertex.size());
    std::vector<std::pair<int, double>> touching;
    lip_reach_m_ = head.mm(9);
    lip_aside_m_ = head.mm(3.5);
    stick_m_ = head.mm(0.5);
    eyes_ = head.eyes;
    for (int v = 0; v < count; ++v) {
        const Vec3 deep = mesh.nodes.row(node_of(v, kDeep)).transpose();
        const Vec3 skin = mesh.nodes.row(node_of(v, kSkin)).transpose();
        if (geom::distance_to_polyline(skin, lips) < head.mm(60)) {
            // Bone and teeth reach down to the border of the mandible; the neck has none
            const double fraction = jaw.weight(skin, shell.over_bite_m[v]);
            const bool above_bite = shell.over_bite_m[v] > 0;
            if (above_bite && fraction < 0.6) skull_.push_back({deep, mesh.direction[v]});
            if (!above_bite && fraction > 0.4 && jaw.height_over_border(skin) > -head.mm(4))
                mandible_.push_back({deep, mesh.direction[v]});
        }
    }
    for (int v = 0; v < count; ++v) {
        if (shell.fixed[v]) continue;
        const double stiffness = stiffness_pa_per_m * mesh.area_m2[v];
        const Vec3 deep = mesh.nodes.row(node_of(v, kDeep)).transpose();
        const Vec3 skin = mesh.nodes.row(node_of(v, kSkin)).transpose();
        const double from_mouth = geom::distance_to_polyline(skin, lips);
        if (from_mouth < head.mm(50)) {
            DeepNode node{node_of(v, kDeep), stiffness,
                          std::max(head.mm(3), 1.3 * std::sqrt(mesh.area_m2[v])),
                          nearest(deep, skull_), nearest(deep, mandible_)};
            deep_.push_back(node);
            touching.push_back({node.node, stiffness});
        }
        if (from_mouth < head.mm(10)) {
            const bool upper = shell.over_bite_m[v] >= 0;
            const double rim = 1.0 - geom::smoothstep(head.mm(1), head.mm(6), from_mouth);
            const Vec3 to_other = upper ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitY());
            const Vec3 normal = (rim * to_other + (1 - rim) * mesh.direction[v]).normalized();
            (upper ? upper_ : lower_)
                .push_back({node_of(v, kSkin), node_of(v, kDeep), stiffness,
                            kStick_pa * mesh.area_m2[v], normal, (skin - deep).normalized()});
            deep_.push_back({node_of(v, kSkin), stiffness,
                             std::max(head.mm(3), 1.3 * std::sqrt(mesh.area_m2[v])),
                             nearest(skin, skull_), nearest(skin, mandible_)});
            touching.push_back({node_of(v, kSkin), kLipStiffness * stiffness});
        }
        for (int side = 0; side < 2; ++side) {
            if ((skin - lids[side].centre()).norm() > lids[side].zone_m()) continue;
            const double gap = eyes_[side].distance(deep, eyes_[side].forward);
            lid_.push_back({node_of(v, kDeep), side, stiffness, std::min(0.0, gap)});
            touching.push_back({node_of(v, kDeep), stiffness});
        }
    }
    std::sort(touching.begin(), touching.end());
    for (const auto& [node, stiffness] : touching) {
        if (!nodes_.empty() && nodes_.back() == node) {
            node_stiffness_.back() = std::max(node_stiffness_.back(), stiffness);
            continue;
        }
        nodes_.push_back(node);
        node_stiffness_.push_back(stiffness);
    }
}

struct ContactSearch::Search {
    const Points& x;
    const Rigid& mandible;
    const Rigid to_mandible;
    const std::array<Mat3, 2>& gaze;
    const std::vector<char>& of;  // rows of x whose pairs are wanted; empty: all
    std::vector<tissue::Contacts::Contact> found;

    bool wants(int node) const { return of.empty() || of[static_cast<std::size_t>(node)] != 0; }
};

std::vector<tissue::Contacts::Contact> ContactSearch::find(const Points& x, const Rigid& mandible,
                                                           const std::array<Mat3, 2>& gaze,
                                                           const std::vector<char>& of) const {
    Search search{x, mandible, mandible.inverse(), gaze, of, {}};
    for (std::size_t n = 0; n < deep_.size(); ++n) {
        if (!search.wants(deep_[n].node)) continue;
        const int slot = 2 * static_cast<int>(n);
        find_bone(deep_[n], kSkullBody, slot, search);
        find_bone(deep_[n], kMandibleBody, slot + 1, search);
    }
    const int first_upper = 2 * static_cast<int>(deep_.size());
    const int first_lower = first_upper + static_cast<int>(upper_.size());
    const int first_lid = first_lower + static_cast<int>(lower_.size());
    const std::vector<Vec3> upper_normals = turned_normals(upper_, x),
                            lower_normals = turned_normals(lower_, x);
    find_lip(upper_, lower_, lower_normals, first_upper, search);
    find_lip(lower_, upper_, upper_normals, first_lower, search);
    find_lids(first_lid, search);
    return std::move(search.found);
}

// Returns the plane blended from the bone points around p. It must not depend on which point is the nearest: planes that jump keep a
// held pose from reaching equilibrium.
ContactSearch::BonePoint ContactSearch::blended_plane(const Vec3& p, double reach,
                                                      const std::vector<int>& candidates,
                                                      const std::vector<BonePoint>& bone) {
    std::array<double, kCandidates> squared;
    double nearest_squared = 1e300;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        squared[i] = (bone[static_cast<std::size_t>(candidates[i])].point - p).squaredNorm();
        nearest_squared = std::min(nearest_squared, squared[i]);
    }
    const double radius = std::sqrt(nearest_squared) + 1.5 * reach;
    const double radius_squared = radius * radius;
    Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
    double weights = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (squared[i] >= radius_squared) continue;
        const double fraction = 1.0 - squared[i] / radius_squared;
        const double w = fraction * fraction * fraction;
        const BonePoint& near = bone[static_cast<std::size_t>(candidates[i])];
        point += w * near.point;
        normal += w * near.normal;
        weights += w;
    }
    point /= weights;
    normal.normalize();
    return {point, normal};
}

// Bone and teeth. The plane fades out beyond the edge of the bone, where it stands for nothing: a lowered chin is not below the upper
// teeth.
void ContactSearch::find_bone(const DeepNode& node, int body, int slot, Search& search) const {
    const bool carried = body == kMandibleBody;
    const std::vector<int>& candidates = carried ? node.mandible : node.skull;
    if (candidates.empty()) return;
    Vec3 p = search.x.row(node.node).transpose();
    if (carried) p = search.to_mandible * p;
    const Vec3 rest = rest_.row(node.node).transpose();
    const auto [point, normal] =
        blended_plane(p, node.reach, candidates, carried ? mandible_ : skull_);
    const double gap = (p - point).dot(normal);
    const double rest_gap = std::min(0.0, (rest - point).dot(normal));
    if (gap - rest_gap > kFarEnough_m) return;  // too far to be reached within one step
    // Above bone the blended point lies below the node; beyond the edge it stays behind
    const double aside = (p - point - (p - point).dot(normal) * normal).norm();
    const double inside = 1.0 - geom::smoothstep(1.2 * node.reach, 1.7 * node.reach, aside);
    if (inside <= 0) return;
    tissue::Contacts::Contact contact;
    contact.node = node.node;
    contact.point = carried ? Vec3(search.mandible * point) : point;
    contact.normal = carried ? Vec3(search.mandible.linear() * normal) : normal;
    contact.rest_gap_m = rest_gap;
    contact.body = body;
    contact.stiffness_n_per_m = inside * node.stiffness;
    contact.fraction = inside;
    contact.slot = slot;
    search.found.push_back(contact);
}

// Returns the normals of a lip, one per node. They turn with the columns of the nodes.
std::vector<Vec3> ContactSearch::turned_normals(const std::vector<LipNode>& lip, const Points& x) {
    std::vector<Vec3> turned;
    for (const LipNode& node : lip) {
        const Vec3 column = (x.row(node.node) - x.row(node.deep)).transpose();
        turned.push_back(turn_between(node.column, column) * node.normal);
    }
    return turned;
}

// Returns the kLipNeighbours + 1 nearest nodes of a lip, nearest first: squared distance, index.
ContactSearch::NearestFew ContactSearch::nearest_few(const Vec3& p, const std::vector<LipNode>& lip,
                                                     const Points& x) {
    NearestFew out;
    out.fill({1e300, -1});
    for (std::size_t i = 0; i < lip.size(); ++i) {
        const double squared = (Vec3(x.row(lip[i].node).transpose()) - p).squaredNorm();
        if (squared >= out.back().first) continue;
        out.back() = {squared, static_cast<int>(i)};
        for (std::size_t k = out.size() - 1; k > 0 && out[k] < out[k - 1]; --k)
            std::swap(out[k], out[k - 1]);
    }
    return out;
}

std::vector<std::pair<int, int>> ContactSearch::neighbours_across_lips() const {
    std::vector<std::pair<int, int>> out;
    for (const auto& [lip, other] : {std::pair(&upper_, &lower_), std::pair(&lower_, &upper_)})
        for (const LipNode& node : *lip)
            for (const auto& [squared, near] :
                 nearest_few(rest_.row(node.node).transpose(), *other, rest_))
                if (near >= 0)
                    out.emplace_back(node.node, (*other)[static_cast<std::size_t>(near)].node);
    return out;
}

// Pairs each node of a lip with the plane of the nearest nodes of the other lip, whose normals are `facing`.
void ContactSearch::find_lip(const std::vector<LipNode>& lip, const std::vector<LipNode>& other,
                             const std::vector<Vec3>& facing, int first_slot,
                             Search& search) const {
    if (other.size() <= kLipNeighbours) return;
    for (std::size_t n = 0; n < lip.size(); ++n)
        if (search.wants(lip[n].node))
            find_lip_node(lip[n], other, facing, first_slot + static_cast<int>(n), search);
}

void ContactSearch::find_lip_node(const LipNode& node, const std::vector<LipNode>& other,
                                  const std::vector<Vec3>& facing, int slot, Search& search) const {
    const Points& x = search.x;
    const Vec3 p = x.row(node.node).transpose();
    const NearestFew nearest = nearest_few(p, other, x);
    double inside =
        1.0 - geom::smoothstep(0.7 * lip_reach_m_, lip_reach_m_, std::sqrt(nearest[0].first));
    if (inside <= 0) return;
    tissue::Contacts::Contact contact;
    contact.node = node.node;
    contact.normal.setZero();
    Vec3 off = Vec3::Zero(), rest_off = Vec3::Zero(), rest_normal = Vec3::Zero();
    double weights = 0, gap = 0, rest_gap = 0, stiffness = 0;
    for (std::size_t k = 0; k < kLipNeighbours; ++k) {
        const LipNode& o = other[nearest[k].second];
        // The weight of a node that is about to be replaced is zero
        const double fraction = 1.0 - nearest[k].first / nearest[kLipNeighbours].first;
        const double w = std::max(fraction * fraction, 1e-12);
        contact.others[k] = o.node;
        contact.weights[k] = w;
        weights += w;
        const Vec3 from = p - x.row(o.node).transpose();
        const Vec3 rest_from = (rest_.row(node.node) - rest_.row(o.node)).transpose();
        off += w * from;
        rest_off += w * rest_from;
        gap += w * from.dot(facing[nearest[k].second]);
        rest_gap += w * rest_from.dot(o.normal);
        contact.normal += w * facing[nearest[k].second];
        rest_normal += w * o.normal;
        stiffness += w * o.stiffness;
    }
    for (std::size_t k = 0; k < kLipNeighbours; ++k) contact.weights[k] /= weights;
    contact.normal.normalize();
    rest_normal.normalize();
    gap /= weights;
    rest_gap /= weights;
    const auto beside = [&](const Vec3& d, const Vec3& normal, double from_m) {
        return 1.0 -
               geom::smoothstep(from_m, from_m + lip_aside_m_, (d - d.dot(normal) * normal).norm());
    };
    off /= weights;
    rest_off /= weights;
    inside *= beside(off, contact.normal, lip_aside_m_);
    if (inside <= 0) return;
    contact.count = kLipNeighbours;
    contact.point = (off.dot(contact.normal) - gap) * contact.normal;
    // Nodes that are inside at rest keep their full plane, otherwise there would be a force at rest
    contact.rest_gap_m = beside(rest_off, rest_normal, 2 * lip_aside_m_) * std::min(0.0, rest_gap);
    if (gap - contact.rest_gap_m > kFarEnough_m) return;
    // The stiffness is weighted like the plane: if it depended on which nodes are nearest, it would jump as lips slide
    contact.stiffness_n_per_m =
        inside * kLipStiffness * std::min(node.stiffness, stiffness / weights);
    contact.fraction = inside;
    contact.stick_n = inside * node.stick;
    contact.stick_m = stick_m_;
    contact.body = kLipBody;
    contact.slot = slot;
    search.found.push_back(contact);
}

// Lids: a plane across the radius of the eye, where the surface of the eye lies below the node.
void ContactSearch::find_lids(int first_slot, Search& search) const {
    for (std::size_t n = 0; n < lid_.size(); ++n) {
        const LidNode& node = lid_[n];
        if (!search.wants(node.node)) continue;
        const rig::EyeGeometry& eye = eyes_[node.side];
        const Vec3 p = search.x.row(node.node).transpose();
        const double gap = eye.distance(p, search.gaze[node.side] * eye.forward);
        if (gap > kFarEnough_m) continue;
        tissue::Contacts::Contact contact;
        contact.node = node.node;
        contact.normal = (p - eye.centre).normalized();
        contact.point = p - gap * contact.normal;
        contact.rest_gap_m = node.rest_gap;
        contact.stiffness_n_per_m = node.stiffness;
        contact.body = kGlobeBody;
        contact.slot = first_slot + static_cast<int>(n);
        search.found.push_back(contact);
    }
}

double ContactSearch::deepest(const std::vector<tissue::Contacts::Contact>& pairs, const Points& x,
                              int first, int last) {
    double deepest = 0;
    for (const auto& pair : pairs)
        if (pair.body >= first && pair.body <= last)
            deepest = std::max(deepest, tissue::Contacts::depth(pair, x));
    return deepest;
}

}  // namespace risorius::face
