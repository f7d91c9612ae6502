// Threads that several runs have between them: who is done, or waits, lends its own to whoever has work left.
#pragma once

#include <mutex>

namespace risorius::experiment {

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
    int most = 0;                   ///< 0 = as many as the machine has
    SpareThreads* spare = nullptr;  ///< where to take them from, besides the one that asks

    ThreadLimit(int most_threads = 0, SpareThreads* spare_threads = nullptr)
        : most(most_threads), spare(spare_threads) {}

    int count() const;
};

}  // namespace risorius::experiment
