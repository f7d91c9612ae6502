// SPDX-License-Identifier: MIT
/// \file
/// Loops on several threads. Nested loops share one pool of spare threads, so that a loop that ends early lends its threads to
/// others.
#pragma once

#include <functional>
#include <mutex>

namespace risorius {

/// The number of threads that loops may still take from a pool. Several threads may use it.
class SpareThreads {
  public:
    explicit SpareThreads(int count) : count_(count) {}

    /// Takes a thread. Returns false when none is left.
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
    /// Takes back a thread that was lent. The lent thread continues, even if there is one too many for a while.
    void take_back() {
        const std::lock_guard<std::mutex> lock(mutex_);
        --count_;
    }

  private:
    std::mutex mutex_;
    int count_;
};

/// How many threads to use. A plain number converts to it.
struct ThreadLimit {
    int max = 0;  ///< 0: as many as the machine has
    /// The pool of additional threads; the calling thread is not taken from it.
    SpareThreads* spare = nullptr;

    ThreadLimit(int max_threads = 0, SpareThreads* spare_threads = nullptr)
        : max(max_threads), spare(spare_threads) {}

    int count() const;
};

/// Calls body(i) for i in [0, count) on several threads, lowest i first. Each call must only write its own data. The first
/// exception (by i) is thrown again after all calls have ended. Calls may be nested when they share their spare threads.
void parallel_for(int count, const ThreadLimit& threads, const std::function<void(int)>& body);

}  // namespace risorius
