// SPDX-License-Identifier: MIT
#include "risorius/fitting/landmark_file.h"

#include <algorithm>

namespace risorius::fitting {

std::map<std::string, rig::Landmark> read_atlas_named_landmarks(
    const std::filesystem::path& file, const std::vector<rig::AtlasLandmark>& atlas) {
    const auto landmarks = rig::read_landmarks(file);
    std::vector<std::string_view> known;
    for (const rig::AtlasLandmark& landmark : atlas) known.push_back(landmark.id);
    for (const auto& [id, landmark] : landmarks) {
        if (std::find(known.begin(), known.end(), id) != known.end()) continue;
        const std::string near = nearest_name(id, known);
        throw Error(file.string() + ":/landmarks/" + id,
                    near.empty() ? "a landmark of the atlas"
                                 : "a landmark of the atlas (did you mean \"" + near + "\"?)",
                    "\"" + id + "\"");
    }
    return landmarks;
}

}  // namespace risorius::fitting
