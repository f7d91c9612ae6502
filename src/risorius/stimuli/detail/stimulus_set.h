// SPDX-License-Identifier: MIT
/// \file
/// The files of a whole set, in the layout of BIDS (bids-specification.readthedocs.io; stimuli as in BEP044):
///
///   dataset_description.json, README, .bidsignore
///   stimuli/stimuli.tsv, stimuli.json    a row for each clip: set, control, values of the design, frames, onset and apex
///   stimuli/annotations.tsv              what the tables beside the clips are
///   triggers.tsv                         event, code, clip, frame, time_s, merged_into: for the device that sends triggers
///   code/design.json                     the design
///   index.html                           five frames of every clip, with its values
///   SHA256SUMS                           checksums of all files of the set, for sha256sum -c
#pragma once

#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// Writes the files. All clips must exist. Removes files of clips that only an earlier design had, see own_files.h. All of this
/// happens together, or not at all. A file that somebody has changed stays, and the new one is put beside it as NAME.new, unless the
/// options say to replace it. Returns the names of such files.
std::vector<std::string> write_set(const BatchPlan& plan, const BatchOptions& options,
                                   const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
