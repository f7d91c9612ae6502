// A batch on a cluster: a Slurm job array makes the clips in parts, on nodes that share nothing but the file system; here it is
// submitted, followed, tried again where parts failed, and gathered.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

struct SlurmOptions {
    std::filesystem::path program;         ///< this one, as the nodes find it
    int tasks = 8;                         ///< of the array, no more than there are clips
    int workers = 1;                       ///< clips made at once in one, and its CPUs
    int retries = 1;                       ///< of tasks whose clips are not all there
    std::string account, partition, time;  ///< handed to sbatch; empty: not
};

/// The batch script, in DIR/code/slurm.sh; logs of the tasks are DIR/code/slurm-ROUND-TASK.log.
std::string slurm_script(const BatchOptions& batch, const SlurmOptions& slurm, int tasks);

/// Throws Error for a wrong design, RunError when there is no Slurm or it takes no job, Interrupted when asked to stop (the job is
/// cancelled then).
BatchReport make_batch_on_slurm(const BatchOptions& batch, const SlurmOptions& slurm,
                                const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
