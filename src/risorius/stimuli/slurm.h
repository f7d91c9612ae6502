// SPDX-License-Identifier: MIT
/// \file
/// A batch on a cluster. A Slurm job array makes the clips in parts, on nodes that share only the file system. This program submits it,
/// follows it, submits failed parts again and completes the set.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

struct SlurmOptions {
    std::filesystem::path program;  ///< path of this program on the nodes
    int tasks = 8;                  ///< of the array; at most one for each clip
    int workers = 1;                ///< clips made at once in a task, and CPUs of a task
    int retries = 1;                ///< how often tasks with missing clips are submitted again
    std::string account, partition, time;  ///< options of sbatch; empty: not given
};

/// The batch script, DIR/code/slurm.sh. The logs of the tasks are DIR/code/slurm-ROUND-TASK.log.
std::string slurm_script(const BatchOptions& batch, const SlurmOptions& slurm, int tasks);

/// Throws Error for a wrong design, RunError when Slurm is missing or refuses the job, and Interrupted when the monitor asks to stop
/// (the job is cancelled then).
BatchReport make_batch_on_slurm(const BatchOptions& batch, const SlurmOptions& slurm,
                                const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
