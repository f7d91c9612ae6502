// Makes things on one thread, changes them on several, and uses them on another, in order, a few in flight.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace risorius::animate {

/// How many may have been made and not yet been used, over one for each worker.
constexpr int kMostWaiting = 4;

/// Calls use(i, change(worker, i, make(i))) for i = 0 .. count - 1. With workers, make runs ahead on the calling thread,
/// change on one thread per worker, several at once, and use on a thread of its own; without, all of it on the calling thread
/// as worker 0. make and use are called in order. The first exception stops all and is thrown here.
template <typename Make, typename Change, typename Use>
void run_pipeline(int count, int workers, Make make, Change change, Use use) {
    using Item = decltype(make(0));
    using Result = decltype(change(0, 0, make(0)));
    if (workers < 1) {
        for (int i = 0; i < count; ++i) use(i, change(0, i, make(i)));
        return;
    }
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::pair<int, Item>> made;
    std::map<int, Result> ready;
    int used = 0;
    bool made_all = false, stop = false;
    std::exception_ptr failure;

    const auto fail = [&] {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop = true;
    };
    std::vector<std::thread> threads;
    for (int worker = 0; worker < workers; ++worker)
        threads.emplace_back([&, worker] {
            try {
                for (;;) {
                    std::optional<std::pair<int, Item>> item;
                    {
                        std::unique_lock lock(mutex);
                        changed.wait(lock, [&] { return !made.empty() || made_all || stop; });
                        if (stop || made.empty()) break;
                        item.emplace(std::move(made.front()));
                        made.pop_front();
                    }
                    Result result = change(worker, item->first, std::move(item->second));
                    {
                        const std::lock_guard lock(mutex);
                        ready.emplace(item->first, std::move(result));
                    }
                    changed.notify_all();
                }
            } catch (...) {
                fail();
            }
            changed.notify_all();
        });
    threads.emplace_back([&] {
        try {
            for (int i = 0; i < count; ++i) {
                std::optional<Result> result;
                {
                    std::unique_lock lock(mutex);
                    changed.wait(lock, [&] { return ready.contains(i) || stop; });
                    if (stop) break;
                    result.emplace(std::move(ready.extract(i).mapped()));
                }
                use(i, std::move(*result));
                {
                    const std::lock_guard lock(mutex);
                    ++used;
                }
                changed.notify_all();
            }
        } catch (...) {
            fail();
        }
        changed.notify_all();
    });

    try {
        for (int i = 0; i < count; ++i) {
            {
                std::unique_lock lock(mutex);
                changed.wait(lock, [&] { return i - used < workers + kMostWaiting || stop; });
                if (stop) break;
            }
            Item item = make(i);
            {
                const std::lock_guard lock(mutex);
                made.emplace_back(i, std::move(item));
            }
            changed.notify_all();
        }
    } catch (...) {
        fail();
    }
    {
        const std::lock_guard lock(mutex);
        made_all = true;
    }
    changed.notify_all();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace risorius::animate
