// SPDX-License-Identifier: MIT
#include "risorius/fitting/landmark_file.h"

#include <algorithm>

#include "risorius/core/known_names.h"
#include "risorius/rig/head.h"

namespace risorius::fitting {

std::map<std::string, rig::Landmark> read_atlas_named_landmarks(
    const std::filesystem::path& file, const std::vector<rig::AtlasLandmark>& atlas) {
    const auto landmarks = rig::read_landmarks(file);
    std::vector<std::string> known;
    for (const rig::AtlasLandmark& landmark : atlas) known.push_back(landmark.id);
    for (const auto& [id, landmark] : landmarks) {
        if (std::find(known.begin(), known.end(), id) != known.end()) continue;
        throw Error(file.string() + ":/landmarks/" + id,
                    "a landmark of the atlas" + did_you_mean(id, known), "\"" + id + "\"");
    }
    return landmarks;
}

std::vector<std::string> leave_out_unsure(std::map<std::string, rig::Landmark>& landmarks,
                                          const std::filesystem::path& file) {
    std::string ids;
    for (auto at = landmarks.begin(); at != landmarks.end();) {
        if (at->second.confidence >= kLeastConfidence) {
            ++at;
            continue;
        }
        const auto& needed = rig::required_landmarks();
        if (std::find(needed.begin(), needed.end(), at->first) != needed.end())
            throw Error(file.string() + ":/landmarks/" + at->first + "/confidence",
                        "at least " + format_number(kLeastConfidence) +
                            " for a landmark that a rig needs (correct it, and take the key out)",
                        format_number(at->second.confidence));
        ids += (ids.empty() ? "" : " ") + at->first;
        at = landmarks.erase(at);
    }
    if (ids.empty()) return {};
    return {"landmarks of little confidence are left to the atlas: " + ids};
}

}  // namespace risorius::fitting
