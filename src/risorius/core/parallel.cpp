// SPDX-License-Identifier: MIT
#include "risorius/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace risorius {

int ThreadLimit::count() const {
    return max > 0 ? max : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallel_for(int count, const ThreadLimit& threads, const std::function<void(int)>& body) {
    SpareThreads own(threads.count() - 1);
    SpareThreads& spare = threads.spare ? *threads.spare : own;

    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(std::max(count, 0)));
    std::atomic<int> next{0};
    std::atomic<bool> failed{false};
    std::mutex mutex;
    std::vector<std::jthread> others;
    bool refused = false;
    std::function<void()> work;
    // Called before each piece of work, because a thread may have become free.
    const auto recruit = [&] {
        const std::lock_guard<std::mutex> lock(mutex);
        if (refused || failed || next + 1 >= count || !spare.take()) return;
        refused = !add_thread(others, [&] {
            work();
            spare.give();
        });
        if (refused) spare.give();
    };
    work = [&] {
        for (;;) {
            recruit();
            const int i = next++;
            if (i >= count || failed) return;
            try {
                body(i);
            } catch (...) {
                failures[static_cast<std::size_t>(i)] = std::current_exception();
                failed = true;
            }
        }
    };
    work();
    spare.give();
    for (;;) {
        std::unique_lock<std::mutex> lock(mutex);
        if (others.empty()) break;
        std::jthread last = std::move(others.back());
        others.pop_back();
        lock.unlock();
        last.join();
    }
    spare.take_back();
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace risorius
