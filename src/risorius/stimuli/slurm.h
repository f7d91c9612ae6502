// SPDX-License-Identifier: MIT
/// \file
/// A batch on a cluster. A Slurm job array makes the clips in parts, on nodes that share only the file system. This process
/// submits the job, follows it, resubmits failed parts and completes the set.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// Options of the Slurm job.
struct SlurmOptions {
    std::filesystem::path program;  ///< path of this program on the nodes
    int tasks = 8;                  ///< tasks of the job array; at most one per clip
    int workers = 1;  ///< number of clips made at the same time by a task, and CPUs of a task
    int retries = 1;  ///< how often tasks with missing clips are resubmitted
    std::string account, partition, time;  ///< options of sbatch; empty: not given
};

/// The batch script, DIR/code/slurm.sh. The logs of the tasks are DIR/code/slurm-ROUND-TASK.log.
std::string slurm_script(const BatchOptions& batch, const SlurmOptions& slurm, int tasks);

/// Makes a batch. Throws Error for a wrong design, RunError when Slurm is missing or rejects the job, and Interrupted when the
/// monitor asks to stop, after cancelling the job.
BatchReport make_batch_on_slurm(const BatchOptions& batch, const SlurmOptions& slurm,
                                const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
