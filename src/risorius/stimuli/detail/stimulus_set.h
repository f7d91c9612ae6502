// What is told of all clips of a set together, in the layout of BIDS (bids-specification.readthedocs.io; stimuli as BEP044 has
// them):
//
//   dataset_description.json
//   stimuli/stimuli.tsv, stimuli.json    a row per clip: set, control, values of the design, frames, when it moves
//   triggers.tsv                         event, code, clip, frame, time_s: for the machine that sends triggers
//   code/design.json                     the design
//   index.html                           five frames of every clip, with its values
//   SHA256SUMS                           of every file above and below, for sha256sum -c
#pragma once

#include <filesystem>

#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// All clips must be made. What `batch` wrote into the folder of clips that the design has no more is taken away.
void write_set(const BatchPlan& plan, const std::filesystem::path& design,
               const std::filesystem::path& folder);

}  // namespace risorius::stimuli
