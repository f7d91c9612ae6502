// SPDX-License-Identifier: MIT
/// \file
/// Processor time of the passes of a picture. For reports only: nothing that is drawn depends on it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace risorius::render {

/// CPU time of all threads of this process, s.
double processor_s();

class PassClock {
  public:
    /// From now on passed() waits until the driver has drawn everything, which costs time of its own.
    void turn_on() { on_ = true; }
    /// What was done before belongs to no pass.
    void begin();
    /// What was done since the last call, or since begin(), belongs to this pass.
    void passed(const char* name);
    /// Names of the passes in the order in which they first occurred, and their CPU time in all, s.
    const std::vector<std::pair<std::string, double>>& times() const { return times_; }

  private:
    bool on_ = false;
    double since_s_ = 0;
    std::vector<std::pair<std::string, double>> times_;
};

}  // namespace risorius::render
