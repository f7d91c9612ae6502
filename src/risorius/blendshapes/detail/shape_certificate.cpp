// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_certificate.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"

namespace risorius::blendshapes {

std::vector<std::string> ShapeCertificate::complaints(const ShapeLimits& limits) const {
    std::vector<std::string> out;
    const auto check = [&](const char* what, double value, double limit, double scale,
                           const char* unit) {
        if (!(value > limit)) return;
        char text[128];
        std::snprintf(text, sizeof text, "%s %.2f %s, more than %.2f", what, scale * value, unit,
                      scale * limit);
        out.push_back(text);
    };
    check("volume changed by", std::abs(volume_change), limits.volume_ratio, 100, "%");
    check("lip in lip", lip_depth_m, limits.penetration_m, 1e3, "mm");
    check("skin in eye", eye_depth_m, limits.penetration_m, 1e3, "mm");
    if (lid_gap_m) check("lids open by", *lid_gap_m, limits.lid_gap_m, 1e3, "mm");
    if (asymmetry_m) check("sides differ by", *asymmetry_m, limits.asymmetry_m, 1e3, "mm");
    check("teeth or eyes bent by", rigid_part_m, limits.rigid_part_m, 1e3, "mm");
    if (!converged) out.push_back("did not come to rest");
    return out;
}

Json ShapeCertificate::json() const {
    const auto mm = [](const std::optional<double>& value) {
        return value ? Json(1e3 * *value) : Json();
    };
    return json_object({{"volume_change", volume_change},
                        {"lip_depth_mm", 1e3 * lip_depth_m},
                        {"eye_depth_mm", 1e3 * eye_depth_m},
                        {"bone_depth_mm", 1e3 * bone_depth_m},
                        {"rigid_part_mm", 1e3 * rigid_part_m},
                        {"lid_gap_mm", mm(lid_gap_m)},
                        {"lip_gap_mm", mm(lip_gap_m)},
                        {"asymmetry_mm", mm(asymmetry_m)},
                        {"asymmetry_as_solved_mm", mm(asymmetry_as_solved_m)},
                        {"largest_stretch", stretch.max},
                        {"stretch_of_99_percent", stretch.max_of_99},
                        {"least_stretch", stretch.min},
                        {"peak_mm", 1e3 * peak_m},
                        {"moved_vertices", moved_vertices},
                        {"converged", converged},
                        {"inverted_tets", inverted_tets},
                        {"complaints", complaints()}});
}

}  // namespace risorius::blendshapes
