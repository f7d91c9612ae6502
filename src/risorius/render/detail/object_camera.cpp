// SPDX-License-Identifier: MIT
#include "risorius/render/detail/object_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace risorius::render {
namespace {

/// Camera distance in object radii, a mild perspective: near edges appear at most 1.4 times as long as far ones
constexpr double kDistancePerReach = 6.0;
constexpr double kMarginAround =
    0.05;  ///< fraction of the shorter side of the picture, on all sides
/// Minimum of object radius over distance from the origin: GL floats have six digits
constexpr double kMinReach = 1e-3;
/// Minimum tangent that the picture spans, for objects that are a single point
constexpr double kMinWidth = 0.02;
constexpr double kGap = 0.14;  ///< between objects, fraction of their mean width

/// The extent of an object in the picture plane, as tangents of angles at its camera.
struct Extent {
    double left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;
    double width() const { return right - left; }
};

Extent extent_of(const Points& positions, const Vec3& camera, const ObjectAxes& axes) {
    Extent extent;
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
        const Vec3 arm = positions.row(v).transpose() - camera;
        const double depth = -arm.dot(axes.backward);
        const double x = arm.dot(axes.right) / depth, y = arm.dot(axes.up) / depth;
        extent.left = std::min(extent.left, x);
        extent.right = std::max(extent.right, x);
        extent.bottom = std::min(extent.bottom, y);
        extent.top = std::max(extent.top, y);
    }
    return extent;
}

}  // namespace

ObjectAxes object_axes(double azimuth_deg, double elevation_deg) {
    const double a = azimuth_deg * std::numbers::pi / 180;
    const double e = elevation_deg * std::numbers::pi / 180;
    ObjectAxes axes;
    axes.backward = Vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    axes.right = Vec3(-std::sin(a), std::cos(a), 0);
    axes.up = axes.backward.cross(axes.right);
    return axes;
}

ObjectRow frame_objects(const std::vector<const Points*>& objects, const ObjectAxes& axes,
                        int width_px, int height_px) {
    // Centres: sideways each object's own, vertically one for all objects.
    double low = INFINITY, high = -INFINITY;
    for (const Points* positions : objects) {
        low = std::min(low, positions->col(2).minCoeff());
        high = std::max(high, positions->col(2).maxCoeff());
    }
    std::vector<Vec3> middles;
    ObjectRow row{.axes = axes, .cameras = {}, .reach_m = 1e-9, .distance_m = 0, .pixel_m = 0};
    for (const Points* positions : objects) {
        Vec3 middle =
            (positions->colwise().minCoeff() + positions->colwise().maxCoeff()).transpose() / 2;
        middle.z() = (low + high) / 2;
        middles.push_back(middle);
        const double squared =
            (positions->rowwise() - middle.transpose()).rowwise().squaredNorm().maxCoeff();
        row.reach_m = std::max({row.reach_m, std::sqrt(squared), kMinReach * middle.norm()});
    }
    row.distance_m = kDistancePerReach * row.reach_m;

    // The extents side by side
    std::vector<Extent> extents;
    double width = 0, bottom = INFINITY, top = -INFINITY;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        extents.push_back(
            extent_of(*objects[i], middles[i] + row.distance_m * axes.backward, axes));
        width += extents.back().width();
        bottom = std::min(bottom, extents.back().bottom);
        top = std::max(top, extents.back().top);
    }
    const double count = static_cast<double>(objects.size());
    const double gap = kGap * width / count;
    width += gap * (count - 1);

    // The scale at which the row fills the picture up to the margin
    const double margin_px = kMarginAround * std::min(width_px, height_px);
    const double tangent_per_px =
        std::max({width / (width_px - 2 * margin_px), (top - bottom) / (height_px - 2 * margin_px),
                  kMinWidth / width_px});
    const double across = 2 / (tangent_per_px * width_px), along = 2 / (tangent_per_px * height_px);
    row.pixel_m = tangent_per_px * row.distance_m;
    double place = -width / 2;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Vec3 camera = middles[i] + row.distance_m * axes.backward;
        Mat3 turn;
        turn << axes.right.transpose(), axes.up.transpose(), axes.backward.transpose();
        Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
        view.block<3, 3>(0, 0) = turn;
        view.block<3, 1>(0, 3) = -turn * camera;
        // X and y divided by depth, and shifted. Depth itself is not needed because parts are drawn in order.
        Eigen::Matrix4d project = Eigen::Matrix4d::Zero();
        project(0, 0) = across;
        project(0, 2) = -across * (place - extents[i].left);
        project(1, 1) = along;
        project(1, 2) = along * (bottom + top) / 2;
        project(3, 2) = -1;
        row.cameras.push_back({camera, project * view});
        place += extents[i].width() + gap;
    }
    return row;
}

}  // namespace risorius::render
