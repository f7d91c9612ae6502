// SPDX-License-Identifier: MIT
// How hands hold the skin: a spring with critical damping from a point of the skin to the hand.
//
//   p = sum w_i x_i + p0     the point: w_i weights of the nodes, p0 constant            o  where the hand is, m
//   f = k (o - p)            its force, N; at most kStrongest_n
//   c = 2 sqrt(k m)          its damping, N s/m                                   1/m = sum w_i^2 / m_i, m_i lumped masses
#include <algorithm>
#include <cmath>
#include <string>

#include "risorius/core/error.h"
#include "risorius/face/detail/face_impl.h"
#include "risorius/face/skin/detail/head_motion.h"

namespace risorius::face {

namespace {

constexpr double kStrongest_n = 5;  // more than skin of the face is pulled with in an examination

/// The point of a vertex over the nodes of the skin. `constant` is what its nodes at rest leave to the rest position.
struct HeldPoint {
    solve::NodeBlend at;
    Vec3 constant = Vec3::Zero();
    double mass_kg = 0;
};

std::vector<std::pair<int, double>> soft_row(const FaceImpl& face, int vertex) {
    std::vector<std::pair<int, double>> row = face.poser->binding_of(vertex);
    std::erase_if(row, [&](const auto& entry) {
        return face.tissue.fixed()[static_cast<std::size_t>(node_of(entry.first, kSkin))] ||
               entry.second == 0;
    });
    return row;
}

// A point of a smoothed binding has more nodes than a NodeBlend may have. The largest weights are kept and keep their sum.
HeldPoint held_point(const FaceImpl& face, int vertex) {
    std::vector<std::pair<int, double>> row = soft_row(face, vertex);
    if (row.empty())
        throw Error("pull of the vertex " + std::to_string(vertex),
                    "a vertex of the mesh that soft tissue moves",
                    vertex < face.head.vertices.rows() ? "one that does not move or that bone moves"
                                                       : "none with this number");
    double whole = 0, kept = 0;
    for (const auto& [shell, weight] : row) whole += weight;
    std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) {
        return std::abs(a.second) > std::abs(b.second);
    });
    if (row.size() > solve::NodeBlend::kMax) row.resize(solve::NodeBlend::kMax);
    for (const auto& [shell, weight] : row) kept += weight;

    HeldPoint point;
    double inverse_mass = 0;
    for (const auto& [shell, weight] : row) {
        const int node = node_of(shell, kSkin);
        const double w = weight * whole / kept;
        point.at.add(node, w);
        inverse_mass += w * w / face.tissue.mass()[node];
    }
    point.mass_kg = 1 / inverse_mass;
    point.constant = face.head.vertices.row(vertex).transpose() - point.at.of(face.tissue.rest());
    return point;
}

}  // namespace

bool FaceImpl::is_soft(int vertex) const { return !soft_row(*this, vertex).empty(); }

std::vector<PullSpring> FaceImpl::pull_springs(const track::Drive& drive) const {
    std::vector<PullSpring> springs;
    if (drive.pulls.empty()) return springs;
    const Rigid to_head = head_motion(head, drive).inverse();
    for (const track::Pull& pull : drive.pulls) {
        const HeldPoint point = held_point(*this, pull.vertex);
        const double k = pull.stiffness_n_per_m;
        const Vec3 hand =
            to_head * Vec3(head.vertices.row(pull.vertex).transpose() + pull.offset_m);
        springs.push_back({.at = point.at,
                           .tied_to = hand - point.constant,
                           .stiffness_n_per_m = k,
                           .damping_ns_per_m = 2 * std::sqrt(k * point.mass_kg),
                           .strongest_n = kStrongest_n});
    }
    return springs;
}

std::vector<HeldPull> FaceImpl::held_pulls() const {
    std::vector<HeldPull> out;
    const Rigid to_world = head_motion(head, now.drive);
    for (const track::Pull& pull : now.drive.pulls) {
        const HeldPoint point = held_point(*this, pull.vertex);
        const Vec3 rest = head.vertices.row(pull.vertex).transpose();
        const Vec3 p = point.at.of(now.x) + point.constant;
        const Vec3 world = to_world * p, hand = rest + pull.offset_m;
        const double force_n = pull.stiffness_n_per_m * (hand - world).norm();
        out.push_back(
            {pull.vertex, world, hand, std::min(force_n, kStrongest_n), (p - rest).norm()});
    }
    return out;
}

}  // namespace risorius::face
