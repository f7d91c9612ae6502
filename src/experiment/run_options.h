// How a figure is run: threads, progress, the wish to stop, and runs that several figures share.
#pragma once

#include <any>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace risorius::experiment {

/// The run was asked to stop.
class Interrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted"; }
};

/// Results of runs that more than one figure shows (9a and 9b), by what was run. Not for use by several threads.
class SharedRuns {
  public:
    /// The result of an equal run before, or else of `run`.
    template <typename Result>
    std::shared_ptr<const Result> get(const std::string& key, const std::function<Result()>& run) {
        std::any& kept = runs_[key];
        if (!kept.has_value()) kept = std::make_shared<const Result>(run());
        return std::any_cast<std::shared_ptr<const Result>>(kept);
    }

  private:
    std::map<std::string, std::any> runs_;
};

struct RunOptions {
    int threads = 0;  ///< 0 = as many as the machine has; results do not depend on it
    /// Share of the run done, 0..1, and what is being run; called from any thread, one at a time.
    std::function<void(double share, const std::string& what)> progress = {};
    std::function<bool()> stopped = {};  ///< asked often, from any thread
    SharedRuns* shared = nullptr;

    /// Throws Interrupted when asked to stop.
    void stop_if_asked() const {
        if (stopped && stopped()) throw Interrupted();
    }
    void tell(double share, const std::string& what) const {
        stop_if_asked();
        if (progress) progress(share, what);
    }
};

}  // namespace risorius::experiment
