// SPDX-License-Identifier: MIT
#include "risorius/render/detail/posed_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace risorius::render {
namespace {

// For a head without landmarks of the lips: the gap of the lips at full opening of the jaw, and the width of the mouth.
constexpr double kFullGap_m = 0.035;
constexpr double kMouthWidth_m = 0.050;

double smoothstep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double opening(const LidMarks& lids) {
    const double width = (lids.outer - lids.inner).norm();
    return lids.known && width > 0 ? (lids.upper - lids.lower).norm() / width : 0.0;
}

}  // namespace

PosedMarks::PosedMarks(const Scene& scene) {
    std::vector<int> skin;
    for (const Surface& surface : scene.surfaces)
        if (surface.material == Material::kSkin)
            skin.insert(skin.end(), surface.triangles.data(),
                        surface.triangles.data() + surface.triangles.size());
    std::sort(skin.begin(), skin.end());
    skin.erase(std::unique(skin.begin(), skin.end()), skin.end());

    const auto nearest = [&](const std::string& id) {
        const auto mark = scene.landmarks.find(id);
        if (mark == scene.landmarks.end()) return -1;
        int best = -1;
        double min = std::numeric_limits<double>::infinity();
        for (const int v : skin) {
            const double d = (scene.rest.row(v).transpose() - mark->second).squaredNorm();
            if (d < min) {
                min = d;
                best = v;
            }
        }
        return best;
    };
    stos_ = nearest("stos");
    stoi_ = nearest("stoi");
    if (stos_ < 0 || stoi_ < 0 || stos_ == stoi_) {
        stos_ = nearest("ls");
        stoi_ = nearest("li");
    }
    ch_l_ = nearest("ch_l");
    ch_r_ = nearest("ch_r");
    if (stos_ >= 0 && stoi_ >= 0)
        rest_gap_m_ = (scene.rest.row(stos_) - scene.rest.row(stoi_)).norm();

    // Without landmarks, the mouth is at the foremost point of the teeth.
    for (const Surface& surface : scene.surfaces)
        if (surface.material == Material::kTeeth)
            for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
                const Vec3 p = scene.rest.row(surface.triangles.data()[i]).transpose();
                if (p.z() > mouth_rest_.z()) mouth_rest_ = p;
            }

    for (std::size_t eye = 0; eye < 2; ++eye) {
        const std::string side = eye == 0 ? "_l" : "_r";
        lids_[eye] = {nearest("en" + side), nearest("ex" + side), nearest("ps" + side),
                      nearest("pi" + side)};
        Pose rest;
        rest.positions = scene.rest;
        rest_opening_[eye] = opening(lids(rest, static_cast<int>(eye)));
    }
}

MouthGap PosedMarks::mouth_gap(const Pose& pose) const {
    MouthGap gap;
    const auto at = [&](int v) -> Vec3 { return pose.positions.row(v).transpose(); };
    if (stos_ < 0 || stoi_ < 0 || ch_l_ < 0 || ch_r_ < 0) {
        gap.centre = mouth_rest_ + Vec3(0, 0, 0.008);
        gap.half_axis = Vec3(kMouthWidth_m / 2, 0, 0);
        gap.area_m2 =
            std::numbers::pi / 4 * kMouthWidth_m * kFullGap_m * std::max(pose.jaw_open, 0.0);
        return gap;
    }
    gap.centre = (at(stos_) + at(stoi_)) / 2;
    gap.half_axis = (at(ch_l_) - at(ch_r_)) / 2;
    const double height = std::max((at(stos_) - at(stoi_)).norm() - rest_gap_m_, 0.0);
    gap.area_m2 = std::numbers::pi / 4 * 2 * gap.half_axis.norm() * height;
    return gap;
}

LidMarks PosedMarks::lids(const Pose& pose, int eye) const {
    LidMarks marks;
    const std::array<int, 4>& v = lids_[static_cast<std::size_t>(eye)];
    if (*std::min_element(v.begin(), v.end()) < 0) return marks;
    marks.known = true;
    marks.inner = pose.positions.row(v[0]).transpose();
    marks.outer = pose.positions.row(v[1]).transpose();
    marks.upper = pose.positions.row(v[2]).transpose();
    marks.lower = pose.positions.row(v[3]).transpose();
    return marks;
}

double PosedMarks::lids_closed(const Pose& pose, int eye) const {
    const double rest = rest_opening_[static_cast<std::size_t>(eye)];
    return rest > 0 ? std::clamp(1 - opening(lids(pose, eye)) / rest, 0.0, 1.0) : 0.0;
}

std::vector<float> PosedMarks::inside_mouth(const Scene& scene,
                                            const std::vector<float>& sky_seen) const {
    std::vector<float> inside(sky_seen.size(), 0.0F);
    if (stos_ < 0 || stoi_ < 0 || ch_l_ < 0 || ch_r_ < 0) return inside;
    const Vec3 lips = (scene.rest.row(stos_) + scene.rest.row(stoi_)).transpose() / 2;
    const Vec3 left = scene.rest.row(ch_l_).transpose(), right = scene.rest.row(ch_r_).transpose();
    const double half_width = std::max((left.x() - right.x()) / 2, 1e-3);
    const double middle = (left.x() + right.x()) / 2;
    const double corner_depth = lips.z() - (left.z() + right.z()) / 2;
    const auto subnasale = scene.landmarks.find("sn");
    const double roof =
        subnasale != scene.landmarks.end() ? subnasale->second.y() - 0.004 : lips.y() + 0.017;
    for (std::size_t v = 0; v < inside.size(); ++v) {
        const Vec3 p = scene.rest.row(static_cast<Eigen::Index>(v)).transpose();
        const double across = (p.x() - middle) / half_width;
        const double behind = lips.z() - corner_depth * across * across - p.z();
        // The nostrils are excluded: they are as dark, and lie above the front of the mouth.
        const bool in_box = std::abs(across) < 1.6 && std::abs(p.y() - lips.y()) < 0.045 &&
                            (p.y() < roof || behind > 0.032);
        if (in_box)
            inside[v] = static_cast<float>(smoothstep(-0.004, 0.001, behind) *
                                           smoothstep(0.36, 0.16, sky_seen[v]));
    }
    return inside;
}

}  // namespace risorius::render
