// SPDX-License-Identifier: MIT
#include "risorius/face/muscle_lines.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/face/anatomy/detail/jaw_dynamics.h"
#include "risorius/face/anatomy/detail/jaw_muscles.h"
#include "risorius/face/detail/face_impl.h"

namespace risorius::face {

namespace {

using LineBody = rig::PathPoint::Body;

const rig::Muscle& muscle_in(const FaceImpl& face, const std::string& id) {
    const std::vector<rig::Muscle>& list = face.rig.muscles.muscles;
    return *std::find_if(list.begin(), list.end(),
                         [&](const rig::Muscle& one) { return one.id == id; });
}

MuscleLine line_for(const FaceImpl& face, const std::string& id, int column) {
    const rig::Muscle& muscle = muscle_in(face, id);
    MuscleLine out;
    out.muscle = id;
    out.column = column;
    if (muscle.paired)
        out.side = column == face.channels.column(id, Side::kLeft) ? Side::kLeft : Side::kRight;
    out.max_speed_hz = muscle.max_speed_hz;
    out.activation_s = muscle.activation_s;
    out.deactivation_s = muscle.deactivation_s;
    return out;
}

/// The point at a fraction of the length of a polyline.
Vec3 point_along(const std::vector<Vec3>& path, double fraction) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
    double left = fraction * length;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double here = (path[i + 1] - path[i]).norm();
        if (left <= here || i + 2 == path.size())
            return path[i] + std::min(1.0, left / here) * (path[i + 1] - path[i]);
        left -= here;
    }
    return path.front();
}

LineBody body_of(const muscle::FibrePoint& point) {
    if (point.count > 0) return LineBody::kSoft;
    return point.body == kMandibleBody ? LineBody::kMandible : LineBody::kSkull;
}

double length_of(const std::vector<MuscleLine::Point>& path) {
    double out = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
        out += (path[i + 1].rest - path[i].rest).norm();
    return out;
}

void add_bundles(const FaceImpl& face, std::vector<MuscleLine>& out) {
    const MusclePlacement& placed = face.tissue.muscles();
    const std::vector<muscle::Fibre>& fibres = face.tissue.fibres().fibres();
    for (const FibreBundle& bundle : placed.bundles) {
        if (bundle.fibre_count == 0) continue;
        MuscleLine line = line_for(face, bundle.muscle, bundle.column);
        const auto first = static_cast<std::size_t>(bundle.first_fibre),
                   end = first + static_cast<std::size_t>(bundle.fibre_count);
        // As many points as the middle fibre has, each the mean over all fibres at its fraction of their lengths
        const muscle::Fibre& middle = fibres[(first + end) / 2];
        const int points = middle.point_count;
        for (int p = 0; p < points; ++p) {
            Vec3 sum = Vec3::Zero();
            for (std::size_t f = first; f < end; ++f)
                sum += point_along(placed.paths[f], static_cast<double>(p) / (points - 1));
            const auto at = static_cast<std::size_t>(middle.first_point + p);
            line.path.push_back({sum / bundle.fibre_count, body_of(placed.points[at])});
        }
        double optimal = 0, slack = 0;
        for (std::size_t f = first; f < end; ++f) {
            line.f0_n += fibres[f].f0_n;
            double length = 0;
            for (std::size_t i = 0; i + 1 < placed.paths[f].size(); ++i)
                length += (placed.paths[f][i + 1] - placed.paths[f][i]).norm();
            const double sine = std::sin(fibres[f].pennation_rad), r = fibres[f].rest_stretch;
            slack += fibres[f].tendon_fraction * length;
            optimal += (1 - fibres[f].tendon_fraction) * length / std::sqrt(r * r - sine * sine);
        }
        line.optimal_m = optimal / bundle.fibre_count;
        line.slack_m = slack / bundle.fibre_count;
        line.pennation_rad = middle.pennation_rad;
        line.max_speed_hz = middle.max_speed_hz;
        out.push_back(std::move(line));
    }
}

void add_solids(const FaceImpl& face, std::vector<MuscleLine>& out) {
    for (const MuscleSolids::Line& of : face.tissue.solids().lines()) {
        MuscleLine line = line_for(face, of.muscle, of.column);
        line.model = rig::MuscleModel::kSolid;
        for (std::size_t i = 0; i < of.path.size(); ++i)
            line.path.push_back({of.path[i], of.body[i]});
        line.f0_n = of.f0_n;
        line.slack_m = of.chain.tendon_fraction * length_of(line.path);
        line.pennation_rad = of.chain.pennation_rad;
        // The fibre part of the path at rest is the fibre along the line of action
        const double sine = std::sin(of.chain.pennation_rad);
        line.optimal_m = (length_of(line.path) - line.slack_m) /
                         std::sqrt(of.chain.rest_stretch * of.chain.rest_stretch - sine * sine);
        out.push_back(std::move(line));
    }
}

void add_jaw(const FaceImpl& face, std::vector<MuscleLine>& out) {
    std::set<std::string> solids;
    for (const MuscleLine& line : out)
        if (line.model == rig::MuscleModel::kSolid) solids.insert(line.muscle);
    const JawMuscles muscles(face.head, face.rig, solids);
    for (const JawMuscle& one : muscles.list()) {
        if (one.tone_only) continue;
        MuscleLine line = line_for(face, one.id, one.column);
        line.side = one.side;
        line.model = rig::MuscleModel::kLine;
        for (const JawMuscle::Point& point : one.path)
            line.path.push_back({point.rest, point.body});
        line.f0_n = one.f0_n;
        line.optimal_m = one.optimal_m;
        line.slack_m = one.slack_m;
        line.pennation_rad = std::asin(one.thickness_m / one.optimal_m);
        line.max_speed_hz = one.max_speed_m_s / one.optimal_m;
        out.push_back(std::move(line));
    }
}

}  // namespace

JawHinge jaw_hinge_of(const FaceImpl& face) {
    const JawDynamics dynamics(face.head, face.rig);
    return {.centre = dynamics.joint().hinge(),
            .open_rad = dynamics.joint().place(face.jaw.motion(1, 0, 0)).open_rad,
            .mandible_kg = dynamics.mass_kg()};
}

std::vector<MuscleLine> lines_of(const FaceImpl& face) {
    std::vector<MuscleLine> out;
    add_bundles(face, out);
    add_solids(face, out);
    add_jaw(face, out);
    std::stable_sort(out.begin(), out.end(),
                     [](const MuscleLine& a, const MuscleLine& b) { return a.column < b.column; });
    for (std::size_t i = 1; i < out.size(); ++i)
        if (out[i].column == out[i - 1].column && out[i].side == out[i - 1].side)
            out[i].part = out[i - 1].part + 1;
    return out;
}

}  // namespace risorius::face
