// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/landmark_pictures.h"

#include <algorithm>
#include <array>

#include "risorius/render/measure_view.h"

namespace risorius::landmarks {

namespace {

constexpr int kWidth_px = 560, kHeight_px = 760;
constexpr double kSeen_m = 0.30;  // visible height on an average head
constexpr double kCrownAboveNasion_m = 0.11;
const Vec3 kSkinPaint(0.86, 0.80, 0.76), kEyePaint(0.98, 0.98, 0.98), kInnerPaint(0.72, 0.52, 0.50);

struct ShownView {
    const char* name;
    double azimuth_deg;
};
constexpr std::array<ShownView, 4> kShownViews{
    {{"front", 0}, {"half_left", 45}, {"left", 90}, {"right", -90}}};

}  // namespace

Vec3 certainty_colour(Certainty certainty) {
    switch (certainty) {
        case Certainty::kSure:
            return {0.05, 0.50, 0.20};
        case Certainty::kDoubtful:
            return {0.93, 0.56, 0.05};
        case Certainty::kUnsure:
            break;
    }
    return {0.80, 0.05, 0.10};
}

std::vector<LandmarkPicture> landmark_pictures(
    const ShownHead& head, const std::map<std::string, JudgedLandmark>& at,
    const std::map<std::string, ProposedLandmark>& proposed) {
    // One colour per vertex: parts do not share vertices.
    std::vector<Vec3> colours(static_cast<std::size_t>(head.positions.rows()), kSkinPaint);
    for (Eigen::Index f = 0; f < head.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const ShownPart part = head.part[static_cast<std::size_t>(f)];
            if (part == ShownPart::kSkin) continue;
            colours[static_cast<std::size_t>(head.triangles(f, k))] =
                part == ShownPart::kMouth ? kInnerPaint : kEyePaint;
        }
    std::vector<render::Mark> marks;
    for (const auto& [id, landmark] : proposed) {
        const bool sure = landmark.certainty() == Certainty::kSure;
        marks.push_back({at.at(id).at, certainty_colour(landmark.certainty()), sure ? 3.5 : 5.0});
    }
    const auto crown = at.find("v");
    const double top = crown == at.end() ? at.at("n").at.y() + kCrownAboveNasion_m
                                         : crown->second.at.y(),
                 bottom = at.at("me").at.y();
    std::vector<LandmarkPicture> out;
    for (const ShownView& view : kShownViews)
        out.push_back({view.name, render::draw_measured(
                                      {{head.positions, head.triangles, colours}}, marks, {},
                                      {.width_px = kWidth_px,
                                       .height_px = kHeight_px,
                                       .azimuth_deg = view.azimuth_deg,
                                       .centre = Vec3(0, 0.5 * (top + bottom) - 0.012,
                                                      view.azimuth_deg == 0 ? 0.0 : 0.012),
                                       .height_m = std::max(kSeen_m, 1.25 * (top - bottom))})});
    return out;
}

}  // namespace risorius::landmarks
