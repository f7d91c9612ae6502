// SPDX-License-Identifier: MIT
// Makes the clips and the files of a stimulus set from a design.
#include "risorius/stimuli/batch.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/output_set.h"
#include "risorius/core/parallel.h"
#include "risorius/design/conditions.h"
#include "risorius/report/stopwatch.h"
#include "risorius/stimuli/detail/clip_checks.h"
#include "risorius/stimuli/detail/experiment_files.h"
#include "risorius/stimuli/detail/luminance_maps.h"
#include "risorius/stimuli/detail/luminance_match.h"
#include "risorius/stimuli/detail/motion_match.h"
#include "risorius/stimuli/detail/norms.h"
#include "risorius/stimuli/detail/own_files.h"
#include "risorius/stimuli/detail/stimulus_set.h"
#include "risorius/stimuli/detail/unmatched_render.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

constexpr int kMostPlanners = 8;
constexpr double kSearchFraction = 0.3;  // of the progress, when match/motion has to be searched
constexpr double kScene_s = 2;  // estimated time on two cores to build face, scene and view

/// Calls make(i, session) for all i < count, with one thread per worker. Each worker has its own session.
void for_each(std::size_t count, int workers,
              const std::function<void(std::size_t i, animate::RenderSession&)>& make) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&] {
        try {
            animate::RenderSession session;
            for (std::size_t i; (i = next++) < count;) make(i, session);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
            next = count;
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int t = 1; t < workers && add_thread(threads, work);) ++t;
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

/// Plans all clips on several threads. Throws what the first clip throws that cannot be planned. Recordings are read one after another.
std::vector<ClipPlan> plan_clips(std::vector<design::Condition> conditions,
                                 const std::map<std::string, double>& lead_s,
                                 const design::Design& design, animate::RenderInputs& inputs) {
    const bool heard = std::any_of(conditions.begin(), conditions.end(),
                                   [](const auto& one) { return one.audio.has_value(); });
    std::vector<ClipPlan> out(conditions.size());
    SoundPlans sounds;
    ClipChecks checks;
    const PlanShared shared{design, inputs, sounds, checks};
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::size_t failed = conditions.size();
    std::mutex mutex;
    const auto work = [&] {
        for (std::size_t i; (i = next++) < conditions.size();) try {
                const double lead = lead_s.at(conditions[i].set);
                out[i] = plan_clip(std::move(conditions[i]), lead, shared);
                if (conditions.size() > kClipsPerFolder) out[i].folder = folder_of_clips(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (i < failed) failure = std::current_exception();
                failed = std::min(failed, i);
                next = conditions.size();
            }
    };
    {
        const int workers = heard ? 1 : std::min(ThreadLimit().count(), kMostPlanners);
        std::vector<std::jthread> threads;
        for (int t = 1; t < workers && add_thread(threads, work);) ++t;
        work();
    }
    if (failure) std::rethrow_exception(failure);
    return out;
}

/// Numbers the conditions, and marks which unmatched renders are needed again when the clip itself is made.
void share_renders(std::vector<ClipPlan>& clips) {
    std::map<std::string, std::size_t> at;
    std::size_t conditions = 0;
    for (std::size_t i = 0; i < clips.size(); ++i) {
        at[clips[i].condition.clip] = i;
        if (!clips[i].is_control()) clips[i].condition_number = conditions++;
    }
    for (std::size_t i = 0; i < clips.size(); ++i) {
        ClipPlan& of = clips[at.at(clips[i].condition.of)];
        if (clips[i].is_control() && clips[i].render_sha256 == of.render_sha256)
            of.render_is_shared = true;
    }
}

/// Adds a note about clips that differ only in their names: their script does not use one of the factors.
void note_twins(BatchPlan& plan) {
    std::map<std::string, const ClipPlan*> first;
    std::string example;
    int twins = 0;
    for (const ClipPlan& clip : plan.clips) {
        if (clip.is_control()) continue;
        const auto [like, is_new] = first.emplace(clip.shown_sha256(), &clip);
        if (is_new) continue;
        if (++twins == 1)
            example = clip.condition.clip + " is " + like->second->condition.clip + " again";
    }
    if (twins > 0)
        plan.notes.push_back(std::to_string(twins) +
                             (twins == 1 ? " clip shows the same as another ("
                                         : " clips show the same as others (") +
                             example + "): does the script use every factor?");
}

}  // namespace

std::vector<std::string> clip_names(const BatchPlan& plan) {
    std::vector<std::string> out;
    for (const ClipPlan& clip : plan.clips) out.push_back(clip.condition.clip);
    return out;
}

double BatchPlan::seconds() const {
    double sum = 0;
    const ClipPlan* before = nullptr;
    for (const ClipPlan& clip : clips) {
        sum += clip.seconds();
        if (!before || before->scene_sha256 != clip.scene_sha256) sum += kScene_s;
        before = &clip;
    }
    return sum;
}

double BatchPlan::megabytes() const {
    double sum = 0;
    for (const ClipPlan& clip : clips) sum += clip.megabytes();
    return sum;
}

BatchPlan plan_batch(const fs::path& file, const ProgressMonitor& monitor) {
    const design::Design design = design::read_design(file);
    BatchPlan plan;
    plan.name = design.name;
    plan.design = file;
    plan.match = design.match;
    plan.experiment = design.experiment;
    plan.triggers = design.triggers;
    plan.dataset = design.dataset;
    for (const design::ConditionSet& set : design.sets)
        if (set.sample)
            plan.samples.emplace_back(set.name, design::balance_of(set.trials, *set.sample));
    for (const design::ConditionSet& set : design.sets)
        if (!set.fraction.empty() || set.draw)
            plan.balances.emplace_back(set.name, design::balance_of(set, design.seed));
    plan.inputs = std::make_shared<animate::RenderInputs>(monitor.stopped);
    MotionMatch motion(design.clips.quality, *plan.inputs, design::motion_searches(design),
                       monitor);
    const design::MotionSearch search{
        [&](double share, const design::MotionSearch::Script& script_at, const fs::path& folder,
            const std::string& place) {
            return motion.intensity_for(share, script_at, folder, place);
        },
        [&](double apex_s, const design::MotionSearch::Script& script_at, const fs::path& folder,
            const std::string& place) {
            return motion.time_for(apex_s, script_at, folder, place);
        }};
    std::vector<design::Condition> conditions = design::conditions_of(design, search);
    // All clips of a set begin as early as its earliest recording, so that they are equally long.
    std::map<std::string, double> lead_s;
    for (const design::Condition& condition : conditions)
        lead_s[condition.set] = std::max(lead_s[condition.set], -condition.audio_start_s);
    plan.clips = plan_clips(std::move(conditions), lead_s, design, *plan.inputs);
    plan.codes = codes_of_clips(plan.clips, design);
    share_renders(plan.clips);
    name_maps(plan);
    check_experiment(plan);
    note_twins(plan);
    return plan;
}

Json BatchReport::json() const {
    Json list = Json::array();
    for (const auto& [clip, why] : failed)
        list.push_back(json_object({{"stim_id", clip}, {"why", why}}));
    return json_object({{"format", "risorius-batch"},
                        {"version", 1},
                        {"name", name},
                        {"made", made},
                        {"kept", kept},
                        {"elsewhere", elsewhere},
                        {"unmeasured", unmeasured},
                        {"failed", list},
                        {"changed", changed},
                        {"notes", notes},
                        {"complete", complete},
                        {"seconds", seconds}});
}

namespace {

/// Works through the clips of a batch with several workers, and reports each of them.
class BatchRun {
  public:
    BatchRun(const BatchOptions& options, const ProgressMonitor& monitor,
             animate::RenderInputs& inputs, BatchReport& report)
        : options_(options), monitor_(monitor), inputs_(inputs), report_(report) {}

    bool is_mine(std::size_t index) const {
        return static_cast<int>(index % static_cast<std::size_t>(options_.parts)) + 1 ==
               options_.part;
    }
    /// The names of what this part of the batch makes, for OutputSet::claim().
    std::vector<std::string> names_of(const BatchPlan& plan) const {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < plan.clips.size(); ++i) {
            const ClipPlan& clip = plan.clips[i];
            if (is_mine(i)) names.push_back("clip " + clip.condition.clip);
            if (plan.match.luminance && !clip.is_control() && is_mine(clip.condition_number))
                names.push_back("render of " + clip.condition.clip);
        }
        return names;
    }
    void report(const ClipPlan& clip, const char* state, const std::string& why = {}) const {
        if (options_.report_clip) options_.report_clip(clip.condition.clip, state, why);
    }
    using Work = std::function<void(const ClipPlan&, const ClipWorker&)>;
    /// Calls make() for each clip and returns how many succeeded. Those that failed are added to the report.
    int work(const std::vector<const ClipPlan*>& clips, const char* done, const Work& make) {
        for (const ClipPlan* clip : clips) left_s_ += clip->seconds();
        const double all_s = left_s_;
        int count = 0;
        // With many clips, each gets one thread, so that a worker uses one core of a cluster. With few clips, each gets more.
        const int at_once = std::clamp(static_cast<int>(clips.size()), 1, options_.workers);
        for_each(clips.size(), at_once, [&](std::size_t i, animate::RenderSession& session) {
            const ClipPlan& clip = *clips[i];
            std::string why;
            // The progress of single frames is not reported.
            const ProgressMonitor frames{.progress = {}, .stopped = monitor_.stopped};
            try {
                {
                    const std::lock_guard lock(reporting_);
                    monitor_.report(1 - left_s_ / std::max(all_s, 1e-9), clip.condition.clip);
                }
                make(clip, {.folder = options_.out,
                            .threads = options_.workers / at_once,
                            .clips_at_once = at_once,
                            .inputs = inputs_,
                            .session = session,
                            .settled = settled_,
                            .monitor = frames});
            } catch (const Error& error) {
                why = error.what();
            } catch (const RunError& error) {
                why = error.what();
            }
            const std::lock_guard lock(reporting_);
            left_s_ -= clip.seconds();
            if (why.empty())
                ++count;
            else
                report_.failed.emplace_back(clip.condition.clip, why);
            report(clip, why.empty() ? done : "failed", why);
        });
        std::sort(report_.failed.begin(), report_.failed.end());
        return count;
    }

  private:
    const BatchOptions& options_;
    const ProgressMonitor& monitor_;
    animate::RenderInputs& inputs_;
    BatchReport& report_;
    SettledMotions settled_;
    std::mutex reporting_;
    double left_s_ = 0;  ///< estimated time of the remaining clips
};

/// Throws Error when a clip would replace a file that is not as `batch` has written it.
void check_not_changed(const std::vector<const ClipPlan*>& clips, const fs::path& folder) {
    if (!fs::exists(folder)) return;
    const std::set<fs::path> own = own_files(folder);
    for (const ClipPlan* clip : clips) {
        const ClipFiles files = clip_files(*clip);
        std::vector<fs::path> all = files.listed();
        all.push_back(files.sidecar);
        for (const fs::path& file : all)
            if (fs::exists(folder / file) && own.count(file) == 0)
                throw Error((folder / file).string(),
                            "no file, or one that is as `batch` has written it, unless " +
                                option_name("replace") + " is given",
                            "another or a changed one");
    }
}

/// Writes the files of the set. The last two parts may come to this at the same time; then one waits for the other.
std::vector<std::string> write_set_after_others(const BatchPlan& plan, const BatchOptions& options,
                                                const ProgressMonitor& monitor) {
    for (;;) {
        try {
            return write_set(plan, options, monitor);
        } catch (const OutputInUse&) {
            monitor.throw_if_stopped();
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    }
}

}  // namespace

BatchReport make_batch(const BatchOptions& options, const ProgressMonitor& monitor) {
    const report::Stopwatch time;
    bool searched = false;
    ProgressMonitor planning = monitor.subrange(0, kSearchFraction);
    if (planning.progress)
        planning.progress = [&, tell = planning.progress](double fraction,
                                                          const std::string& what) {
            searched = true;
            tell(fraction, what);
        };
    BatchPlan plan = plan_batch(options.design, planning);
    const ProgressMonitor making = searched ? monitor.subrange(kSearchFraction, 1) : monitor;
    check_own_folder(options.out, options.replace ? "" : plan.name);
    if (!options.norms.empty()) read_ratings(options.norms, clip_names(plan));
    BatchReport report;
    report.name = plan.name;
    BatchRun run(options, making, *plan.inputs, report);
    // Two runs may share a folder, but not a clip.
    OutputSet claims(options.out, OutputSet::Then::kRunGoesOn);
    claims.claim(run.names_of(plan));

    // Luminance is matched over the whole set, so all conditions are rendered before the first clip is made.
    if (plan.match.luminance) {
        std::vector<const ClipPlan*> conditions;
        for (const std::size_t i : unmeasured(plan, options.out))
            if (run.is_mine(plan.clips[i].condition_number)) conditions.push_back(&plan.clips[i]);
        run.work(conditions, "filmed", make_unmatched_render);
        report.unmeasured =
            static_cast<int>(unmeasured(plan, options.out).size() - report.failed.size());
        if (!report.failed.empty() || report.unmeasured > 0) {
            report.elsewhere = static_cast<int>(plan.clips.size() - report.failed.size());
            report.seconds = time.seconds();
            return report;
        }
        match_luminance(options.out, plan);
    }

    // Find the clips that exist already.
    std::vector<const ClipPlan*> wanted;
    for (std::size_t i = 0; i < plan.clips.size(); ++i) {
        const ClipPlan& clip = plan.clips[i];
        if (is_made(clip, options.out)) {
            ++report.kept;
            run.report(clip, "kept");
        } else if (!run.is_mine(i)) {
            ++report.elsewhere;
        } else {
            wanted.push_back(&clip);
        }
    }
    if (!options.replace) check_not_changed(wanted, options.out);
    report.made = run.work(wanted, "made", make_clip);

    // Write the files of the whole set.
    if (report.failed.empty() && report.elsewhere == 0) {
        making.report(1, "the files of the set");
        report.changed = write_set_after_others(plan, options, making);
        report.complete = true;
    }
    report.notes = plan.notes;
    report.seconds = time.seconds();
    return report;
}

}  // namespace risorius::stimuli
