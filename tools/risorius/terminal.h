// SPDX-License-Identifier: MIT
/// \file
/// The progress bar of the program, and the options that every command has.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "risorius/core/progress_monitor.h"

namespace CLI {
class App;
}

namespace risorius::cli {

/// Options that every command has.
struct Common {
    bool quiet = false;  ///< no progress, no summary
    bool json = false;   ///< the report as JSON on standard output
};

/// Adds --quiet, --json and --no-cache to a command. The last one acts at once.
void add_common(CLI::App& command, Common& common);

/// Adds --threads to a command; 0 is one for each core. `what` does not depend on it: "The results are", "The rig is".
void add_threads(CLI::App& command, int& threads, const std::string& what);
/// Throws Error unless the number of threads is in [0, 256].
void check_threads(int threads);

/// Shows progress on standard error for runs longer than two seconds. If standard error is not a terminal, it writes a line every
/// half minute, or as often as the environment variable RISORIUS_PROGRESS_S says (s): " 42 %  0:12 left  frame 21 of 50".
class ProgressBar {
  public:
    explicit ProgressBar(const Common& common);
    ~ProgressBar();
    /// A monitor that reports to this bar, and asks to stop after Ctrl-C.
    ProgressMonitor monitor();

  private:
    void show(double fraction, const std::string& what);

    using Clock = std::chrono::steady_clock;
    bool wanted_, on_terminal_;
    bool shown_ = false;
    double quiet_s_, every_s_;
    Clock::time_point begin_ = Clock::now(), last_ = begin_;
    std::mutex mutex_;  // the stages of a render report from two threads
};

}  // namespace risorius::cli
