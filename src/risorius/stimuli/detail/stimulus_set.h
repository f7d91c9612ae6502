// SPDX-License-Identifier: MIT
/// \file
/// The files of a whole set, in the layout of BIDS (bids-specification.readthedocs.io; stimuli as in BEP044):
///
///   dataset_description.json
///   stimuli/stimuli.tsv, stimuli.json    a row for each clip: set, control, values of the design, frames, onset and apex
///   triggers.tsv                         event, code, clip, frame, time_s: for the device that sends triggers
///   code/design.json                     the design
///   index.html                           five frames of every clip, with its values
///   SHA256SUMS                           checksums of all files of the set, for sha256sum -c
#pragma once

#include <filesystem>

#include "risorius/core/progress_monitor.h"
#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// Writes the files. All clips must exist. Removes files of clips that only an earlier design had, see own_files.h. All of this
/// happens together, or not at all.
void write_set(const BatchPlan& plan, const std::filesystem::path& design,
               const std::filesystem::path& folder, const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
