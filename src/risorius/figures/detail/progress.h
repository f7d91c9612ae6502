// SPDX-License-Identifier: MIT
/// \file
/// Counts the finished work of several threads and reports it to the progress monitor, one call at a time.
#pragma once

#include <mutex>
#include <string>

#include "risorius/figures/detail/run_options.h"

namespace risorius::figures {

class Progress {
  public:
    Progress(const RunOptions& options, double whole) : options_(options), whole_(whole) {}

    /// Adds finished work, in the unit of `whole`, and reports its fraction with the text `what`. Throws Interrupted when the
    /// monitor asks to stop.
    void done(double work, const std::string& what) {
        const std::lock_guard<std::mutex> lock(mutex_);
        done_ += work;
        options_.monitor.report(done_ / whole_, what);
    }

  private:
    const RunOptions& options_;
    const double whole_;
    double done_ = 0;
    std::mutex mutex_;
};

}  // namespace risorius::figures
