#include "experiment/experiment_kind.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

namespace risorius::experiment {

void allow_experiment_keys(const JsonCursor& experiment, std::vector<std::string_view> own) {
    own.insert(own.begin(), {"format", "version", "figure", "kind", "title", "checks"});
    experiment.allow_keys(own);
}

void parallel_for(int count, int threads, const std::function<void(int)>& body) {
    if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    threads = std::min(threads, count);

    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(std::max(count, 0)));
    std::atomic<int> next{0};
    std::atomic<bool> failed{false};
    const auto work = [&] {
        for (int i = next++; i < count && !failed; i = next++) {
            try {
                body(i);
            } catch (...) {
                failures[static_cast<std::size_t>(i)] = std::current_exception();
                failed = true;
            }
        }
    };
    std::vector<std::thread> others;
    for (int k = 1; k < threads; ++k) others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace risorius::experiment
