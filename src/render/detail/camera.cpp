#include "render/detail/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "render/offscreen_view.h"

namespace risorius::render {
namespace {

struct NamedDirection {
    const char* name;
    double azimuth_deg;
};

// Positive azimuth looks at the subject's left side.
constexpr NamedDirection kDirections[] = {{"front", 0},
                                          {"three_quarter", 38},
                                          {"three_quarter_right", -38},
                                          {"profile", 90},
                                          {"profile_right", -90}};

// Shares of the height from chin to crown.
constexpr double kMarginAbove = 0.10;
constexpr double kMarginBelow = 0.22;
constexpr double kMarginBeside = 0.10;

// Distance over frame height: 24 mm of film height times 4 is a 96 mm lens.
constexpr double kDistancePerHeight = 4.0;
constexpr double kNearestDistance_m = 1.0;

double direction_deg(const std::string& name) {
    std::string known;
    for (const NamedDirection& direction : kDirections) {
        if (direction.name == name) return direction.azimuth_deg;
        if (!known.empty()) known += ", ";
        known.append("\"").append(direction.name).append("\"");
    }
    throw Error("camera", "one of " + known, "\"" + name + "\"");
}

}  // namespace

const std::vector<std::string>& camera_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const NamedDirection& direction : kDirections) list.emplace_back(direction.name);
        return list;
    }();
    return names;
}

Camera make_camera(const std::string& name, const std::map<std::string, Vec3>& landmarks,
                   const Vec3& skin_min, const Vec3& skin_max, double aspect) {
    Camera camera;
    camera.azimuth_rad = direction_deg(name) * std::numbers::pi / 180.0;

    // What must be seen: height from the landmarks, width and depth from the skin above the chin.
    const auto crown = landmarks.find("v");
    const auto chin = landmarks.find("me");
    const bool marked =
        crown != landmarks.end() && chin != landmarks.end() && crown->second.y() > chin->second.y();
    const double top = marked ? crown->second.y() : skin_max.y();
    const double bottom = marked ? chin->second.y() : skin_min.y();
    const double height = std::max(top - bottom, 1e-3);
    const double frame_bottom = bottom - kMarginBelow * height;
    const double frame_top = top + kMarginAbove * height;

    // The head is centred across: its own middle plane in front views, the middle of its depth in profile.
    const Vec3 right(std::cos(camera.azimuth_rad), 0.0, -std::sin(camera.azimuth_rad));
    Vec3 target((skin_min.x() + skin_max.x()) / 2, (frame_bottom + frame_top) / 2,
                (skin_min.z() + skin_max.z()) / 2);
    Vec3 half_box = (skin_max - skin_min) / 2;
    if (marked) {
        // A head is about two thirds as wide, and nine tenths as deep, as it is high; shoulders do not count.
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

    // Perspective along the horizontal
    const double distance =
        std::max(kNearestDistance_m, kDistancePerHeight * camera.frame_height_m);
    const Vec3 backward(std::sin(camera.azimuth_rad), 0.0, std::cos(camera.azimuth_rad));
    camera.position = target + distance * backward;
    Mat4 view = Mat4::Identity();
    view.block<1, 3>(0, 0) = right.transpose();
    view.block<1, 3>(1, 0) = Vec3::UnitY().transpose();
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
    camera.clip_from_world = projection * view;
    return camera;
}

}  // namespace risorius::render
