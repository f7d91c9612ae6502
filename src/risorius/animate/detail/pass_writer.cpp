// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/pass_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/json_text.h"
#include "risorius/media/float_image.h"
#include "risorius/media/image_file.h"
#include "risorius/report/atomic_file.h"
#include "risorius/scene/face_oval.h"

namespace risorius::animate {

namespace {

using render::Part;

bool is_of_eye(std::uint16_t part) {
    return part >= static_cast<std::uint16_t>(Part::kScleraLeft) &&
           part <= static_cast<std::uint16_t>(Part::kEyeCorner);
}

bool is_of_mouth(std::uint16_t part) {
    return part == static_cast<std::uint16_t>(Part::kLips) ||
           (part >= static_cast<std::uint16_t>(Part::kTeeth) &&
            part <= static_cast<std::uint16_t>(Part::kMouth));
}

}  // namespace

const std::vector<std::string>& pass_names() {
    static const std::vector<std::string> names{"segmentation", "depth", "normals", "flow",
                                                "masks"};
    return names;
}

PassWriter::PassWriter(const std::filesystem::path& folder, const std::vector<std::string>& passes,
                       const render::Scene& scene, const Eigen::Matrix4d& clip_from_world,
                       int width_px, int height_px, const scene::LandmarkPoints& landmarks)
    : passes_(passes),
      folder_(folder),
      surface_(scene, clip_from_world, width_px, height_px),
      clip_from_world_(clip_from_world),
      landmarks_(landmarks) {}

bool PassWriter::wanted(const char* pass) const {
    return std::find(passes_.begin(), passes_.end(), pass) != passes_.end();
}

std::filesystem::path PassWriter::file_of(const char* what, int frame, const char* ending) {
    char name[64];
    std::snprintf(name, sizeof name, "%s_%06d.%s", what, frame, ending);
    files_.push_back(name);
    return folder_.partial() / name;
}

void PassWriter::add(int frame, const Points& positions) {
    const int width = surface_.width_px(), height = surface_.height_px();
    render::SeenSurface seen = surface_.look(positions);
    if (wanted("segmentation") || wanted("masks")) {
        const std::vector<std::uint16_t> parts = surface_.parts(seen);
        if (wanted("segmentation"))
            media::write_grey_png(width, height, 8, parts, file_of("segmentation", frame, "png"));
        if (wanted("masks")) write_masks(frame, seen, parts);
    }
    if (wanted("depth"))
        media::write_exr({width, height, 1, surface_.depth(seen)}, file_of("depth", frame, "exr"));
    if (wanted("normals"))
        media::write_exr({width, height, 3, surface_.normals(seen)},
                         file_of("normals", frame, "exr"));
    if (!wanted("flow")) return;
    if (before_)
        media::write_exr({width, height, 3, surface_.flow(*before_, seen)},
                         file_of("flow", frame - 1, "exr"));
    before_ = std::move(seen);
}

void PassWriter::write_masks(int frame, const render::SeenSurface& seen,
                             const std::vector<std::uint16_t>& parts) {
    const int width = surface_.width_px(), height = surface_.height_px();
    const std::vector<std::string> known = landmarks_.ids();
    std::vector<Vec2> border;
    for (const std::string& id : scene::FaceOval::landmarks()) {
        if (std::find(known.begin(), known.end(), id) == known.end()) continue;
        const Eigen::Vector4d clip =
            clip_from_world_ * landmarks_.at(id, seen.positions).homogeneous();
        border.emplace_back((clip.x() / clip.w() * 0.5 + 0.5) * width,
                            (0.5 - clip.y() / clip.w() * 0.5) * height);
    }
    const scene::FaceOval oval(std::move(border));
    auto& [face, eyes, mouth] = masks_;
    for (std::vector<std::uint16_t>* mask : {&face, &eyes, &mouth}) mask->assign(parts.size(), 0);
    for (int y = 0, i = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (parts[at] == 0) continue;
            const bool lock = surface_.shows_lock(seen, at);
            if (!lock && oval.contains({x + 0.5, y + 0.5})) face[at] = 255;
            if (is_of_eye(parts[at])) eyes[at] = 255;
            if (is_of_mouth(parts[at])) mouth[at] = 255;
        }
    media::write_grey_png(width, height, 8, face, file_of("mask_face", frame, "png"));
    media::write_grey_png(width, height, 8, eyes, file_of("mask_eyes", frame, "png"));
    media::write_grey_png(width, height, 8, mouth, file_of("mask_mouth", frame, "png"));
}

void PassWriter::commit() {
    Json json;
    json["format"] = "risorius-passes";
    json["version"] = 1;
    json["passes"] = passes_;
    json["parts"] = render::part_names();
    json["width_px"] = surface_.width_px();
    json["height_px"] = surface_.height_px();
    json["clip_from_world"] = Json::array();
    for (int row = 0; row < 4; ++row) {
        Json values = Json::array();
        for (int column = 0; column < 4; ++column) values.push_back(clip_from_world_(row, column));
        json["clip_from_world"].push_back(values);
    }
    files_.push_back("results.json");
    json[report::kFilesKey] = files_;
    report::write_text(folder_.partial() / "results.json", json_text(json, 1) + "\n");
    folder_.commit();
}

}  // namespace risorius::animate
