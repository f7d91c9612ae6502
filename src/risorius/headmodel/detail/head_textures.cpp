// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/head_textures.h"

#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/media/image_file.h"
#include "risorius/render/lash_picture.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/atomic_file.h"

namespace risorius::headmodel {
namespace {

/// A picture, what lies on it, and how that shines: the exponent of Phong's highlight and its strength.
struct PartPicture {
    const char* file;
    render::Material material;
    std::vector<const char*> groups;
    int exponent;
    double gloss;
};
const std::vector<PartPicture>& part_pictures() {
    using render::Material;
    static const std::vector<PartPicture> pictures{
        {"skin.png", Material::kSkin, {"skin", "mouth"}, 12, 0.08},
        {"eyes.png", Material::kEye, {"eye_l", "eye_r"}, 400, 0.6},
        {"teeth.png", Material::kTeeth, {"teeth_upper", "teeth_lower"}, 80, 0.25},
        {"gums.png", Material::kGums, {"gums_upper", "gums_lower"}, 60, 0.2},
        {"tongue.png", Material::kTongue, {"tongue"}, 60, 0.2}};
    return pictures;
}

constexpr const char* kLashFile = "lashes.png";

}  // namespace

std::vector<std::string> write_head_textures(const render::Scene& scene, int side_px,
                                             const std::vector<double>& crown_height,
                                             const std::filesystem::path& folder) {
    constexpr int kMin_px = 256, kMax_px = 4096;
    if (side_px < kMin_px || side_px > kMax_px)
        throw Error("texture_px", std::to_string(kMin_px) + ".." + std::to_string(kMax_px),
                    std::to_string(side_px));
    // The square of the skin holds a head of 0.6 m from ear to ear over the crown, and the view is as fine; the others hold less.
    const render::OffscreenView view(scene, {.width_px = side_px / 2, .height_px = side_px / 2});
    std::vector<std::string> files;
    for (const PartPicture& part : part_pictures()) {
        media::write_png(part.material == render::Material::kSkin
                             ? view.skin_texture(scene, side_px)
                             : view.part_texture(scene, part.material, side_px / 2, crown_height),
                         folder / part.file);
        files.emplace_back(part.file);
    }
    media::write_png(render::lash_opacity(side_px / 2), folder / kLashFile);
    files.emplace_back(kLashFile);
    report::write_text(folder / kTextureLibrary, texture_library(scene.appearance.hair_tone));
    files.emplace_back(kTextureLibrary);
    return files;
}

std::string texture_library(const Vec3& hair_tone) {
    const auto material = [](const std::string& group, const Vec3& colour, int exponent,
                             double gloss) {
        const auto three = [](const Vec3& v) {
            return format_number(v.x()) + " " + format_number(v.y()) + " " + format_number(v.z());
        };
        return "newmtl " + group + "\nKd " + three(colour) + "\nKs " +
               three(Vec3::Constant(gloss)) + "\nNs " + std::to_string(exponent) + "\n";
    };
    std::string text = "# Materials of head.obj, by its groups.\n";
    for (const PartPicture& part : part_pictures())
        for (const char* group : part.groups)
            text += material(group, Vec3::Ones(), part.exponent, part.gloss) + "map_Kd " +
                    part.file + "\n";
    for (const char* group : {"lashes_l", "lashes_r"})
        text += material(group, hair_tone, 10, 0) + "map_d " + kLashFile + "\n";
    return text;
}

}  // namespace risorius::headmodel
