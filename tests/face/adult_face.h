// SPDX-License-Identifier: MIT
/// \file
/// The adult's simulated face, and drives to move it with.
#pragma once

#include <string>

#include "rig/heads.h"
#include "risorius/face/calibration.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/face/statics.h"
#include "risorius/face/surfaces.h"
#include "risorius/track/channels.h"
#include "risorius/track/facs.h"

namespace risorius::face {

inline Quality preview() { return quality_named("preview"); }

inline Face adult_face(const Quality& quality = preview()) {
    return Face(rig::adult().rig, rig::adult().mesh, quality, "adult");
}

inline track::ChannelTable channels() { return rig::adult().rig.channels(); }

inline track::Drive neutral() {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels().column_count());
    return drive;
}

/// Both sides of a muscle, or one.
inline track::Drive with_muscle(const std::string& muscle, double value,
                                std::optional<Side> side = std::nullopt,
                                track::Drive drive = neutral()) {
    for (const Side s : {Side::kLeft, Side::kRight})
        if (!side || *side == s) drive.excitation[channels().column(muscle, s)] = value;
    return drive;
}

inline track::Drive with_kinematic(track::Kinematic channel, double value,
                                   track::Drive drive = neutral()) {
    drive.kinematic[static_cast<std::size_t>(channel)] = value;
    return drive;
}

inline track::Drive with_unit(const std::string& unit, double value = 1.0) {
    const auto expanded =
        track::expand(*rig::adult().rig.facs.find(unit), std::nullopt, channels());
    track::Drive drive = neutral();
    drive.excitation = value * expanded.excitation;
    for (std::size_t k = 0; k < drive.kinematic.size(); ++k)
        drive.kinematic[k] = value * expanded.kinematic[k];
    return drive;
}

inline DriveAt always(const track::Drive& drive) {
    return [drive](double) { return drive; };
}

/// Near enough for what is measured in tenths of a millimetre: lips that are pressed together may circle by micrometres, for
/// as many iterations as they are given.
inline const StaticOptions kNearRest{
    .iterations = kRestIterations, .tolerance_m = 2e-5, .planes_m = 2e-5};

/// Near enough for what is measured in millimetres.
inline const StaticOptions kWithinATenth{
    .iterations = kRestIterations, .tolerance_m = 1e-4, .planes_m = 1e-4};

/// The pose in equilibrium with a drive, found from rest.
inline FacePose equilibrium_pose(Face& face, const track::Drive& drive,
                                 StepStats* figures = nullptr,
                                 const StaticOptions& options = {.iterations = kRestIterations}) {
    face.start(always(neutral()));
    const StepStats found = face.solve_equilibrium(drive.excitation, drive, options);
    if (figures) *figures = found;
    return face.pose();
}

/// Displacement of every vertex, mm.
inline Points moved_mm(const Face& face, const FacePose& pose) {
    return 1e3 * (pose.vertices - face.head().vertices);
}

/// A landmark of the adult in a table of vertices.
inline Vec3 at(const Points& table, const std::string& landmark) {
    return table.row(rig::adult().vertex(landmark)).transpose();
}

}  // namespace risorius::face
