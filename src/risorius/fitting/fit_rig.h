// SPDX-License-Identifier: MIT
/// \file
/// Makes a rig with muscles from any mesh of a head with landmarks.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/fitting/detail/calibrate_strength.h"
#include "risorius/fitting/detail/fit_picture.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// Options of fit_rig().
struct FitOptions {
    std::filesystem::path mesh, landmarks, out;
    /// Folder of the standard tables; empty: those of this toolkit
    std::filesystem::path standard{};
    std::optional<double> metres_per_unit{};  ///< none: estimated from the landmarks
    std::string name{};                       ///< empty: the name of the mesh file
    /// A map from role to names of mesh groups; roles that are not given are guessed from the names of groups
    std::map<std::string, std::vector<std::string>> parts{};
    bool inline_tables = true;  ///< false: refer to the standard tables by path
    bool calibrate = true;
    /// True: after each muscle has been calibrated alone, all are calibrated together, see fit_strengths.h
    bool together = true;
    /// True: closed lips of a scan are separated (rig/cut_lips.h); the cut mesh is written next to the rig
    bool cut_lips = false;
    /// True: double, flipped and empty faces and loose bits of a scan are mended (geom/repair_mesh.h); the mended mesh is written
    /// next to the rig
    bool repair = false;
    std::string landmarks_note{};    ///< how the landmarks were found; the first of the notes
    std::filesystem::path report{};  ///< folder for a page with pictures; empty: none
    /// True: the muscles that the standard table lists as solids are simulated as solids, not as bundles of fibres
    bool solids = false;
    int threads = 0;  ///< 0: as many as the machine has; the rig is the same for any number
};

/// The result of fit_rig().
struct FitReport {
    std::filesystem::path out;
    double metres_per_unit = 1;
    bool guessed_unit = false;
    double size = 1;         ///< of the head over the average adult
    double residual_mm = 0;  ///< RMS distance of the landmarks from the atlas
    std::map<std::string, std::vector<std::string>> parts;
    int given_landmarks = 0;
    std::vector<std::string> warped_landmarks;  ///< landmarks that were placed by warping the atlas
    /// The warped landmarks on which most muscles depend, most important first
    std::vector<std::string> worth_giving;
    int nodes = 0, tets = 0, dropped_tets = 0, inverted_tets = 0, fibres = 0;
    BoneFigures bone;
    bool eyes = false, teeth = false, lips_cut = false;
    std::vector<MuscleStrength> strengths;
    /// Mean difference of the standard expressions from those of the standard head, before and after the joint calibration, see
    /// fit_strengths.h.
    double difference_before = 0, difference = 0;
    std::map<std::string, rig::UnitGain> unit_gains;  ///< see fit_units.h
    std::vector<std::string> notes;

    Json json() const;
};

/// Makes the rig and writes it. Throws Error when mesh or landmarks are not those of a head; then no file is written. Throws
/// Interrupted.
FitReport fit_rig(const FitOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::fitting
