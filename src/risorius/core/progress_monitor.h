// SPDX-License-Identifier: MIT
/// \file
/// Progress and interruption of a long run. The caller passes two functions, and the run calls them between its steps.
#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <string>

namespace risorius {

/// Thrown when the caller has asked the run to stop. All files that the run had begun to write are removed.
class Interrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted"; }
};

/// The two functions of the caller. Both may be empty.
struct ProgressMonitor {
    /// Receives the fraction of the run that is done, 0 to 1, and the name of the present task.
    std::function<void(double fraction, const std::string& what)> progress;
    std::function<bool()> stopped;  ///< returns true when the run should stop

    /// Throws Interrupted when the run should stop.
    void throw_if_stopped() const {
        if (stopped && stopped()) throw Interrupted();
    }
    /// Reports progress. Throws Interrupted when the run should stop.
    void report(double fraction, const std::string& what) const {
        throw_if_stopped();
        if (progress) progress(fraction, what);
    }
    /// Returns a monitor for a part of the run. Its fractions 0 to 1 become `from` to `to` of the whole run.
    ProgressMonitor subrange(double from, double to) const {
        ProgressMonitor out = *this;
        if (progress)
            out.progress = [whole = progress, from, to](double fraction, const std::string& what) {
                whole(from + (to - from) * fraction, what);
            };
        return out;
    }
};

/// Counts the tasks of a run that have begun. Several threads may call begin().
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

}  // namespace risorius
