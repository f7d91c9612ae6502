// SPDX-License-Identifier: MIT
/// \file
/// A pipeline of three stages: items are produced on one thread, transformed on several and consumed in order on another.
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

#include "risorius/core/parallel.h"

namespace risorius::animate {

/// Limit of the number of items that are produced and not yet consumed, in addition to one per worker.
constexpr int kMaxWaiting = 4;

/// Calls consume(i, transform(worker, i, produce(i))) for i = 0 .. count - 1. With workers, produce() runs ahead on the calling
/// thread, transform() on one thread for each worker and consume() on a thread of its own. Without workers all three run on the
/// calling thread, as worker 0. produce() and consume() are called in order. The first exception stops all stages and is thrown
/// here.
template <typename Produce, typename Transform, typename Consume>
void run_pipeline(int count, int workers, Produce produce, Transform transform, Consume consume) {
    using Item = decltype(produce(0));
    using Result = decltype(transform(0, 0, produce(0)));
    const auto run_alone = [&] {
        for (int i = 0; i < count; ++i) consume(i, transform(0, i, produce(i)));
    };
    if (workers < 1) return run_alone();
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::pair<int, Item>> produced;
    std::map<int, Result> ready;
    int consumed = 0;
    bool all_produced = false, stop = false;
    std::exception_ptr failure;

    const auto fail = [&] {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop = true;
    };
    std::vector<std::jthread> threads;
    const auto change = [&](const auto& what) {
        {
            const std::lock_guard lock(mutex);
            what();
        }
        changed.notify_all();
    };
    bool consumes = false;
    int transforming = 0;
    for (int worker = 0; worker < workers; ++worker)
        transforming += add_thread(threads, [&, worker] {
            try {
                for (;;) {
                    std::optional<std::pair<int, Item>> item;
                    {
                        std::unique_lock lock(mutex);
                        changed.wait(lock,
                                     [&] { return !produced.empty() || all_produced || stop; });
                        if (stop || produced.empty()) break;
                        item.emplace(std::move(produced.front()));
                        produced.pop_front();
                    }
                    Result result = transform(worker, item->first, std::move(item->second));
                    change([&] { ready.emplace(item->first, std::move(result)); });
                }
            } catch (...) {
                fail();
            }
            changed.notify_all();
        });
    consumes = add_thread(threads, [&] {
        try {
            for (int i = 0; i < count; ++i) {
                std::optional<Result> result;
                {
                    std::unique_lock lock(mutex);
                    changed.wait(lock, [&] { return ready.contains(i) || stop; });
                    if (stop) break;
                    result.emplace(std::move(ready.extract(i).mapped()));
                }
                consume(i, std::move(*result));
                change([&] { ++consumed; });
            }
        } catch (...) {
            fail();
        }
        changed.notify_all();
    });

    if (!consumes || transforming == 0) {
        change([&] { stop = true; });  // the system has no threads for us
        threads.clear();
        return run_alone();
    }
    try {
        for (int i = 0; i < count; ++i) {
            {
                std::unique_lock lock(mutex);
                changed.wait(lock, [&] { return i - consumed < workers + kMaxWaiting || stop; });
                if (stop) break;
            }
            Item item = produce(i);
            change([&] { produced.emplace_back(i, std::move(item)); });
        }
    } catch (...) {
        fail();
    }
    change([&] { all_produced = true; });
    threads.clear();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace risorius::animate
