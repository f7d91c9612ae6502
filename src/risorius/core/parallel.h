// SPDX-License-Identifier: MIT
/// \file
/// Loops on several threads. Nested loops share one pool of spare threads, so that a loop that ends early lends its threads to others.
#pragma once

#include <functional>
#include <mutex>

namespace risorius {

class SpareThreads {
  public:
    explicit SpareThreads(int count) : count_(count) {}

    /// Whether there was one to take.
    bool take() {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (count_ <= 0) return false;
        --count_;
        return true;
    }
    void give() {
        const std::lock_guard<std::mutex> lock(mutex_);
        ++count_;
    }
    /// A thread that was lent goes on, even if there is one too many for a while.
    void take_back() {
        const std::lock_guard<std::mutex> lock(mutex_);
        --count_;
    }

  private:
    std::mutex mutex_;
    int count_;
};

/// How many threads to use; a plain number will do.
struct ThreadLimit {
    int max = 0;                    ///< 0 = as many as the machine has
    SpareThreads* spare = nullptr;  ///< where to take them from, besides the one that asks

    ThreadLimit(int max_threads = 0, SpareThreads* spare_threads = nullptr)
        : max(max_threads), spare(spare_threads) {}

    int count() const;
};

/// Calls body(i) for i in [0, count) on several threads, lowest i first; each call must only write what is its own. The
/// first exception (by i) is thrown again after all have ended. Calls may nest when they share their spare threads.
void parallel_for(int count, const ThreadLimit& threads, const std::function<void(int)>& body);

}  // namespace risorius
