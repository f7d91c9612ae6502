// SPDX-License-Identifier: MIT
#include "risorius/scene/unit_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/face/anatomy/lid_measures.h"
#include "risorius/face/diagnostics.h"
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

UnitReader::UnitReader(face::Face& face, const rig::RigDescription& rig, double tolerance_m)
    : face_(face),
      rig_(rig),
      tolerance_m_(tolerance_m),
      points_(face.head(), rig),
      skin_(face, rig),
      channels_(rig.channels()) {
    rest_.excitation = Eigen::VectorXd::Zero(channels_.column_count());
    neutral_ = pose(track::Expansion::none(channels_)).pose;
    volume_m3_ = face_.diagnostics().tissue_volume_m3();
}

FaceMeasures FaceMeasures::operator-(const FaceMeasures& other) const {
    return {lid_aperture - other.lid_aperture,
            mouth_width - other.mouth_width,
            lip_gap - other.lip_gap,
            corner_height - other.corner_height,
            nasolabial_furrow - other.nasolabial_furrow,
            glabellar_furrow - other.glabellar_furrow,
            forehead_furrow - other.forehead_furrow,
            lip_contact_mm2 - other.lip_contact_mm2};
}

FaceMeasures UnitReader::measures(const face::FacePose& pose) const {
    const Points& vertices = pose.vertices;
    const auto y = [&](const char* id) { return points_.at(id, vertices).y(); };
    const auto rest_y = [&](const char* id) { return points_.at(id, neutral()).y(); };
    return {1e3 * points_.distance("ps_l", "pi_l", vertices),
            1e3 * points_.distance("ch_l", "ch_r", vertices),
            1e3 * (y("stos") - y("stoi")),
            500 * (y("ch_l") - rest_y("ch_l") + y("ch_r") - rest_y("ch_r")),
            skin_.furrow_mm(Furrow::kNasolabial, pose),
            skin_.furrow_mm(Furrow::kGlabellar, pose),
            skin_.furrow_mm(Furrow::kForehead, pose),
            skin_.lip_contact_mm2(pose)};
}

UnitReading UnitReader::read(const track::ActionUnit& unit, bool steps) {
    UnitReading out{unit.id, unit.name, targets(unit), 0, {}, {}, 0, true, {}, {}};
    const track::Expansion whole = track::expand(unit, std::nullopt, channels_);
    const face::FacePose& from = base(unit);
    track::Expansion all = others(unit);
    all.add(whole, 1.0);
    const Pose full = pose(all);
    out.in_equilibrium = full.in_equilibrium;
    out.faults = full.faults;
    out.pose = full.pose;
    for (LandmarkReading& one : out.landmarks) {
        one.moved_mm = moved_mm(side_of(one.landmark), from.vertices, full.pose.vertices);
        one.gain = one.moved_mm.dot(one.target_mm) / one.target_mm.squaredNorm();
    }
    out.gain = along(out.landmarks);
    out.change = measures(full.pose) - measures(from);
    out.uneven_mm = uneven_mm(out, from.vertices);
    if (!steps) return out;
    for (const double intensity : kIntensities) {
        track::Expansion part = track::Expansion::none(channels_);
        part.add(whole, unit.curve, intensity);
        out.response.push_back(out.gain == 0 ? 0 : gain(unit, part) / out.gain);
    }
    return out;
}

double UnitReader::gain(const track::ActionUnit& unit, const track::Expansion& sum) {
    const face::FacePose& from = base(unit);
    track::Expansion all = others(unit);
    all.add(sum, 1.0);
    const Pose posed = pose(all);
    std::vector<LandmarkReading> landmarks = targets(unit);
    for (LandmarkReading& one : landmarks)
        one.moved_mm = moved_mm(side_of(one.landmark), from.vertices, posed.pose.vertices);
    return along(landmarks);
}

track::Expansion UnitReader::others(const track::ActionUnit& unit) const {
    track::Expansion sum = track::Expansion::none(channels_);
    for (const track::UnitUse& use : unit.seen_with) {
        const track::ActionUnit& other = *rig_.facs.find(use.unit);
        sum.add(track::expand(other, use.side, channels_), other.curve, use.value);
    }
    return sum;
}

const face::FacePose& UnitReader::base(const track::ActionUnit& unit) {
    if (unit.seen_with.empty()) return neutral_;
    const auto found = base_.find(unit.id);
    if (found != base_.end()) return found->second;
    return base_[unit.id] = pose(others(unit)).pose;
}

double UnitReader::uneven_mm(const UnitReading& reading, const Points& from) const {
    double most = 0;
    for (const LandmarkReading& one : reading.landmarks) {
        const std::string left = side_of(one.landmark);
        if (left == one.landmark) {
            most = std::max(most, std::abs(one.moved_mm.x()));
            continue;
        }
        Vec3 right = moved_mm(one.landmark + "_r", from, reading.pose.vertices);
        right.x() = -right.x();
        most = std::max(most, (right - one.moved_mm).norm());
    }
    return most;
}

UnitReader::Pose UnitReader::pose(const track::Expansion& sum) {
    const track::Drive drive = rig::clamped_drive(sum, channels_);
    face_.start([&](double) { return rest_; });
    const face::StepStats found = face_.solve_equilibrium(drive.excitation, drive,
                                                          {.iterations = face::kRestIterations,
                                                           .tolerance_m = tolerance_m_,
                                                           .planes_m = tolerance_m_});
    const face::FacePose shown = face_.pose();
    const face::Diagnostics tissue = face_.diagnostics();
    return {
        shown,
        found.converged,
        {tissue.inverted_tets(), volume_m3_ > 0 ? tissue.tissue_volume_m3() / volume_m3_ - 1 : 0,
         1e3 * found.lip_depth_m,
         1e3 * face::depth_in_eyes_m(face_.head(), shown.eye_rotation, shown.vertices),
         1e3 * found.bone_depth_m}};
}

std::vector<LandmarkReading> UnitReader::targets(const track::ActionUnit& unit) const {
    std::vector<LandmarkReading> out;
    for (const auto& [landmark, target_mm] : unit.landmark_targets_mm)
        out.push_back({landmark, scale(landmark) * target_mm, Vec3::Zero(), 0});
    return out;
}

Vec3 UnitReader::moved_mm(const std::string& landmark, const Points& from, const Points& to) const {
    return 1e3 * (points_.at(landmark, to) - points_.at(landmark, from));
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
