// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/fit_landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/geom/closest_point.h"

namespace risorius::fitting {

namespace fs = std::filesystem;

namespace {

constexpr double kFarthestFromSkin_mm = 15, kOffSkin_mm = 5;
constexpr double kMinFissure_mm = 3;  // minimum distance between the lids of an open eye
constexpr double kSamePlace_mm = 0.2, kApart_mm = 5;
// A required landmark is rejected when both are exceeded; on heads of two sigma, the ratio reaches 2.5.
constexpr double kRefusedRatio = 4.5, kRefused_mm = 12;
constexpr double kMovingFrom_m = 8e-3;  // z; nothing behind it moves

// "(1.2, -3.45, 8.7)", rounded to a thousandth of the largest coordinate, the precision of landmarks.
std::string point_text(const Vec3& p) {
    const double scale = std::max(1e-9, p.cwiseAbs().maxCoeff());
    const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(scale))));
    char text[96];
    std::snprintf(text, sizeof text, "(%.*f, %.*f, %.*f)", decimals, p.x(), decimals, p.y(),
                  decimals, p.z());
    return text;
}

std::string millimetres(double value_m, double size) {
    return format_number(std::round(1e3 * value_m / size)) + " mm";
}

}  // namespace

std::string quoted_list(const std::vector<std::string>& ids) {
    std::string out;
    for (const std::string& id : ids) out += (out.empty() ? "\"" : " \"") + id + "\"";
    return out;
}

std::vector<std::string> take_file_coordinates(std::map<std::string, rig::Landmark>& landmarks,
                                               const geom::PolygonMesh& mesh,
                                               const fs::path& mesh_file, const fs::path& file) {
    if (!mesh.in_file_order)
        for (const auto& [id, landmark] : landmarks)
            if (landmark.vertex >= 0)
                throw Error(file.string() + ":/landmarks/" + id,
                            "\"xyz\", because vertices of a " + mesh_file.extension().string() +
                                " file are not read in the order of the file",
                            "vertex " + std::to_string(landmark.vertex));
    if (mesh.from_file.isIdentity(0)) return {};
    // Points may also be those of the mesh in metres.
    const Vec3 low = mesh.positions.colwise().minCoeff().transpose(),
               high = mesh.positions.colwise().maxCoeff().transpose(), margin = 0.1 * (high - low);
    const auto converted = [&](const Vec3& p) -> Vec3 {
        return (mesh.from_file * p.homogeneous()).head<3>();
    };
    int inside = 0;
    for (const auto& [id, landmark] : landmarks) {
        if (landmark.vertex >= 0) continue;
        const auto is_inside = [&](const Vec3& p) {
            return ((p - low + margin).array() >= 0).all() &&
                   ((high + margin - p).array() >= 0).all();
        };
        inside += static_cast<int>(is_inside(converted(landmark.xyz))) -
                  static_cast<int>(is_inside(landmark.xyz));
    }
    if (inside < 0)
        return {"landmarks are taken in metres and with y up, not in the unit and axes that " +
                mesh_file.filename().string() + " states"};
    for (auto& [id, landmark] : landmarks)
        if (landmark.vertex < 0) landmark.xyz = converted(landmark.xyz);
    return {};
}

LandmarkPositions landmark_positions(const rig::RigDescription& rig, const geom::PolygonMesh& mesh,
                                     const fs::path& file) {
    const std::string place = file.string() + ":/landmarks";
    LandmarkPositions out;
    for (const auto& [id, landmark] : rig.landmarks) {
        if (landmark.vertex >= mesh.vertex_count())
            throw Error(
                place + "/" + id + "/vertex",
                "a vertex of the mesh, in [0, " + std::to_string(mesh.vertex_count() - 1) + "]",
                std::to_string(landmark.vertex));
        out[id] = landmark.vertex >= 0 ? Vec3(mesh.positions.row(landmark.vertex).transpose())
                                       : landmark.xyz;
    }
    std::vector<std::string> missing;
    for (const std::string& id : rig::required_landmarks())
        if (!out.count(id)) missing.push_back(id);
    if (!missing.empty())
        throw Error(place,
                    "the " + std::to_string(rig::required_landmarks().size()) +
                        " landmarks without which no head can be placed",
                    "none for " + quoted_list(missing));
    return out;
}

double unit_from_landmarks(const LandmarkPositions& landmarks, const rig::Atlas& atlas) {
    const double size = rig::find_head_frame(landmarks, atlas, 1.0).size;
    double best = 1;
    for (double unit : {1.0, 0.1, 0.01, 0.001, 0.0254, 0.3048})
        if (std::abs(std::log(size * unit)) < std::abs(std::log(size * best))) best = unit;
    return best;
}

void check_sides(const LandmarkPositions& landmarks, const rig::Atlas& atlas,
                 const fs::path& file) {
    const std::string place = file.string() + ":/landmarks";
    const Vec3& first = landmarks.begin()->second;
    double widest = 0;
    for (const auto& [id, p] : landmarks) widest = std::max(widest, (p - first).norm());
    if (!(widest > 0)) throw Error(place, "landmarks in different places", "all in one");

    // All pairs are exchanged, or some of them.
    LandmarkPositions exchanged;
    for (const auto& [id, p] : landmarks) exchanged[rig::mirrored_landmark(id)] = p;
    const auto misfit = [&](const LandmarkPositions& marks) {
        const rig::HeadFrame frame = rig::find_head_frame(marks, atlas, 1.0);
        return frame.residual_m / frame.size;
    };
    if (misfit(exchanged) < 0.5 * misfit(landmarks))
        throw Error(place, "_l on the subject's left and _r on the right",
                    "them the other way round");
    const std::vector<std::string> pairs = rig::exchanged_pairs(landmarks, atlas);
    if (pairs.size() == 1)
        throw Error(place + "/" + pairs[0],
                    "a point on the subject's left of \"" + rig::mirrored_landmark(pairs[0]) + "\"",
                    "one on its right (are the two exchanged?)");
    if (!pairs.empty())
        throw Error(place, "_l on the subject's left and _r on the right",
                    "the other way round: " + quoted_list(pairs));

    // Two landmarks coincide, or the lids touch.
    const double size = rig::find_head_frame(landmarks, atlas, 1.0).size;  // in mesh units
    for (auto a = landmarks.begin(); a != landmarks.end(); ++a)
        for (auto b = std::next(a); b != landmarks.end(); ++b) {
            const auto *here = atlas.landmark(a->first), *there = atlas.landmark(b->first);
            if (!here || !there) continue;
            const double apart_mm = 1e3 * (here->position - there->position).norm();
            const double found_mm = 1e3 * (a->second - b->second).norm() / size;
            if (found_mm < kSamePlace_mm && apart_mm > kApart_mm)
                throw Error(place + "/" + b->first,
                            "a point some " + format_number(std::round(apart_mm)) + " mm from \"" +
                                a->first + "\"",
                            "the same point");
        }
    for (const char* side : {"_l", "_r"}) {
        const std::string upper = std::string("ps") + side, lower = std::string("pi") + side;
        const double open_mm = 1e3 * (landmarks.at(upper) - landmarks.at(lower)).norm() / size;
        if (open_mm < kMinFissure_mm)
            throw Error(place + "/" + upper,
                        "an open eye, \"" + lower + "\" at least " + format_number(kMinFissure_mm) +
                            " mm below",
                        format_number(std::round(10 * open_mm) / 10) +
                            " mm (a head with closed eyes has no lids to move)");
    }
}

std::vector<std::string> check_places(const rig::Head& head, const LandmarkPositions& landmarks,
                                      const rig::Atlas& atlas, const fs::path& file) {
    std::vector<std::string> notes;
    const std::string place = file.string() + ":/landmarks/";

    // Landmarks must lie on the skin.
    const geom::SurfaceTree skin(head.vertices, head.skin);
    LandmarkPositions in_head;
    for (const auto& [id, in_mesh] : landmarks) {
        in_head[id] = head.frame.to_head(in_mesh);
        const double away_m = std::sqrt(skin.closest(in_head[id])->squared_distance);
        const double away_mm = 1e3 * away_m / head.size;
        if (away_mm > kFarthestFromSkin_mm)
            throw Error(place + id, "a point on the skin",
                        "one " + millimetres(away_m, head.size) + " away from it");
        if (away_mm > kOffSkin_mm)
            notes.push_back("landmark \"" + id + "\" is " + millimetres(away_m, head.size) +
                            " off the skin");
    }

    // Landmarks must lie where the others predict them.
    const auto& required = rig::required_landmarks();
    for (const rig::LandmarkPrediction& doubt :
         rig::doubtful_landmarks(in_head, atlas, head.size)) {
        const bool needed = std::find(required.begin(), required.end(), doubt.id) != required.end();
        if (!needed && atlas.landmark(doubt.id)->position.z() < kMovingFrom_m) continue;
        const auto in_mesh = [&](const Vec3& p) {
            return point_text(head.frame.rotation.transpose() * (p - head.frame.translation) /
                              head.frame.metres_per_unit);
        };
        const std::string expected =
            "a point near " + in_mesh(doubt.expected) + ", where the other landmarks put it";
        // When a pair is asymmetric, the others cannot always tell which of the two is wrong.
        const std::string partner = rig::mirrored_landmark(doubt.id);
        const bool by_partner = partner != doubt.id && doubt.mirror_ratio > 0;
        const std::string found = in_mesh(doubt.found) + ", " +
                                  millimetres(doubt.off_m, head.size) + " away" +
                                  (by_partner ? " (or is it \"" + partner + "\"?)" : "");
        if (needed && doubt.ratio > kRefusedRatio && doubt.off_m > 1e-3 * kRefused_mm * head.size)
            throw Error(place + doubt.id, expected, found);
        notes.push_back("landmark \"" + doubt.id + "\": expected " + expected + ", found " + found);
    }
    return notes;
}

std::vector<std::string> worth_giving(const rig::Head& head, const rig::Atlas& atlas) {
    std::map<std::string, int> uses;
    for (const rig::MuscleBand& band : atlas.bands)
        for (const rig::BandPoint& point : band.points) {
            ++uses[point.landmark];
            const std::string other = rig::mirrored_landmark(point.landmark);
            if (other != point.landmark) ++uses[other];
        }
    std::vector<std::string> out;
    for (const std::string& id : head.warped_landmarks)
        if (uses.count(id)) out.push_back(id);
    std::stable_sort(out.begin(), out.end(), [&](const std::string& a, const std::string& b) {
        return uses.at(a) > uses.at(b);
    });
    return out;
}

}  // namespace risorius::fitting
