// SPDX-License-Identifier: MIT
/// \file
/// Several equal faces that share the work of a fit: each task gets a face that no other task uses meanwhile.
///
/// A task has to start its face from rest (Face::start), and to leave the strengths of the muscles as it found them. Then its result
/// does not depend on which face it gets, and is the same for any number of threads.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "risorius/core/parallel.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"

namespace risorius::fitting {

/// More faces than this take more memory than they save time.
inline constexpr int kMaxTeam = 8;
/// Tolerance of the equilibria of a fit, m: a thousandth of the way of most landmarks.
inline constexpr double kFitTolerance_m = 5e-6;

/// Counts the tasks that have begun. Several threads may call begin().
class TaskProgress {
  public:
    TaskProgress(const ProgressMonitor& monitor, int tasks) : monitor_(monitor), tasks_(tasks) {}
    /// Reports a task. Throws Interrupted when the run should stop.
    void begin(const std::string& what) {
        const std::lock_guard lock(mutex_);
        monitor_.report(static_cast<double>(begun_++) / tasks_, what);
    }

  private:
    const ProgressMonitor& monitor_;
    const int tasks_;
    int begun_ = 0;
    std::mutex mutex_;
};

class FaceTeam {
  public:
    /// One face does all the work. It must outlive the team.
    explicit FaceTeam(face::Face& only) : faces_{&only}, free_(faces_) {}
    /// `build` makes faces that equal `first`. There are as many faces as threads, kMaxTeam at most.
    FaceTeam(face::Face& first, const std::function<face::Face()>& build,
             const ThreadLimit& threads);

    face::Face& first() const { return *faces_.front(); }

    /// Calls task(i, face) for i in [0, count), on several threads. Of several exceptions, that with the lowest i is thrown.
    void each(int count, const std::function<void(int i, face::Face& face)>& task);
    /// Makes the same change to all faces.
    void all(const std::function<void(face::Face& face)>& change) const {
        for (face::Face* face : faces_) change(*face);
    }

  private:
    std::vector<std::unique_ptr<face::Face>> own_;
    std::vector<face::Face*> faces_, free_;
    std::mutex mutex_;
};

}  // namespace risorius::fitting
