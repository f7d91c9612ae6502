// SPDX-License-Identifier: MIT
/// \file
/// Makes a muscle rig from any face mesh with landmarks.
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

namespace risorius::fitting {

struct FitOptions {
    std::filesystem::path mesh, landmarks, out;
    std::filesystem::path
        standard{};  ///< folder of the standard tables; empty: those of this build
    std::optional<double> metres_per_unit{};  ///< none: estimated from the landmarks
    std::string name{};                       ///< empty: that of the mesh file
    std::map<std::string, std::vector<std::string>>
        parts{};  ///< role -> groups; other roles are guessed from the names of groups
    bool inline_tables = true;  ///< false: refer to the standard tables by path
    bool calibrate = true;
    bool together =
        true;  ///< after each muscle alone, all muscles are calibrated together: fit_strengths.h
    bool cut_lips =
        false;  ///< cuts lips of a scan that have grown together; the cut mesh is written next to the rig
    std::filesystem::path report{};  ///< folder for a page with pictures; empty: none
    bool solids =
        false;  ///< uses the volume muscles of the standard table, not only bundles of fibres
};

struct FitReport {
    std::filesystem::path out;
    double metres_per_unit = 1;
    bool guessed_unit = false;
    double size = 1;         ///< of the head / average adult
    double residual_mm = 0;  ///< RMS distance of the landmarks from the atlas
    std::map<std::string, std::vector<std::string>> parts;
    int given_landmarks = 0;
    std::vector<std::string> warped_landmarks;  ///< placed by warping the atlas
    std::vector<std::string>
        worth_giving;  ///< those of them that most muscles depend on, most important first
    int nodes = 0, tets = 0, dropped_tets = 0, inverted_tets = 0, fibres = 0;
    BoneFigures bone;
    bool eyes = false, teeth = false, lips_cut = false;
    std::vector<MuscleStrength> strengths;
    /// Mean difference of the standard expressions from those of the standard head, before and after the joint calibration: fit_strengths.h
    double difference_before = 0, difference = 0;
    std::vector<std::string> notes;

    Json json() const;
};

/// Throws Error when mesh or landmarks are not those of a head; then no file is written.
FitReport fit_rig(const FitOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::fitting
