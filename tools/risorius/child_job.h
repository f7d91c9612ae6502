// SPDX-License-Identifier: MIT
/// \file
/// A command of this program that the studio runs in a process of its own. The process ends when it is cancelled, and with the
/// studio.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "risorius/report/run_program.h"
#include "risorius/serve/web_server.h"

namespace risorius::cli {

/// What a job tells, on the thread of the server.
struct JobListener {
    std::function<void(double fraction, const std::string& what)> progress;
    /// `output`: what the program said, without its lines of progress
    std::function<void(int exit_code, bool cancelled, const std::string& output)> ended;
};

class ChildJob {
  public:
    /// Runs `risorius ARGUMENTS`. There must be no job that runs.
    void start(const std::vector<std::string>& arguments, serve::WebServer& server,
               JobListener listener);
    void cancel();
    bool running() const { return running_; }
    /// Cancels the job and waits until its process has ended.
    void finish() { thread_.reset(); }

  private:
    std::unique_ptr<std::jthread> thread_;
    bool running_ = false;
};

/// Reads " 42 %  0:12 left  frame 21 of 50", a line of progress (terminal.h). Returns false for other lines.
bool read_progress(const std::string& line, double& fraction, std::string& what);

}  // namespace risorius::cli
