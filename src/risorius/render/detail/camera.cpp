// SPDX-License-Identifier: MIT
#include "risorius/render/detail/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/render/detail/names_of.h"
#include "risorius/render/framing.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

struct NamedCamera {
    const char* name;
    double azimuth_deg, elevation_deg = 0;
    /// Close-ups: the landmarks around the middle of the frame, and the height of the frame on a head of kHeadHeight_mm. Empty:
    /// the whole head.
    std::array<const char*, 2> middle{};
    double height_mm = 0;
};

constexpr double kHeadHeight_mm = 227.5;  // from chin to crown, of the standard head

// Positive azimuth looks at the subject's left side; positive elevation looks down.
constexpr NamedCamera kCameras[] = {{"front", 0},
                                    {"three_quarter", 38},
                                    {"three_quarter_right", -38},
                                    {"profile", 90},
                                    {"profile_right", -90},
                                    {"top", 0, 90},
                                    {"eye", 14, 0, {"en_l", "ex_l"}, 62},
                                    {"nose", 30, -12, {"prn", "sn"}, 80},
                                    {"mouth", 16, 0, {"sto", "sto"}, 74},
                                    {"ear", 82, 0, {"sa_l", "sba_l"}, 96}};

// Fractions of the height from chin to crown.
constexpr double kMarginAbove = 0.10;
constexpr double kMarginBelow = 0.22;
constexpr double kMarginBeside = 0.10;

// Distance over frame height. On a sensor 24 mm high, 4 corresponds to a lens of 96 mm.
constexpr double kDistancePerHeight = 4.0;
constexpr double kNearestDistance_m = 1.0;

const NamedCamera& camera_named(const std::string& name) {
    std::string known;
    for (const NamedCamera& camera : kCameras) {
        if (camera.name == name) return camera;
        if (!known.empty()) known += ", ";
        known.append("\"").append(camera.name).append("\"");
    }
    throw Error("camera", "one of " + known, "\"" + name + "\"");
}

void check(const char* field, double value, double min, double max) {
    if (value >= min && value <= max) return;
    char range[64], found[32];
    std::snprintf(range, sizeof range, "[%g, %g]", min, max);
    std::snprintf(found, sizeof found, "%g", value);
    throw Error(field, range, found);
}

void check_lens(const Lens& lens) {
    if (lens.distance_m) check("distance_m", *lens.distance_m, 0.2, 100);
    if (lens.view_angle_deg) check("view_angle_deg", *lens.view_angle_deg, 0.5, 90);
    check("aperture_mm", lens.aperture_mm, 0, 100);
}

}  // namespace

const std::vector<std::string>& camera_names() {
    static const std::vector<std::string> names = names_of(kCameras);
    return names;
}

Camera make_camera(const std::string& name, const std::map<std::string, Vec3>& landmarks,
                   const Vec3& skin_min, const Vec3& skin_max, double aspect, const Lens& lens) {
    check_lens(lens);
    Camera camera;
    const NamedCamera& named = camera_named(name);
    constexpr double kDegree = std::numbers::pi / 180;
    camera.azimuth_rad = kDegree * named.azimuth_deg;
    const double elevation_rad = kDegree * named.elevation_deg;

    // What must be visible: the height comes from the landmarks, the width and depth from the skin above the chin.
    const auto crown = landmarks.find("v");
    const auto chin = landmarks.find("me");
    const bool marked =
        crown != landmarks.end() && chin != landmarks.end() && crown->second.y() > chin->second.y();
    const double top = marked ? crown->second.y() : skin_max.y();
    const double bottom = marked ? chin->second.y() : skin_min.y();
    const double height = std::max(top - bottom, 1e-3);
    const double frame_bottom = bottom - kMarginBelow * height;
    const double frame_top = top + kMarginAbove * height;

    // The head is centred sideways on its midplane in front views, and on the middle of its depth in profile.
    const Vec3 right(std::cos(camera.azimuth_rad), 0.0, -std::sin(camera.azimuth_rad));
    Vec3 target((skin_min.x() + skin_max.x()) / 2, (frame_bottom + frame_top) / 2,
                (skin_min.z() + skin_max.z()) / 2);
    Vec3 half_box = (skin_max - skin_min) / 2;
    if (marked) {
        // The width of a head is about two thirds of its height, the depth nine tenths. Shoulders do not count.
        const auto nose = landmarks.find("prn");
        const double front = nose != landmarks.end() ? nose->second.z() : skin_max.z();
        half_box = Vec3(0.40 * height, half_box.y(), 0.46 * height);
        target.x() = (crown->second.x() + chin->second.x()) / 2;
        target.z() = front - half_box.z();
    }
    const double half_width =
        std::abs(right.x()) * half_box.x() + std::abs(right.z()) * half_box.z();
    camera.frame_height_m =
        std::max(frame_top - frame_bottom, 2 * half_width * (1 + kMarginBeside) / aspect);

    camera.portrait_height_m = camera.frame_height_m;
    // Seen from above, the depth of a head is about its height in a front view
    if (named.elevation_deg > 80) target.y() = (top + bottom) / 2;
    if (named.height_mm > 0 && marked && landmarks.contains(named.middle[0]) &&
        landmarks.contains(named.middle[1])) {
        target = (landmarks.at(named.middle[0]) + landmarks.at(named.middle[1])) / 2;
        camera.frame_height_m = named.height_mm / kHeadHeight_mm * height / std::min(aspect, 1.0);
    }

    double distance = std::max(kNearestDistance_m, kDistancePerHeight * camera.frame_height_m);
    const double half_angle = lens.view_angle_deg.value_or(0) * std::numbers::pi / 360;
    if (lens.distance_m) distance = *lens.distance_m;
    if (lens.view_angle_deg && lens.distance_m)
        camera.frame_height_m = 2 * distance * std::tan(half_angle);
    else if (lens.view_angle_deg)
        distance = camera.frame_height_m / 2 / std::tan(half_angle);
    const Vec3 backward(std::cos(elevation_rad) * std::sin(camera.azimuth_rad),
                        std::sin(elevation_rad),
                        std::cos(elevation_rad) * std::cos(camera.azimuth_rad));
    camera.up = backward.cross(right);
    camera.position = target + distance * backward;
    camera.backward = backward;
    camera.orthographic = lens.orthographic;
    Mat4 view = Mat4::Identity();
    view.block<1, 3>(0, 0) = right.transpose();
    view.block<1, 3>(1, 0) = camera.up.transpose();
    view.block<1, 3>(2, 0) = backward.transpose();
    view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * camera.position;

    const double reach = std::max((skin_max - skin_min).norm(), camera.frame_height_m);
    const double near = std::max(0.1 * distance, distance - reach);
    const double far = distance + reach;
    const double slope = camera.frame_height_m / 2 / distance;
    Mat4 projection = Mat4::Zero();
    projection(0, 0) = 1 / (slope * aspect);
    projection(1, 1) = 1 / slope;
    projection(2, 2) = -(far + near) / (far - near);
    projection(2, 3) = -2 * far * near / (far - near);
    projection(3, 2) = -1;
    if (lens.orthographic) {
        projection(0, 0) = 2 / (camera.frame_height_m * aspect);
        projection(1, 1) = 2 / camera.frame_height_m;
        projection(2, 2) = -2 / (far - near);
        projection(2, 3) = -(far + near) / (far - near);
        projection(3, 2) = 0;
        projection(3, 3) = 1;
    }
    camera.clip_from_world = projection * view;
    return camera;
}

std::vector<Mat4> lens_views(const Camera& camera, const std::map<std::string, Vec3>& landmarks,
                             const Lens& lens) {
    if (lens.aperture_mm <= 0 || lens.orthographic) return {camera.clip_from_world};
    constexpr int kViews = 32;
    Vec3 focus = Vec3::Zero();
    int marks = 0;
    for (const char* id : {"en_l", "ex_l", "en_r", "ex_r"})
        if (const auto mark = landmarks.find(id); mark != landmarks.end()) {
            focus += mark->second;
            ++marks;
        }
    if (marks > 0) focus /= marks;
    const double distance = std::max((camera.position - focus).dot(camera.backward), 0.05);
    const Vec3 up = camera.up, right = up.cross(camera.backward);
    std::vector<Mat4> views;
    for (int i = 0; i < kViews; ++i) {
        // Vogel's spiral fills the disc evenly.
        const double radius = 0.5e-3 * lens.aperture_mm * std::sqrt((i + 0.5) / kViews);
        const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const Vec3 aside = radius * (std::cos(turn) * right + std::sin(turn) * up);
        // A shear of the world along the view direction, which leaves the plane of focus unchanged.
        Mat4 shear = Mat4::Identity();
        shear.block<3, 3>(0, 0) += aside * camera.backward.transpose() / distance;
        shear.block<3, 1>(0, 3) = -aside * camera.backward.dot(focus) / distance;
        views.push_back(camera.clip_from_world * shear);
    }
    return views;
}

Framing::Framing(const std::map<std::string, Vec3>& landmarks, const Vec3& min, const Vec3& max,
                 const ViewOptions& options)
    : clip_from_world_(make_camera(options.camera, landmarks, min, max,
                                   static_cast<double>(options.width_px) / options.height_px,
                                   options.lens)
                           .clip_from_world),
      width_px_(options.width_px),
      height_px_(options.height_px) {}

Vec2 Framing::project(const Vec3& world) const {
    const Eigen::Vector4d clip = clip_from_world_ * world.homogeneous();
    return {(clip.x() / clip.w() * 0.5 + 0.5) * width_px_,
            (0.5 - clip.y() / clip.w() * 0.5) * height_px_};
}

}  // namespace risorius::render
