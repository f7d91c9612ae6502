// SPDX-License-Identifier: MIT
/// \file
/// Loops on several threads. Nested loops share one pool of spare threads. So other loops can use the threads of a loop that
/// has ended.
#pragma once

#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace risorius {

/// A pool of spare threads: the number of threads that loops may still start. Several threads may call its functions.
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
    /// Returns a thread to the pool.
    void give() {
        const std::lock_guard<std::mutex> lock(mutex_);
        ++count_;
    }
    /// Takes a thread back that was given to the pool, even if another loop uses it. Then there is one thread too many for a
    /// while.
    void take_back() {
        const std::lock_guard<std::mutex> lock(mutex_);
        --count_;
    }

  private:
    std::mutex mutex_;
    int count_;
};

/// The number of threads to use. An int converts to it.
struct ThreadLimit {
    int max = 0;  ///< 0: as many as the machine has
    /// The pool of additional threads; the calling thread is not taken from it.
    SpareThreads* spare = nullptr;

    ThreadLimit(int max_threads = 0, SpareThreads* spare_threads = nullptr)
        : max(max_threads), spare(spare_threads) {}

    int count() const;
};

/// Starts a thread that is joined with the list. Returns false when the system refuses one: then the work has to do with fewer.
template <class Work>
bool add_thread(std::vector<std::jthread>& threads, Work work) {
    try {
        threads.emplace_back(std::move(work));
        return true;
    } catch (const std::system_error&) {
        return false;
    }
}

/// Calls body(i) for i in [0, count) on several threads, lowest i first. A call must not write data that other calls use. After
/// an exception no further calls begin; when the running ones have ended, the exception with the lowest i is thrown again.
/// Calls may be nested when they share their spare threads.
void parallel_for(int count, const ThreadLimit& threads, const std::function<void(int)>& body);

}  // namespace risorius
