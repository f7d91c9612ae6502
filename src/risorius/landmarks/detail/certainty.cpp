// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/certainty.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "risorius/core/json_cursor.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/geom/weld.h"
#include "risorius/landmarks/detail/by_definition.h"
#include "risorius/landmarks/detail/chin.h"
#include "risorius/landmarks/detail/tragus.h"
#include "risorius/rig/head.h"
#include "risorius/rig/landmark_check.h"

namespace risorius::landmarks {

namespace {

// Fitted to the errors on seven heads (docs/decisions/0091): what is left where everything agrees, and the shares of the signs.
constexpr double kLeast_m = 1.2e-3, kOfUnseen = 0.5, kOfOff = 1.0, kOfDisagreement = 1.0;
/// What a definition leaves open, mm: the part of the errors on those heads, marked by different hands, that no sign explains. By
/// id without the side.
const std::map<std::string, double>& open_mm() {
    static const std::map<std::string, double> values{
        {"sba", 8}, {"sa", 8},  {"mmb", 5},  {"eu", 5},   {"t", 3.5},   {"bp", 4},    {"ram", 4},
        {"ant", 4}, {"cer", 4}, {"ft", 3.5}, {"pg", 3},   {"go", 3},    {"fht", 3},   {"llc", 3},
        {"fml", 3}, {"zy", 3},  {"al", 2.5}, {"tr", 2.5}, {"mef", 2.5}, {"lor", 2.5}, {"mc", 2.5},
        {"bl", 2},  {"llm", 2}, {"sbal", 2}, {"ac", 2},   {"lli", 1.5}, {"ch", 1.5}};
    return values;
}
double open_of(const std::string& id) {
    const bool sided = id.ends_with("_l") || id.ends_with("_r");
    const auto found = open_mm().find(sided ? id.substr(0, id.size() - 2) : id);
    return found == open_mm().end() ? 0 : found->second;
}

// Bounds of a head, of the average adult
constexpr double kLowestCrown_mm = 100, kShortestHead_mm = 150, kCrownHalfWidth_mm = 25,
                 kMidlineHalfWidth_mm = 8, kLowestBack_mm = -20;
constexpr double kFlat_mm = 4;  // a highest point of a flat crown may lie elsewhere by as much
constexpr double kEdge_m = 5e-3, kBeyondEdge_m = 10e-3;
// A landmark that the others contradict
constexpr double kOfContradiction = 0.7;

/// Landmarks that their definition finds better than any comparison: the highest point of the head, and the midline point of its
/// back that is farthest from the glabella. Left alone on a mask, which has neither.
void find_by_definition(const ShownHead& head, const rig::HeadFrame& frame,
                        std::map<std::string, JudgedLandmark>& landmarks) {
    if (!landmarks.count("v") || !landmarks.count("op") || !landmarks.count("g")) return;
    const Vec3 glabella = frame.to_head(landmarks.at("g").at);
    const double mm = 1e-3 * frame.size;
    std::optional<Vec3> highest, farthest;
    double height = kLowestCrown_mm * mm, distance = kShortestHead_mm * mm;
    for (Eigen::Index f = 0; f < head.skin.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Vec3 in_mesh = head.positions.row(head.skin(f, k)).transpose(),
                       p = frame.to_head(in_mesh);
            if (std::abs(p.x()) < kCrownHalfWidth_mm * mm && p.y() > height) {
                height = p.y();
                highest = in_mesh;
            }
            const double away = (p - glabella).norm();
            if (std::abs(p.x()) < kMidlineHalfWidth_mm * mm && p.y() > kLowestBack_mm * mm &&
                p.z() < 0 && away > distance) {
                distance = away;
                farthest = in_mesh;
            }
        }
    if (!highest || !farthest) return;
    landmarks.at("v") = {*highest, kFlat_mm * mm, ""};
    landmarks.at("op") = {*farthest, kFlat_mm * mm, ""};
}

/// A mask ends before the ears: what is put on its edge belongs beyond. Lids, lips and nostrils have edges of their own.
void doubt_edges(const ShownHead& head, const rig::Atlas& atlas,
                 std::map<std::string, JudgedLandmark>& landmarks) {
    static const std::set<std::string> whole{"ear",  "cranium", "forehead", "jaw",
                                             "chin", "neck",    "cheek"};
    const geom::WeldedSurface skin = geom::weld(head.positions, head.skin);
    const geom::SurfaceEdges edges = geom::surface_edges(skin.triangles);
    for (auto& [id, landmark] : landmarks) {
        const rig::AtlasLandmark* known = atlas.landmark(id);
        if (known == nullptr || !whole.count(known->region)) continue;
        for (int e = 0; e < edges.count(); ++e) {
            if (edges.triangle_count(e) != 1) continue;
            const auto [first, second] = edges.vertices[static_cast<std::size_t>(e)];
            const Vec3 a = skin.positions.row(first).transpose(),
                       b = skin.positions.row(second).transpose();
            if (geom::closest_point_on_triangle(landmark.at, a, b, b).squared_distance >
                kEdge_m * kEdge_m)
                continue;
            landmark.expected_m = std::max(landmark.expected_m, kBeyondEdge_m);
            landmark.reason = "it lies at the edge of the skin";
            break;
        }
    }
}

/// The tragions that are found. Where only one of them lies at a sharp notch, the other is as far from where the comparison puts it, mirrored.
std::map<std::string, Vec3> tragions(const ShownHead& head, const Vec3& left, const Vec3& right) {
    const auto found_left = tragion_near(head, 1, left),
               found_right = tragion_near(head, -1, right);
    const auto mirrored = [&](const Vec3& found, const Vec3& guess, const Vec3& other) {
        const Vec3 way = found - guess;
        return head.skin_tree.closest(other + Vec3(-way.x(), way.y(), way.z()))->point;
    };
    const bool notch_left = found_left && found_left->at_notch,
               notch_right = found_right && found_right->at_notch;
    std::map<std::string, Vec3> out;
    if (found_left)
        out["t_l"] =
            notch_right && !notch_left ? mirrored(found_right->at, right, left) : found_left->at;
    if (found_right)
        out["t_r"] =
            notch_left && !notch_right ? mirrored(found_left->at, left, right) : found_right->at;
    return out;
}

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
        to.expected_m = std::sqrt(
            std::pow(kLeast_m, 2) + std::pow(kOfUnseen * unseen, 2) + std::pow(kOfOff * off, 2) +
            std::pow(kOfDisagreement * disagreement, 2) + std::pow(1e-3 * open_of(id), 2));
    }

    std::map<std::string, Vec3> positions;
    for (const auto& [id, landmark] : out) positions[id] = landmark.at;
    for (const auto& [id, p] : found_in_front(head, positions))
        out.at(id).at = positions.at(id) = p;
    for (const auto& [id, p] : tragions(head, positions.at("t_l"), positions.at("t_r")))
        out.at(id).at = positions.at(id) = p;
    if (positions.count("sl") && positions.count("hyo"))
        if (const auto found = menton_by_profile(head, {positions.at("sl"), positions.at("pg"),
                                                        positions.at("me"), positions.at("hyo")}))
            out.at("me").at = positions.at("me") = *found;
    const rig::HeadFrame frame = rig::find_head_frame(positions, atlas, 1.0);
    find_by_definition(head, frame, out);
    doubt_edges(head, atlas, out);
    for (auto& [id, p] : positions) p = frame.to_head(out.at(id).at);
    for (const rig::LandmarkPrediction& doubt :
         rig::doubtful_landmarks(positions, atlas, frame.size)) {
        if (doubt.id == "v" || doubt.id == "op") continue;  // their definition decides
        JudgedLandmark& to = out.at(doubt.id);
        to.expected_m = std::max(to.expected_m, kOfContradiction * doubt.off_m);
        to.reason = "the other landmarks put it " + whole_mm(doubt.off_m) + " away";
    }
    return out;
}

}  // namespace risorius::landmarks
