// SPDX-License-Identifier: MIT
// What the page of the studio shows that takes seconds to make: painted textures, and the bones under the skin.
#include <algorithm>
#include <thread>

#include "risorius/face/view/skull.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/view/scene_frame.h"
#include "tools/risorius/studio.h"

namespace risorius::cli {

namespace {

constexpr double kBoneStep_mm = 2.5;  // coarser than in videos: it comes sooner
constexpr int kSkinPicture_px = 1024, kPartPicture_px = 256, kMeshPicture_px = 2048;

/// Half the size: the mean of four pixels each.
Image halved(const Image& image) {
    Image out(std::max(1, image.width_px / 2), std::max(1, image.height_px / 2));
    for (int y = 0; y < out.height_px; ++y)
        for (int x = 0; x < out.width_px; ++x)
            for (int c = 0; c < 4; ++c) {
                int sum = 0;
                for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
                    sum += image.pixel(std::min(2 * x + dx, image.width_px - 1),
                                       std::min(2 * y + dy, image.height_px - 1))[c];
                out.pixel(x, y)[c] = static_cast<std::uint8_t>((sum + 2) / 4);
            }
    return out;
}

/// A picture of the mesh, which may be large, as the page gets it.
Image for_page(const Image& image) {
    Image out = image;
    while (std::max(out.width_px, out.height_px) > kMeshPicture_px) out = halved(out);
    return out;
}

/// The pictures of the mesh, and of what has none.
std::vector<std::shared_ptr<const std::string>> painted(const render::Scene& scene) {
    std::vector<std::shared_ptr<const std::string>> out;
    const auto add = [&](const char* material, const Image& picture) {
        out.push_back(std::make_shared<const std::string>(view::encode_picture(material, picture)));
    };
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        add(std::to_string(i).c_str(), for_page(scene.textures[i]));
    const auto textured = [&](render::Material material) {
        return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const auto& one) {
            return one.material == material && one.texture < 0 && one.texcoords.rows() > 0;
        });
    };
    const render::OffscreenView view(
        scene, {.width_px = kSkinPicture_px / 2, .height_px = kSkinPicture_px / 2});
    if (textured(render::Material::kSkin)) add("skin", view.skin_texture(scene, kSkinPicture_px));
    for (const auto& [material, name] : {std::pair{render::Material::kEye, "eye"},
                                         {render::Material::kTeeth, "teeth"},
                                         {render::Material::kGums, "gums"},
                                         {render::Material::kTongue, "tongue"}})
        if (textured(material)) add(name, view.part_texture(scene, material, kPartPicture_px));
    return out;
}

}  // namespace

// The pictures take seconds to paint: the face moves meanwhile.
void Studio::make_pictures(serve::WebServer& server) {
    painter_ = std::make_unique<std::jthread>(
        [this, &server, scene = script_.session->drawn_scene(), of = script_.session.get()] {
            std::vector<std::shared_ptr<const std::string>> pictures;
            try {
                pictures = painted(scene);
            } catch (const std::exception&) {
                return;  // the page has plain colours
            }
            server.post([this, pictures = std::move(pictures), of] {
                if (script_.session.get() != of) return;
                pictures_ = pictures;
                for (const Page& page : pages_)
                    for (const auto& picture : pictures_) page.peer->send_binary(picture);
            });
        });
}

// The bones take seconds as well.
void Studio::make_skull() {
    if (skull_) return send_skull();
    if (bones_) return;
    bones_ = std::make_unique<std::jthread>([this, of = script_.session.get()] {
        std::shared_ptr<const std::string> skull;
        try {
            skull = std::make_shared<const std::string>(
                view::encode_skull(face::estimate_skull(of->head(), of->rig(), kBoneStep_mm)));
        } catch (const std::exception&) {
            return;  // a head whose bones cannot be told has none here
        }
        server_->post([this, skull, of] {
            if (script_.session.get() != of) return;
            skull_ = skull;
            send_skull();
        });
    });
}

void Studio::send_skull() {
    for (Page& page : pages_)
        if (page.wants_skull && !std::exchange(page.has_skull, true))
            page.peer->send_binary(skull_);
}

}  // namespace risorius::cli
