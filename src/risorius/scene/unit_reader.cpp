// SPDX-License-Identifier: MIT
#include "risorius/scene/unit_reader.h"

#include <algorithm>

#include "risorius/rig/expression_drive.h"

namespace risorius::scene {

namespace {

constexpr std::array<double, 3> kIntensities{0.25, 0.5, 0.75};

// Sum over the landmarks of moved . target / sum of target . target.
double along(const std::vector<LandmarkReading>& landmarks) {
    double product = 0, squares = 0;
    for (const LandmarkReading& one : landmarks) {
        product += one.moved_mm.dot(one.target_mm);
        squares += one.target_mm.squaredNorm();
    }
    return squares > 0 ? product / squares : 0;
}

}  // namespace

UnitReader::UnitReader(face::Face& face, const rig::RigDescription& rig)
    : face_(face), rig_(rig), points_(face.head(), rig), channels_(rig.channels()) {
    rest_.excitation = Eigen::VectorXd::Zero(channels_.column_count());
    neutral_ = pose(track::Expansion::none(channels_)).pose;
}

FaceLengths UnitReader::lengths(const Points& vertices) const {
    const auto y = [&](const char* id) { return points_.at(id, vertices).y(); };
    const auto rest_y = [&](const char* id) { return points_.at(id, neutral()).y(); };
    return {1e3 * points_.distance("ps_l", "pi_l", vertices),
            1e3 * points_.distance("ch_l", "ch_r", vertices), 1e3 * (y("stos") - y("stoi")),
            500 * (y("ch_l") - rest_y("ch_l") + y("ch_r") - rest_y("ch_r"))};
}

UnitReading UnitReader::read(const track::ActionUnit& unit) {
    UnitReading out{unit.id, unit.name, targets(unit), 0, {}, {}, true, {}};
    const track::Expansion whole = track::expand(unit, std::nullopt, channels_);
    const Pose full = pose(whole);
    out.in_equilibrium = full.in_equilibrium;
    out.pose = full.pose;
    for (LandmarkReading& one : out.landmarks) {
        one.moved_mm = moved_mm(one.landmark, full.pose.vertices);
        one.gain = one.moved_mm.dot(one.target_mm) / one.target_mm.squaredNorm();
    }
    out.gain = along(out.landmarks);
    const FaceLengths now = lengths(full.pose.vertices), rest = lengths(neutral());
    out.change = {now.lid_aperture - rest.lid_aperture, now.mouth_width - rest.mouth_width,
                  now.lip_gap - rest.lip_gap, now.corner_height - rest.corner_height};
    for (std::size_t i = 0; i < kIntensities.size(); ++i) {
        track::Expansion part = track::Expansion::none(channels_);
        part.add(whole, unit.curve, kIntensities[i]);
        out.response[i] = out.gain == 0 ? 0 : gain(unit, part) / out.gain;
    }
    return out;
}

double UnitReader::gain(const track::ActionUnit& unit, const track::Expansion& sum) {
    const Pose posed = pose(sum);
    std::vector<LandmarkReading> landmarks = targets(unit);
    for (LandmarkReading& one : landmarks)
        one.moved_mm = moved_mm(one.landmark, posed.pose.vertices);
    return along(landmarks);
}

UnitReader::Pose UnitReader::pose(const track::Expansion& sum) {
    const track::Drive drive = rig::clamped_drive(sum, channels_);
    face_.start([&](double) { return rest_; });
    const bool converged =
        face_.solve_equilibrium(drive.excitation, drive, {.iterations = face::kRestIterations})
            .converged;
    return {face_.pose(), converged};
}

std::vector<LandmarkReading> UnitReader::targets(const track::ActionUnit& unit) const {
    std::vector<LandmarkReading> out;
    for (const auto& [landmark, target_mm] : unit.landmark_targets_mm)
        out.push_back({landmark, scale(landmark) * target_mm, Vec3::Zero(), 0});
    return out;
}

Vec3 UnitReader::moved_mm(const std::string& landmark, const Points& vertices) const {
    const std::string id = side_of(landmark);
    return 1e3 * (points_.at(id, vertices) - points_.at(id, neutral()));
}

// The name of a landmark of the table with its side, the left one.
std::string UnitReader::side_of(const std::string& landmark) const {
    const auto& known = rig_.atlas.landmarks;
    const bool middle = std::any_of(known.begin(), known.end(), [&](const rig::AtlasLandmark& one) {
        return one.id == landmark;
    });
    return middle ? landmark : landmark + "_l";
}

const rig::AtlasLandmark& UnitReader::atlas(const std::string& id) const {
    return *std::find_if(rig_.atlas.landmarks.begin(), rig_.atlas.landmarks.end(),
                         [&](const rig::AtlasLandmark& one) { return one.id == id; });
}

double UnitReader::ratio(const char* a, const char* b) const {
    return points_.distance(a, b, face_.head().vertices) /
           (atlas(a).position - atlas(b).position).norm();
}

double UnitReader::scale(const std::string& landmark) const {
    const std::string& region = atlas(side_of(landmark)).region;
    if (region == "eye" || region == "brow") return ratio("en_l", "ex_l");
    if (region == "lip") return ratio("ch_l", "ch_r");
    return ratio("n", "me");
}

}  // namespace risorius::scene
