// SPDX-License-Identifier: MIT
/// \file
/// A batch on a cluster. A Slurm job array makes the clips in parts, on nodes that share only the file system. This process
/// submits the job, follows it, resubmits failed parts and completes the set.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// Options of the Slurm job.
struct SlurmOptions {
    /// Returns the words of the command that makes one part of the set on a node. Arguments: the design, the folder of the set,
    /// the number of clips made at the same time, and the part as "N/COUNT". N is the number of the task; the batch script
    /// replaces it. The command writes one JSON object per clip to standard output: {"event": "failed", "stim_id": ..., "why":
    /// ...}.
    std::function<std::vector<std::string>(const std::filesystem::path& design,
                                           const std::filesystem::path& out, int workers,
                                           const std::string& part)>
        part_command;
    int tasks = 8;    ///< tasks of the job array; at most one per clip
    int workers = 1;  ///< number of clips made at the same time by a task, and CPUs of a task
    int retries = 1;  ///< how often tasks with missing clips are resubmitted
    std::string account, partition, time;  ///< options of sbatch; empty: not given
};

/// Makes a batch by a job array. Its script is DIR/code/slurm.sh; the logs of its tasks are DIR/code/slurm-ROUND-TASK.log. Throws Error
/// for a wrong design and where Slurm's programs are missing, RunError when Slurm rejects the job, and Interrupted when the monitor asks to
/// stop, after cancelling the job. When no job was accepted, nothing is left.
BatchReport make_batch_on_slurm(const BatchOptions& batch, const SlurmOptions& slurm,
                                const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
