// Makes things on one thread and uses them on another, in order, a few in flight.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace risorius::app {

/// Calls use(i, make(i)) for i = 0 .. count - 1. With two threads make runs ahead of use by at most four. The first
/// exception of either stops both and is thrown here; make runs on the calling thread.
template <typename Make, typename Use>
void in_two_stages(int count, int threads, Make make, Use use) {
    using Item = decltype(make(0));
    if (threads < 2) {
        for (int i = 0; i < count; ++i) use(i, make(i));
        return;
    }
    constexpr std::size_t kInFlight = 4;
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Item> waiting;
    bool made_all = false, stop = false;
    std::exception_ptr failure;

    std::thread user([&] {
        try {
            for (int i = 0;; ++i) {
                std::optional<Item> item;
                {
                    std::unique_lock lock(mutex);
                    changed.wait(lock, [&] { return !waiting.empty() || made_all || stop; });
                    if (stop || waiting.empty()) return;
                    item.emplace(std::move(waiting.front()));
                    waiting.pop_front();
                }
                changed.notify_all();
                use(i, std::move(*item));
            }
        } catch (...) {
            const std::lock_guard lock(mutex);
            failure = std::current_exception();
            stop = true;
        }
        changed.notify_all();
    });
    try {
        for (int i = 0; i < count; ++i) {
            Item item = make(i);
            std::unique_lock lock(mutex);
            changed.wait(lock, [&] { return waiting.size() < kInFlight || stop; });
            if (stop) break;
            waiting.push_back(std::move(item));
            lock.unlock();
            changed.notify_all();
        }
    } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop = true;
    }
    {
        const std::lock_guard lock(mutex);
        made_all = true;
    }
    changed.notify_all();
    user.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace risorius::app
