// From any face mesh with landmarks to a muscle rig.
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
    std::optional<double> metres_per_unit{};  ///< none: told from the landmarks
    std::string name{};                       ///< empty: that of the mesh file
    std::map<std::string, std::vector<std::string>>
        parts{};                ///< role -> groups; the rest is guessed from their names
    bool inline_tables = true;  ///< false: refer to the standard tables by path
    bool calibrate = true;
    bool together = true;  ///< after each muscle by itself, all together: fit_strengths.h
    bool cut_lips =
        false;  ///< those of a scan that are grown together; the cut mesh is written beside the rig
    std::filesystem::path report{};  ///< folder for a page with pictures; empty: none
    bool solids = false;  ///< the volume muscles of the standard table, rather than bundles alone
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
    std::vector<std::string> worth_giving;  ///< of those, the ones most muscles hang on, best first
    int nodes = 0, tets = 0, dropped_tets = 0, inverted_tets = 0, fibres = 0;
    BoneFigures bone;
    bool eyes = false, teeth = false, lips_cut = false;
    std::vector<MuscleStrength> strengths;
    /// Of the standard expressions from those of the standard head, before and after the muscles were scaled together: fit_strengths.h
    double difference_before = 0, difference = 0;
    std::vector<std::string> notes;

    Json json() const;
};

/// Throws Error when the mesh or the landmarks are not those of a head; then nothing is written.
FitReport fit_rig(const FitOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::fitting
