// From a design to a folder of stimuli.
#include "app/batch.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/stimulus_set.h"
#include "app/stopwatch.h"
#include "core/error.h"
#include "stimuli/conditions.h"

namespace risorius::app {

namespace fs = std::filesystem;

namespace {

/// Calls make(i) for all i < count, on several threads when there are several workers.
void for_each(std::size_t count, int workers,
              const std::function<void(std::size_t i, Studio&)>& make) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&] {
        try {
            Studio studio;
            for (std::size_t i; (i = next++) < count;) make(i, studio);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
            next = count;
        }
    };
    std::vector<std::thread> threads;
    for (int t = 1; t < workers; ++t) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

void check_batch_folder(const fs::path& out) {
    if (!fs::exists(out)) return;
    if (!fs::is_directory(out)) throw Error(out.string(), "a folder, or nothing yet", "a file");
    if (!fs::is_empty(out) && !fs::exists(out / "dataset_description.json") &&
        !fs::exists(out / "code") && !fs::exists(out / "stimuli"))
        throw Error(out.string(), "an empty folder, or one that `batch` has begun",
                    "a folder with other files");
}

double BatchPlan::seconds() const {
    double sum = 0;
    for (const ClipPlan& clip : clips) sum += clip.seconds();
    return sum;
}

double BatchPlan::megabytes() const {
    double sum = 0;
    for (const ClipPlan& clip : clips) sum += clip.megabytes();
    return sum;
}

BatchPlan plan_batch(const fs::path& file) {
    const stimuli::Design design = stimuli::read_design(file);
    BatchPlan plan;
    plan.name = design.name;
    RigDigests rigs;
    for (const stimuli::Condition& condition : stimuli::conditions_of(design))
        plan.clips.push_back(plan_clip(condition, design.clips, rigs));
    return plan;
}

Json BatchReport::json() const {
    Json list = Json::array();
    for (const auto& [clip, why] : failed) list.push_back({{"stim_id", clip}, {"why", why}});
    return {{"format", "risorius-batch"},
            {"version", 1},
            {"name", name},
            {"made", made},
            {"kept", kept},
            {"elsewhere", elsewhere},
            {"failed", list},
            {"complete", complete},
            {"seconds", seconds}};
}

BatchReport make_batch(const BatchOptions& options, const Watch& watch) {
    const Stopwatch time;
    const BatchPlan plan = plan_batch(options.design);
    check_batch_folder(options.out);
    BatchReport report;
    report.name = plan.name;

    // What is there already
    std::vector<const ClipPlan*> wanted;
    std::mutex telling;
    const auto tell = [&](const ClipPlan& clip, const char* state, const std::string& why = {}) {
        if (options.told) options.told(clip.condition.clip, state, why);
    };
    double left_s = 0;
    for (std::size_t i = 0; i < plan.clips.size(); ++i) {
        const ClipPlan& clip = plan.clips[i];
        if (is_made(clip, options.out)) {
            ++report.kept;
            tell(clip, "kept");
        } else if (static_cast<int>(i % static_cast<std::size_t>(options.parts)) + 1 !=
                   options.part) {
            ++report.elsewhere;
        } else {
            wanted.push_back(&clip);
            left_s += clip.seconds();
        }
    }

    // What is not
    const double all_s = left_s;
    for_each(wanted.size(), std::min<int>(options.workers, static_cast<int>(wanted.size())),
             [&](std::size_t i, Studio& studio) {
                 const ClipPlan& clip = *wanted[i];
                 std::string why;
                 // Of its frames the batch tells nothing but that it goes on
                 const Watch frames{.progress = {}, .stopped = watch.stopped};
                 const auto share = [&] { return 1 - left_s / std::max(all_s, 1e-9); };
                 try {
                     {
                         const std::lock_guard lock(telling);
                         watch.tell(share(), clip.condition.clip);
                     }
                     make_clip(clip, options.out, options.workers > 1 ? 1 : 2, frames, studio);
                 } catch (const Error& error) {
                     why = error.what();
                 } catch (const RunError& error) {
                     why = error.what();
                 }
                 const std::lock_guard lock(telling);
                 left_s -= clip.seconds();
                 if (why.empty())
                     ++report.made;
                 else
                     report.failed.emplace_back(clip.condition.clip, why);
                 tell(clip, why.empty() ? "made" : "failed", why);
             });
    std::sort(report.failed.begin(), report.failed.end());

    // What is told of all of them
    if (report.failed.empty() && report.elsewhere == 0) {
        watch.tell(1, "the files of the set");
        write_set(plan, options.design, options.out);
        report.complete = true;
    }
    report.seconds = time.seconds();
    return report;
}

}  // namespace risorius::app
