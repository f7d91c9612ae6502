// SPDX-License-Identifier: MIT
/// \file
/// Makes the faces of a study, puts each into its poses, and writes what was found.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/study/sampled_rigs.h"
#include "risorius/study/study_description.h"
#include "risorius/study/study_results.h"

namespace risorius::study {

struct StudyOptions {
    std::filesystem::path study;
    std::filesystem::path out;  ///< a folder
    int threads = 0;            ///< 0: as many as the machine has; results do not depend on it
};

/// Reads a study and checks that its rig may have all values of the sample. Throws Error.
StudyDescription check_study(const std::filesystem::path& file);

/// Makes the faces of a study, puts each into its poses, and computes spread and indices. Every pose is an equilibrium that is searched from
/// rest. Displacements are from the head at rest, in mm of this head. Results do not depend on `threads`; 0: as many as the machine has. Throws
/// Error, and Interrupted when the monitor asks to stop.
StudyResults simulate_study(const StudyDescription& study, const SampledRigs& rigs, int threads,
                            const ProgressMonitor& monitor = {});

/// Runs a study, writes the folder, and returns its results.json:
///
///   index.html                 parameters, charts and tables
///   samples.tsv, .json         a row for each face: the values of its parameters
///   displacements.tsv, .json   a row for each face, pose and landmark
///   spread.tsv, .json          a row for each pose and landmark
///   indices.tsv, .json         a row for each pose, landmark and parameter; not without indices
///   results.json               spread and indices
///   indices_POSE.*, spread_POSE.*    charts
///
/// Throws as simulate_study() does.
Json run_study(const StudyOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::study
