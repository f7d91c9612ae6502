// What the program says while it works: a progress bar with the time left, and whether Ctrl-C was pressed.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "risorius/core/progress_monitor.h"

namespace CLI {
class App;
}

namespace risorius::cli {

/// Every command has these.
struct Common {
    bool quiet = false;  ///< no progress, no summary
    bool json = false;   ///< the report as JSON on standard output
};

/// Adds --quiet and --json to a command.
void add_common(CLI::App& command, Common& common);

/// Lets SIGINT and SIGTERM end the run between two frames instead of killing it.
void catch_interrupts();

/// On standard error, for runs longer than two seconds; where that is not a terminal but a log, a line every half minute.
class ProgressBar {
  public:
    explicit ProgressBar(const Common& common);
    ~ProgressBar();
    ProgressMonitor monitor();

  private:
    void show(double share, const std::string& what);

    using Clock = std::chrono::steady_clock;
    bool wanted_, on_terminal_;
    bool shown_ = false;
    Clock::time_point begin_ = Clock::now(), last_ = begin_;
    std::mutex mutex_;  // the stages of a render report from two threads
};

}  // namespace risorius::cli
