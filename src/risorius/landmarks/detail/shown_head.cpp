// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/shown_head.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "risorius/core/error.h"
#include "risorius/fitting/part_guess.h"
#include "risorius/geom/fitted_sphere.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/landmarks/face_network.h"
#include "risorius/render/seen_surface.h"

namespace risorius::landmarks {

namespace {

// Plain colours, sRGB 0..1; the network was trained with photographs.
const Vec3 kBackground(0.36, 0.40, 0.44), kSkinTone(0.86, 0.66, 0.55), kWhite(0.93, 0.93, 0.92),
    kIris(0.22, 0.14, 0.10), kPupil(0.03, 0.03, 0.03), kTeethTone(0.90, 0.88, 0.80),
    kMouthTone(0.45, 0.18, 0.17);
constexpr double kPupil_rad = 0.18, kIris_rad = 0.50;  // around the direction of the face
constexpr double kAmbient = 0.40;                      // share of the light that has no direction
constexpr double kDistance = 3.5;  // of the camera, in widths of the picture: as in a portrait
constexpr int kFewestOfEye = 20;   // vertices of a piece that is an eyeball

enum class Shown { kNothing, kPart };

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

/// The part that a role is drawn as; nothing for what is left out.
std::pair<Shown, ShownPart> shown_as(const std::string& role, bool unknown_is_skin) {
    if (role == "skin" || (role.empty() && unknown_is_skin))
        return {Shown::kPart, ShownPart::kSkin};
    if (begins(role, "eye_socket") || role == "mouth" || begins(role, "gums") || role == "tongue")
        return {Shown::kPart, ShownPart::kMouth};
    if (begins(role, "eye")) return {Shown::kPart, ShownPart::kEye};
    if (begins(role, "teeth")) return {Shown::kPart, ShownPart::kTeeth};
    return {Shown::kNothing, ShownPart::kSkin};
}

/// Finds the eyeballs: connected pieces of the triangles of eyes.
void find_eyes(ShownHead& head) {
    std::vector<int> parent(static_cast<std::size_t>(head.positions.rows()));
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[static_cast<std::size_t>(v)] != v) {
            int& up = parent[static_cast<std::size_t>(v)];
            up = parent[static_cast<std::size_t>(up)];
            v = up;
        }
        return v;
    };
    for (Eigen::Index f = 0; f < head.triangles.rows(); ++f)
        if (head.part[static_cast<std::size_t>(f)] == ShownPart::kEye)
            for (const int k : {1, 2}) {
                const int a = root(head.triangles(f, 0)), b = root(head.triangles(f, k));
                parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
            }
    std::vector<std::vector<Vec3>> points(parent.size());
    std::vector<bool> used(parent.size(), false);
    for (Eigen::Index f = 0; f < head.triangles.rows(); ++f)
        for (int k = 0; k < 3 && head.part[static_cast<std::size_t>(f)] == ShownPart::kEye; ++k) {
            const int v = head.triangles(f, k);
            if (used[static_cast<std::size_t>(v)]) continue;
            used[static_cast<std::size_t>(v)] = true;
            points[static_cast<std::size_t>(root(v))].push_back(head.positions.row(v).transpose());
        }
    std::vector<int> eye_of(parent.size(), -1);
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (points[v].size() < kFewestOfEye) continue;
        eye_of[v] = static_cast<int>(head.eye_centres.size());
        head.eye_centres.push_back(geom::fitted_sphere(points[v]).centre);
    }
    head.eye.assign(head.part.size(), -1);
    for (Eigen::Index f = 0; f < head.triangles.rows(); ++f)
        if (head.part[static_cast<std::size_t>(f)] == ShownPart::kEye)
            head.eye[static_cast<std::size_t>(f)] =
                eye_of[static_cast<std::size_t>(root(head.triangles(f, 0)))];
}

/// The colour without light of a point of a triangle.
Vec3 colour_of(const ShownHead& head, std::size_t triangle, const Vec3& p, const Vec3& forward) {
    switch (head.part[triangle]) {
        case ShownPart::kSkin:
            return kSkinTone;
        case ShownPart::kTeeth:
            return kTeethTone;
        case ShownPart::kMouth:
            return kMouthTone;
        case ShownPart::kEye:
            break;
    }
    if (head.eye[triangle] < 0) return kWhite;
    const Vec3 r = p - head.eye_centres[static_cast<std::size_t>(head.eye[triangle])];
    const double angle = std::atan2(r.cross(forward).norm(), r.dot(forward));
    return angle < kPupil_rad ? kPupil : angle < kIris_rad ? kIris : kWhite;
}

}  // namespace

ShownHead shown_head(const geom::PolygonMesh& mesh, const std::string& place,
                     const std::map<std::string, std::vector<std::string>>& parts) {
    std::vector<std::string> roles;
    bool any_skin = false;
    for (const std::string& group : mesh.group_names) {
        roles.push_back(mesh.group_names.size() == 1 ? "skin" : fitting::role_suggested_by(group));
        for (const auto& [role, groups] : parts)
            if (std::find(groups.begin(), groups.end(), group) != groups.end()) roles.back() = role;
        any_skin = any_skin || roles.back() == "skin";
    }
    ShownHead head;
    head.positions = mesh.positions;
    std::vector<Triangles> pieces;
    Eigen::Index count = 0, skin_count = 0;
    for (std::size_t g = 0; g < roles.size(); ++g) {
        const auto [shown, part] = shown_as(roles[g], !any_skin);
        if (shown == Shown::kNothing) continue;
        pieces.push_back(geom::triangulate(mesh, {static_cast<int>(g)}));
        count += pieces.back().rows();
        if (part == ShownPart::kSkin) skin_count += pieces.back().rows();
        head.part.insert(head.part.end(), static_cast<std::size_t>(pieces.back().rows()), part);
    }
    if (skin_count == 0) throw Error(place, "a mesh with faces of skin", "none");
    head.triangles.resize(count, 3);
    head.skin.resize(skin_count, 3);
    Eigen::Index row = 0, skin_row = 0;
    for (const Triangles& piece : pieces) {
        head.triangles.middleRows(row, piece.rows()) = piece;
        if (piece.rows() > 0 && head.part[static_cast<std::size_t>(row)] == ShownPart::kSkin) {
            head.skin.middleRows(skin_row, piece.rows()) = piece;
            skin_row += piece.rows();
        }
        row += piece.rows();
    }
    head.normals = geom::vertex_normals(head.positions, head.triangles);
    find_eyes(head);
    head.tree = geom::SurfaceTree(head.positions, head.triangles);
    head.skin_tree = geom::SurfaceTree(head.positions, head.skin);
    return head;
}

Vec3 ViewFrame::viewer() const { return centre + kDistance * width * axes.col(2); }

Eigen::Matrix4d ViewFrame::clip_from_world() const {
    const double distance = kDistance * width, near = 0.1 * distance, far = 10 * distance;
    Eigen::Matrix4d camera = Eigen::Matrix4d::Zero();
    camera.block<1, 3>(0, 0) = axes.col(0).transpose() * (2 * distance / width);
    camera.block<1, 3>(1, 0) = axes.col(1).transpose() * (2 * distance / width);
    const double steep = (far + near) / (far - near);
    camera.block<1, 3>(2, 0) = -axes.col(2).transpose() * steep;
    camera(2, 3) = distance * steep - 2 * far * near / (far - near);
    camera.block<1, 3>(3, 0) = -axes.col(2).transpose();
    camera(3, 3) = distance;
    Eigen::Matrix4d moved = Eigen::Matrix4d::Identity();
    moved.block<3, 1>(0, 3) = -centre;
    return camera * moved;
}

Vec3 ViewFrame::on_plane(const Vec2& px) const {
    return centre + axes.col(0) * (width * (px.x() / kFacePicture_px - 0.5)) +
           axes.col(1) * (width * (0.5 - px.y() / kFacePicture_px));
}

Vec2 ViewFrame::in_picture(const Vec3& p) const {
    const Eigen::Vector4d clip = clip_from_world() * p.homogeneous();
    return kFacePicture_px * Vec2(0.5 + 0.5 * clip.x() / clip.w(), 0.5 - 0.5 * clip.y() / clip.w());
}

Picture face_picture(const ShownHead& head, const ViewFrame& frame, int samples) {
    const int side = samples * kFacePicture_px;
    const render::SeenSurface seen =
        render::see_surface(head.positions, head.triangles, frame.clip_from_world(), side, side);
    const Vec3 viewer = frame.viewer(), forward = frame.axes.col(2),
               light = (frame.axes * Vec3(0, 0.45, 1)).normalized();
    Picture out(kFacePicture_px, kFacePicture_px, 3);
    const double share = 1.0 / (samples * samples);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                                  static_cast<std::size_t>(x);
            Vec3 colour = kBackground;
            if (const int f = seen.triangle[i]; f >= 0) {
                const double b = seen.second[i], c = seen.third[i], a = 1 - b - c;
                const auto mixed = [&](const Points& rows) -> Vec3 {
                    return (a * rows.row(head.triangles(f, 0)) +
                            b * rows.row(head.triangles(f, 1)) + c * rows.row(head.triangles(f, 2)))
                        .transpose();
                };
                const Vec3 p = mixed(head.positions);
                Vec3 normal = mixed(head.normals).normalized();
                if (normal.dot(viewer - p) < 0) normal = -normal;
                colour = colour_of(head, static_cast<std::size_t>(f), p, forward) *
                         (kAmbient + (1 - kAmbient) * std::max(0.0, normal.dot(light)));
            }
            float* pixel = out.at(y / samples, x / samples);
            for (int k = 0; k < 3; ++k) pixel[k] += static_cast<float>(share * colour[k]);
        }
    return out;
}

}  // namespace risorius::landmarks
