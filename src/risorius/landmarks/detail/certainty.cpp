// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/certainty.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/json_cursor.h"
#include "risorius/rig/head.h"
#include "risorius/rig/landmark_check.h"

namespace risorius::landmarks {

namespace {

// Fitted to the errors on the heads of docs/validation: what is left where everything agrees, and the shares of the signs.
constexpr double kLeast_m = 1.2e-3, kOfUnseen = 0.5, kOfOff = 1.0, kOfDisagreement = 1.0;
// A landmark that the others contradict
constexpr double kOfContradiction = 0.7;

std::string whole_mm(double metres) { return format_number(std::round(1e3 * metres)) + " mm"; }

}  // namespace

std::map<std::string, JudgedLandmark> judged_landmarks(
    const std::vector<std::map<std::string, PlacedLandmark>>& placed, const ShownHead& head,
    const rig::Atlas& atlas) {
    std::map<std::string, JudgedLandmark> out;
    const double count = static_cast<double>(placed.size());
    for (const auto& [id, first] : placed.front()) {
        Vec3 mean = Vec3::Zero();
        double unseen = 0, off = 0, disagreement = 0;
        bool everywhere = true;
        for (const auto& by : placed) everywhere = everywhere && by.count(id) > 0;
        if (!everywhere) continue;
        for (const auto& by : placed) {
            mean += by.at(id).at / count;
            unseen = std::max(unseen, by.at(id).unseen_m);
            off += by.at(id).off_m / count;
        }
        for (const auto& by : placed) disagreement += (by.at(id).at - mean).norm() / count;
        JudgedLandmark& to = out[id];
        to.at = head.skin_tree.closest(mean)->point;
        to.expected_m =
            std::sqrt(std::pow(kLeast_m, 2) + std::pow(kOfUnseen * unseen, 2) +
                      std::pow(kOfOff * off, 2) + std::pow(kOfDisagreement * disagreement, 2));
    }

    std::map<std::string, Vec3> positions;
    for (const auto& [id, landmark] : out) positions[id] = landmark.at;
    const rig::HeadFrame frame = rig::find_head_frame(positions, atlas, 1.0);
    for (auto& [id, p] : positions) p = frame.to_head(p);
    for (const rig::LandmarkPrediction& doubt :
         rig::doubtful_landmarks(positions, atlas, frame.size)) {
        JudgedLandmark& to = out.at(doubt.id);
        to.expected_m = std::max(to.expected_m, kOfContradiction * doubt.off_m);
        to.reason = "the other landmarks put it " + whole_mm(doubt.off_m) + " away";
    }
    return out;
}

}  // namespace risorius::landmarks
