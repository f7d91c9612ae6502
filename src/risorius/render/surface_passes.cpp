// SPDX-License-Identifier: MIT
#include "risorius/render/surface_passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "risorius/core/error.h"
#include "risorius/render/detail/garment.h"
#include "risorius/render/detail/hair_area.h"
#include "risorius/render/detail/lip_area.h"
#include "risorius/render/detail/locks.h"

namespace risorius::render {

namespace {

/// A point counts as visible unless something is nearer by more than this, which is less than the thickness of the lips.
constexpr double kSamePlace_m = 1e-3;

Part part_of(const Surface& surface, const Vec3& middle, const std::array<Eye, 2>& eyes,
             const LipArea& lips) {
    switch (surface.material) {
        case Material::kSkin:
            return lips.contains(middle) ? Part::kLips : Part::kSkin;
        case Material::kEye:
        case Material::kCornea:
            return surface.eye == 1 ? Part::kScleraRight : Part::kScleraLeft;
        case Material::kTeeth:
            return Part::kTeeth;
        case Material::kGums:
            return Part::kGums;
        case Material::kTongue:
            return Part::kTongue;
        case Material::kLashes:
        case Material::kMatte:  // never part of a face
        case Material::kMouth:
            break;
    }
    for (const Eye& eye : eyes)  // eye sockets have the same material as the mouth
        if (eye.radius_m > 0 && (middle - eye.centre).norm() < 2 * eye.radius_m)
            return Part::kEyeCorner;
    return Part::kMouth;
}

/// The part of an eyeball at a rest position, by the distance from the optical axis.
Part ring_of_eye(const Vec3& rest, const Eye& eye, bool right) {
    const Vec3 from = rest - eye.centre;
    const double along = from.dot(eye.forward);
    const double aside = (from - along * eye.forward).norm();
    if (along < 0 || aside > eye.iris_radius_m)
        return right ? Part::kScleraRight : Part::kScleraLeft;
    if (aside > eye.pupil_radius_m) return right ? Part::kIrisRight : Part::kIrisLeft;
    return right ? Part::kPupilRight : Part::kPupilLeft;
}

/// Surfaces that are drawn but count as transparent.
bool is_clear(const Surface& surface) {
    return surface.material == Material::kCornea || surface.material == Material::kLashes;
}

}  // namespace

const std::vector<std::string>& part_names() {
    static const std::vector<std::string> names{
        "background", "skin",    "lips",    "sclera_l",   "sclera_r", "iris_l",
        "iris_r",     "pupil_l", "pupil_r", "eye_corner", "teeth",    "gums",
        "tongue",     "mouth",   "hair",    "brow_l",     "brow_r",   "garment"};
    return names;
}

SurfacePasses::SurfacePasses(const Scene& scene, const Eigen::Matrix4d& clip_from_world,
                             int width_px, int height_px, Over over)
    : width_(width_px),
      height_(height_px),
      clip_from_world_(clip_from_world),
      rest_(scene.rest),
      eyes_(scene.eyes),
      hair_(std::make_shared<HairArea>(scene)) {
    if (const auto line = Neckline::of(scene, scene.appearance.garment))
        neckline_ = std::make_shared<Neckline>(*line);
    const LipArea lips(scene.landmarks);
    Eigen::Index count = 0;
    for (const Surface& surface : scene.surfaces)
        if (!is_clear(surface)) count += surface.triangles.rows();
    triangles_.resize(count, 3);
    part_.reserve(static_cast<std::size_t>(count));
    Eigen::Index next = 0;
    for (const Surface& surface : scene.surfaces) {
        if (is_clear(surface)) continue;
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
            Vec3 middle = Vec3::Zero();
            for (int k = 0; k < 3; ++k) {
                const int v = surface.triangles(f, k);
                if (v < 0 || v >= rest_.rows())
                    throw Error("scene/surfaces",
                                "vertices in [0, " + std::to_string(rest_.rows() - 1) + "]",
                                std::to_string(v));
                middle += rest_.row(v).transpose() / 3;
            }
            triangles_.row(next++) = surface.triangles.row(f);
            part_.push_back(part_of(surface, middle, eyes_, lips));
        }
    }
    first_lock_ = static_cast<int>(triangles_.rows());
    locks_ = std::make_shared<Hair>(over == Over::kLocksToo ? plan_hair(scene) : Hair{});
    const Triangles locks =
        triangles_from_outside(*locks_, rest_).array() + static_cast<int>(rest_.rows());
    triangles_.conservativeResize(first_lock_ + locks.rows(), 3);
    triangles_.bottomRows(locks.rows()) = locks;
    part_.resize(static_cast<std::size_t>(triangles_.rows()), Part::kHair);
}

SeenSurface SurfacePasses::look(const Points& positions) const {
    if (positions.rows() != rest_.rows())
        throw Error("pose/positions", std::to_string(rest_.rows()) + " rows",
                    std::to_string(positions.rows()));
    if (locks_->empty())
        return see_surface(positions, triangles_, clip_from_world_, width_, height_);
    const Points locks = pose_hair(*locks_, rest_, positions).positions;
    Points all(positions.rows() + locks.rows(), 3);
    all << positions, locks;
    return see_surface(all, triangles_, clip_from_world_, width_, height_);
}

Vec3 SurfacePasses::at(const SeenSurface& seen, std::size_t pixel, const Points& positions) const {
    const int f = seen.triangle[pixel];
    const double second = seen.second[pixel], third = seen.third[pixel];
    return ((1 - second - third) * positions.row(triangles_(f, 0)) +
            second * positions.row(triangles_(f, 1)) + third * positions.row(triangles_(f, 2)))
        .transpose();
}

std::vector<std::uint16_t> SurfacePasses::parts(const SeenSurface& seen) const {
    std::vector<std::uint16_t> out(seen.triangle.size(), 0);
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (seen.triangle[i] < 0) continue;
        Part part = part_[static_cast<std::size_t>(seen.triangle[i])];
        const bool left = part == Part::kScleraLeft, right = part == Part::kScleraRight;
        if (part == Part::kSkin) {
            const Vec3 place = at(seen, i, rest_);
            part = neckline_ && neckline_->below_m(place) > 0 ? Part::kGarment
                                                              : hair_->at(place).value_or(part);
        }
        if (left || right) part = ring_of_eye(at(seen, i, rest_), eyes_[right ? 1 : 0], right);
        out[i] = static_cast<std::uint16_t>(part);
    }
    return out;
}

std::vector<float> SurfacePasses::depth(const SeenSurface& seen) const {
    // The last row of a perspective matrix is its axis, that of an orthographic one is (0 0 0 1).
    const Eigen::RowVector4d w = clip_from_world_.row(3), z = clip_from_world_.row(2);
    const double perspective = w.head<3>().norm();
    const bool orthographic = perspective < 1e-9;
    std::vector<float> out(seen.triangle.size(), std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (seen.triangle[i] < 0) continue;
        const Eigen::Vector4d place = at(seen, i, seen.positions).homogeneous();
        out[i] = static_cast<float>(orthographic ? (z.dot(place) + w[3]) / z.head<3>().norm()
                                                 : w.dot(place) / perspective);
    }
    return out;
}

std::vector<float> SurfacePasses::normals(const SeenSurface& seen) const {
    Points smooth = Points::Zero(seen.positions.rows(), 3);
    for (Eigen::Index f = 0; f < triangles_.rows(); ++f) {
        const Vec3 a = seen.positions.row(triangles_(f, 0)),
                   b = seen.positions.row(triangles_(f, 1)),
                   c = seen.positions.row(triangles_(f, 2));
        for (int k = 0; k < 3; ++k)
            smooth.row(triangles_(f, k)) += (b - a).cross(c - a).transpose();  // weighted by area
    }
    for (Eigen::Index v = 0; v < smooth.rows(); ++v)
        if (smooth.row(v).norm() > 0) smooth.row(v).normalize();
    std::vector<float> out(3 * seen.triangle.size(), 0);
    for (std::size_t i = 0; i < seen.triangle.size(); ++i) {
        if (seen.triangle[i] < 0) continue;
        const Vec3 normal = at(seen, i, smooth).normalized();
        for (int k = 0; k < 3; ++k)
            out[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(normal[k]);
    }
    return out;
}

Vec3 SurfacePasses::in_picture(const Vec3& world) const {
    const Eigen::Vector4d clip = clip_from_world_ * world.homogeneous();
    return {(clip.x() / clip.w() * 0.5 + 0.5) * width_, (0.5 - clip.y() / clip.w() * 0.5) * height_,
            clip.z() / clip.w()};
}

bool SurfacePasses::is_seen(const SeenSurface& seen, const Vec3& place, double above_m) const {
    if (!(place.x() >= 0 && place.y() >= 0 && place.x() < width_ && place.y() < height_))
        return false;
    const std::size_t pixel =
        static_cast<std::size_t>(place.y()) * static_cast<std::size_t>(width_) +
        static_cast<std::size_t>(place.x());
    // Converts metres along the axis to depth in clip space: z / w changes by (z_row - z w_row) / w.
    const double z = place.z(), z_slope = clip_from_world_.row(2).head<3>().norm(),
                 w_slope = clip_from_world_.row(3).head<3>().norm();
    double w = 1;
    if (w_slope > 0) {
        // Z = (A d + B) / d for the distance d along the axis; A is the limit at infinity.
        const Eigen::RowVector4d zr = clip_from_world_.row(2), wr = clip_from_world_.row(3);
        const double slope = zr.head<3>().dot(wr.head<3>()) / (w_slope * w_slope);
        w = (zr[3] - slope * wr[3]) / (z - slope);
    }
    const double closer = above_m * std::abs(z_slope - z * w_slope) / std::abs(w);
    return seen.nearness[pixel] > z - closer;
}

std::vector<float> SurfacePasses::flow(const SeenSurface& from, const SeenSurface& to) const {
    std::vector<float> out(3 * from.triangle.size(), 0);
    for (std::size_t i = 0; i < from.triangle.size(); ++i) {
        float* flow = out.data() + 3 * i;
        if (from.triangle[i] < 0) {
            flow[2] = to.triangle[i] < 0 ? 1 : 0;
            continue;
        }
        const Vec3 place = in_picture(at(from, i, to.positions));
        const std::size_t row = i / static_cast<std::size_t>(width_),
                          column = i % static_cast<std::size_t>(width_);
        flow[0] = static_cast<float>(place.x() - (static_cast<double>(column) + 0.5));
        flow[1] = static_cast<float>(place.y() - (static_cast<double>(row) + 0.5));
        flow[2] = is_seen(to, place, kSamePlace_m) ? 1 : 0;
    }
    return out;
}

}  // namespace risorius::render
