// SPDX-License-Identifier: MIT
/// \file
/// Stopwatches of wall time and CPU time since their construction. They are for reports only: no result depends on them.
#pragma once

#include <time.h>

#include <chrono>

namespace risorius::report {

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Measures the CPU time of this thread, or of all threads of this process.
template <clockid_t kClock>
class ClockStopwatch {
  public:
    double seconds() const { return now() - begin_; }

  private:
    static double now() {
        timespec time{};
        ::clock_gettime(kClock, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    double begin_ = now();
};
using CoreStopwatch = ClockStopwatch<CLOCK_THREAD_CPUTIME_ID>;
using ProcessStopwatch = ClockStopwatch<CLOCK_PROCESS_CPUTIME_ID>;

}  // namespace risorius::report
