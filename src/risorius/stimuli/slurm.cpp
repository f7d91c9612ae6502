// SPDX-License-Identifier: MIT
#include "risorius/stimuli/slurm.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/text_lines.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/run_program.h"
#include "risorius/report/stopwatch.h"
#include "risorius/stimuli/detail/luminance_match.h"
#include "risorius/stimuli/detail/own_files.h"
#include "risorius/stimuli/detail/stimulus_set.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

// The Slurm manual asks programs not to query the controller more often.
constexpr auto kBetweenQueries = std::chrono::seconds(2);

/// Quotes text for a POSIX shell.
std::string shell_quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + "'";
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

report::ProgramResult slurm_program(const std::vector<std::string>& command) {
    const report::ProgramResult result = report::run_program(command);
    if (result.exit_code == 127)
        throw Error(option_name("engine"), "the programs of Slurm with \"slurm\"",
                    "no program " + in_quotes(command[0]));
    return result;
}

/// The script of the job. When no job is accepted it goes again, with the folders that were made for it.
class JobScript {
  public:
    JobScript(const fs::path& folder, const std::string& text) : file_(folder / "slurm.sh") {
        for (fs::path above = folder; !above.empty() && !fs::exists(above);
             above = above.parent_path())
            made_.push_back(above);
        report::write_text(file_, text);
    }
    ~JobScript() {
        if (kept_) return;
        std::error_code ignored;
        fs::remove(file_, ignored);
        for (const fs::path& folder : made_) ::rmdir(folder.c_str());  // only when it is empty
    }
    JobScript(const JobScript&) = delete;
    JobScript& operator=(const JobScript&) = delete;
    void keep() { kept_ = true; }

  private:
    fs::path file_;
    std::vector<fs::path> made_;  ///< the innermost first
    bool kept_ = false;
};

std::string sbatch_option(const std::string& name, const std::string& value = "") {
    return "--" + name + (value.empty() ? "" : "=" + value);
}

class Job {
  public:
    Job(const BatchOptions& batch, const SlurmOptions& slurm, const std::vector<int>& tasks,
        int round) {
        std::string array;
        for (const int task : tasks) array += (array.empty() ? "" : ",") + std::to_string(task);
        const fs::path code = fs::absolute(batch.out) / "code";
        std::vector<std::string> command{
            "sbatch",
            sbatch_option("parsable"),
            sbatch_option("job-name", "risorius"),
            sbatch_option("array", array),
            sbatch_option("cpus-per-task", std::to_string(slurm.workers)),
            sbatch_option("output",
                          (code / ("slurm-" + std::to_string(round) + "-%a.log")).string())};
        if (!slurm.account.empty()) command.push_back(sbatch_option("account", slurm.account));
        if (!slurm.partition.empty())
            command.push_back(sbatch_option("partition", slurm.partition));
        if (!slurm.time.empty()) command.push_back(sbatch_option("time", slurm.time));
        command.push_back((code / "slurm.sh").string());
        const report::ProgramResult sent = slurm_program(command);
        id_ = one_line(sent.output.substr(0, sent.output.find(';')));
        if (sent.exit_code != 0 || id_.empty() ||
            id_.find_first_not_of("0123456789") != std::string::npos)
            throw RunError("sbatch: " + one_line(sent.output));
    }
    /// Whether any task is pending or running. A job that Slurm no longer knows has ended.
    bool goes_on() const {
        const report::ProgramResult seen = slurm_program({"squeue", "-h", "-j", id_, "-o", "%T"});
        return seen.exit_code == 0 && !one_line(seen.output).empty();
    }
    void cancel() const { slurm_program({"scancel", id_}); }

  private:
    std::string id_;
};

constexpr FileKind kTaskLog{"the log of a task", 256 * kMegabyte};

/// Adds the messages of failed clips from the logs of the tasks.
void add_failures(const fs::path& code, std::vector<std::pair<std::string, std::string>>& failed) {
    for (auto& [clip, why] : failed)
        for (const auto& entry : fs::directory_iterator(code)) {
            if (entry.path().extension() != ".log") continue;
            const std::string log = read_file(entry.path(), kTaskLog);
            for (TextLines lines(log); lines.next();) {
                const Json event = json_or_null(lines.line());
                const auto says = [&](const char* key, const std::string& what) {
                    const auto found = event.find(key);
                    return found != event.end() && *found == what;
                };
                if (!event.is_object() || !says("event", "failed") || !says("stim_id", clip))
                    continue;
                const auto said = event.find("why");
                if (said != event.end() && said->is_string()) why = said->get<std::string>();
            }
        }
}

/// The script that every task of the array runs.
std::string slurm_script(const BatchOptions& batch, const SlurmOptions& slurm, int tasks) {
    // Where the part stands, the shell puts the number of the task.
    const std::string part = "TASK/" + std::to_string(tasks);
    std::string script = "#!/bin/sh\n" + std::string(kJobScriptMark) + "\nexec";
    for (const std::string& word : slurm.part_command(fs::absolute(batch.design),
                                                      fs::absolute(batch.out), slurm.workers, part))
        script += " " + (word == part ? "\"$SLURM_ARRAY_TASK_ID/" + std::to_string(tasks) + "\""
                                      : shell_quoted(word));
    return script + "\n";
}

/// Submits job arrays one after the other, until no clip is missing or no retries are left.
class Rounds {
  public:
    /// Returns the indices in the plan of the missing clips.
    using FindMissing = std::function<std::vector<std::size_t>()>;

    Rounds(const BatchOptions& batch, const SlurmOptions& slurm, int tasks, JobScript& script,
           const ProgressMonitor& monitor)
        : batch_(batch), slurm_(slurm), tasks_(tasks), script_(script), monitor_(monitor) {}

    /// `number`: the number by which a clip is assigned to a part.
    std::vector<std::size_t> run(const char* what, const FindMissing& find_missing,
                                 const std::function<std::size_t(std::size_t)>& number) {
        std::vector<std::size_t> missing = find_missing();
        const auto all = static_cast<double>(missing.size());
        for (int round = 0; round <= slurm_.retries && !missing.empty(); ++round) {
            // The parts are those of make_batch().
            std::set<int> parts;
            for (const std::size_t i : missing)
                parts.insert(static_cast<int>(number(i) % static_cast<std::size_t>(tasks_)) + 1);
            const Job job(batch_, slurm_, {parts.begin(), parts.end()}, sent_++);
            script_.keep();
            try {
                while (job.goes_on()) {
                    monitor_.report(1 - static_cast<double>(missing.size()) / all,
                                    std::to_string(missing.size()) + " " + what + " left");
                    wait(kBetweenQueries);
                    missing = find_missing();
                }
            } catch (const Interrupted&) {
                const UninterruptedStep step;
                job.cancel();
                throw;
            }
            missing = find_missing();
        }
        return missing;
    }

  private:
    /// Throws Interrupted soon after the run was asked to stop.
    void wait(std::chrono::milliseconds time) const {
        constexpr auto kPause = std::chrono::milliseconds(50);
        for (; time.count() > 0; time -= kPause) {
            monitor_.throw_if_stopped();
            std::this_thread::sleep_for(kPause);
        }
    }

    const BatchOptions& batch_;
    const SlurmOptions& slurm_;
    int tasks_;
    JobScript& script_;
    const ProgressMonitor& monitor_;
    int sent_ = 0;
};

}  // namespace

BatchReport make_batch_on_slurm(const BatchOptions& batch, const SlurmOptions& slurm,
                                const ProgressMonitor& monitor) {
    const report::Stopwatch time;
    BatchPlan plan = plan_batch(batch.design, monitor);
    check_own_folder(batch.out, batch.replace ? "" : plan.name);
    BatchReport report;
    report.name = plan.name;
    const int tasks = std::clamp(slurm.tasks, 1, static_cast<int>(plan.clips.size()));
    for (const char* program : {"sbatch", "squeue", "scancel"})
        slurm_program({program, sbatch_option("version")});
    JobScript script(batch.out / "code", slurm_script(batch, slurm, tasks));
    Rounds rounds(batch, slurm, tasks, script, monitor);

    // Luminance is matched over the whole set, so all conditions are rendered first. A task makes clips as well once all renders
    // exist.
    std::vector<std::size_t> missing = rounds.run(
        "conditions", [&] { return unmeasured(plan, batch.out); },
        [&](std::size_t i) { return plan.clips[i].condition_number; });
    if (missing.empty()) {
        match_luminance(batch.out, plan);
        std::vector<char> made(plan.clips.size(), 0);
        const char* state = "kept";
        missing = rounds.run(
            "clips",
            [&] {
                std::vector<std::size_t> out;
                for (std::size_t i = 0; i < plan.clips.size(); ++i) {
                    if (made[i]) continue;
                    if (!is_made(plan.clips[i], batch.out)) {
                        out.push_back(i);
                        continue;
                    }
                    made[i] = 1;
                    ++(std::string(state) == "kept" ? report.kept : report.made);
                    if (batch.report_clip)
                        batch.report_clip(plan.clips[i].condition.clip, state, "");
                }
                state = "made";
                return out;
            },
            [](std::size_t i) { return i; });
    } else {
        report.unmeasured = static_cast<int>(missing.size());
    }

    for (const std::size_t i : missing)
        report.failed.emplace_back(plan.clips[i].condition.clip, "not made; see the logs in code/");
    add_failures(batch.out / "code", report.failed);
    if (batch.report_clip)
        for (const auto& [clip, why] : report.failed) batch.report_clip(clip, "failed", why);
    if (report.failed.empty()) {
        for (const auto& entry : fs::directory_iterator(batch.out / "code"))
            if (entry.path().filename().string().rfind("slurm", 0) == 0) fs::remove(entry.path());
        report.changed = write_set(plan, batch, monitor);
        report.complete = true;
    }
    report.seconds = time.seconds();
    return report;
}

}  // namespace risorius::stimuli
