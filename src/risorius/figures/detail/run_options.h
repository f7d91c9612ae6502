// SPDX-License-Identifier: MIT
/// \file
/// How a figure is run: threads, progress monitor with interruption, and results that several figures share.
#pragma once

#include <any>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "risorius/core/parallel.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::figures {

/// Results of runs that more than one figure shows (9a and 9b). The class is thread-safe: the first thread that asks for a key
/// computes the result. Others that ask for the same key wait, and return their threads to `spare` meanwhile.
class SharedRuns {
  public:
    explicit SharedRuns(SpareThreads* spare = nullptr) : spare_(spare) {}

    /// Returns the result stored under `key`, or calls `run` and stores its result.
    template <typename Result>
    std::shared_ptr<const Result> get(const std::string& key, const std::function<Result()>& run) {
        Kept& kept = kept_as(key);
        std::unique_lock<std::mutex> lock(kept.mutex, std::try_to_lock);
        if (!lock) {
            if (spare_) spare_->give();
            lock.lock();
            if (spare_) spare_->take_back();
        }
        if (!kept.result.has_value()) kept.result = std::make_shared<const Result>(run());
        return std::any_cast<std::shared_ptr<const Result>>(kept.result);
    }

  private:
    struct Kept {
        std::mutex mutex;
        std::any result;
    };
    Kept& kept_as(const std::string& key) {
        const std::lock_guard<std::mutex> lock(mutex_);
        return runs_[key];
    }

    SpareThreads* spare_;
    std::mutex mutex_;
    std::map<std::string, Kept> runs_;
};

/// Options of run_figure().
struct RunOptions {
    ThreadLimit threads = 0;       ///< results do not depend on it
    ProgressMonitor monitor = {};  ///< called from any thread, one call at a time
    SharedRuns* shared = nullptr;
};

}  // namespace risorius::figures
