// SPDX-License-Identifier: MIT
#include "risorius/figures/run_figure.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/read_file.h"
#include "risorius/core/toolkit_record.h"
#include "risorius/figures/detail/experiment_kind.h"
#include "risorius/figures/detail/figure_files.h"
#include "risorius/figures/figure_page.h"
#include "risorius/figures/registry.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/report/stopwatch.h"

namespace risorius::figures {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExperimentFile = "experiment.json";
/// Assumed run time of a figure for the progress when it is unknown, s
constexpr double kUnknownTime_s = 20;

fs::path folder_of_figures(const fs::path& from) {
    return from.empty() ? data_folder() / "samples" / "figures" : from;
}

std::string text_of(const fs::path& file) {
    return fs::exists(file) ? read_file(file, {"a text file", 32 * kMegabyte}) : std::string();
}

/// An experiment to run, and the folder of its files.
struct Job {
    fs::path file;
    std::string folder;  ///< below the folder of results, "" or "9b/"
    double run_time_s = 0;
};

/// Whether each figure has its own folder, with a page of all above them.
bool is_several(const FigureOptions& options) {
    return options.figure == "all" ||
           (!options.figure.ends_with(".json") && options.figure.find(',') != std::string::npos);
}

[[noreturn]] void fail_unknown(const std::string& id, const std::vector<FigureEntry>& entries) {
    std::string expected = "all, a file that ends in .json, or one of";
    std::vector<std::string> known{"all"};
    for (const FigureEntry& entry : entries) {
        expected += " " + entry.id;
        known.push_back(entry.id);
    }
    throw Error("figure", expected + did_you_mean(id, known), "\"" + id + "\"");
}

std::vector<Job> jobs_of(const FigureOptions& options) {
    const fs::path from = folder_of_figures(options.from);
    // A path is recognised by its extension, so that a mistyped id is not reported as a missing file.
    if (options.figure.ends_with(".json"))
        return {{.file = options.figure, .folder = "", .run_time_s = 0}};
    const std::vector<FigureEntry> entries = list_figures(options.from);
    const bool together = is_several(options);
    std::vector<Job> jobs;
    const auto add = [&](const FigureEntry& entry) {
        jobs.push_back({.file = from / entry.id / kExperimentFile,
                        .folder = together ? entry.id + "/" : "",
                        .run_time_s = entry.run_time_s});
    };
    if (options.figure == "all") {
        for (const FigureEntry& entry : entries) add(entry);
        return jobs;
    }
    std::set<std::string> seen;
    std::istringstream ids(options.figure);
    for (std::string id; std::getline(ids, id, ',');) {
        if (!seen.insert(id).second) throw Error("figure", "each id once", "\"" + id + "\" again");
        const auto entry = std::find_if(entries.begin(), entries.end(),
                                        [&](const FigureEntry& one) { return one.id == id; });
        if (entry == entries.end()) fail_unknown(id, entries);
        add(*entry);
    }
    return jobs;
}

/// File name of a picture of the published figure, which the user may have put beside the experiment.
std::string published_picture(const fs::path& folder) {
    for (const char* name : {"published.png", "published.jpg", "published.svg"})
        if (fs::exists(folder / name)) return name;
    return "";
}

void write_json(const fs::path& file, const Json& json) {
    report::write_text(file, json_text(json, 2) + "\n");
}

/// Writes all files of one figure except the page and the times.
ShownFigure write_results(const Job& job, figures::FigureResult result, const fs::path& top,
                          const plot::ChartWriter& charts) {
    const fs::path folder = job.folder.empty() ? top : top / job.folder;
    fs::create_directories(folder);
    ShownFigure shown;
    shown.folder = job.folder;
    shown.run_time_s = job.run_time_s;
    shown.files = write_figure(result, folder, charts);
    shown.readme = text_of(job.file.parent_path() / "README.md");
    shown.published = published_picture(job.file.parent_path());
    report::write_text(folder / kExperimentFile, text_of(job.file));
    if (!shown.published.empty())
        fs::copy_file(job.file.parent_path() / shown.published, folder / shown.published);
    shown.origin = figures::origin_of(result.id);
    shown.result = std::move(result);
    return shown;
}

/// Files of a folder as listed in results.json, including those in `to_come` that are not yet written.
Json listing(const fs::path& folder, const std::set<std::string>& to_come) {
    std::set<std::string> files = to_come;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory())
            files.insert(entry.path().lexically_relative(folder).generic_string());
    return Json(std::vector<std::string>(files.begin(), files.end()));
}

Json results_of_all(const std::vector<ShownFigure>& figures) {
    Json json = Json::object();
    json["format"] = "risorius-figures";
    json["version"] = 1;
    json["toolkit"] = toolkit_record();
    json["passes"] = std::all_of(figures.begin(), figures.end(),
                                 [](const ShownFigure& figure) { return figure.result.passes(); });
    json["figures"] = Json::array();
    for (const ShownFigure& figure : figures) {
        Json entry = figure_json(figure.result);
        for (const char* key : {"format", "version", "toolkit", "tables", "record"})
            entry.erase(key);
        entry["results"] = figure.folder + "results.json";
        json["figures"].push_back(entry);
    }
    return json;
}

/// Runs several figures at a time, longest first. When fewer figures than threads are left, free threads help within a figure.
class Run {
  public:
    Run(const FigureOptions& options, const ProgressMonitor& monitor, const std::vector<Job>& jobs)
        : options_(options),
          monitor_(monitor),
          jobs_(jobs),
          fractions_(jobs.size(), 0),
          spare_(ThreadLimit(options.threads).count() - 1),
          shared_(&spare_) {}

    struct Done {
        ShownFigure shown;
        double run_s = 0, write_s = 0;
    };

    /// Results in the order of the jobs; files are written below `top`.
    std::vector<Done> all(const fs::path& top) {
        std::vector<std::size_t> order(jobs_.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return expected_s(jobs_[a]) > expected_s(jobs_[b]);
        });
        std::vector<Done> done(jobs_.size());
        parallel_for(static_cast<int>(jobs_.size()), {options_.threads, &spare_}, [&](int i) {
            const std::size_t job = order[static_cast<std::size_t>(i)];
            try {
                done[job] = one(job, top);
            } catch (const Interrupted&) {
                // Stopped either by the monitor or because another figure has failed, whose error is reported.
                if (!failed_) throw Interrupted();
            } catch (...) {
                failed_ = true;
                throw;
            }
        });
        return done;
    }

  private:
    static double expected_s(const Job& job) {
        return job.run_time_s > 0 ? job.run_time_s : kUnknownTime_s;
    }

    Done one(std::size_t job, const fs::path& top) {
        const JsonCursor file = JsonCursor::read_file(jobs_[job].file);
        const std::string name = jobs_[job].folder.substr(0, jobs_[job].folder.find('/'));
        figures::RunOptions run_options{.threads = {options_.threads, &spare_}};
        run_options.shared = &shared_;
        run_options.monitor.stopped = [this] {
            return failed_ || (monitor_.stopped && monitor_.stopped());
        };
        run_options.monitor.progress = [&](double fraction, const std::string& what) {
            report(job, fraction, name.empty() ? what : name + ": " + what);
        };
        run_options.monitor.report(0, name);
        const report::Stopwatch running;
        Done done;
        figures::FigureResult result =
            options_.run ? options_.run(file, run_options) : figures::run_figure(file, run_options);
        done.run_s = running.seconds();
        // Pictures and charts are made one figure at a time, because the renderer uses all threads.
        const std::lock_guard<std::mutex> lock(writing_);
        const report::Stopwatch writing;
        done.shown = write_results(jobs_[job], std::move(result), top, options_.charts);
        done.write_s = writing.seconds();
        report(job, 1, name);
        return done;
    }

    void report(std::size_t job, double fraction, const std::string& what) {
        const std::lock_guard<std::mutex> lock(telling_);
        fractions_[job] = std::max(fractions_[job], fraction);
        double done_s = 0, total_s = 0;
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            done_s += fractions_[i] * expected_s(jobs_[i]);
            total_s += expected_s(jobs_[i]);
        }
        if (monitor_.progress) monitor_.progress(done_s / total_s, what);
    }

    const FigureOptions& options_;
    const ProgressMonitor& monitor_;
    const std::vector<Job>& jobs_;
    std::vector<double> fractions_;  ///< finished fraction of each job
    SpareThreads spare_;
    figures::SharedRuns shared_;
    std::atomic<bool> failed_{false};
    std::mutex telling_, writing_;
};

}  // namespace

std::vector<FigureEntry> list_figures(const fs::path& from) {
    const fs::path folder = folder_of_figures(from);
    const auto present = [&](const std::string& id) {
        return fs::exists(folder / id / kExperimentFile);
    };
    std::vector<FigureEntry> list;
    std::set<std::string> others;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            if (const std::string id = entry.path().filename().string(); present(id))
                others.insert(id);
    for (const figures::Figure& figure : figures::figures())
        if (others.erase(std::string(figure.id)) > 0)
            list.push_back({.id = std::string(figure.id),
                            .title = std::string(figure.title),
                            .run_time_s = figure.run_time_s});
    for (const std::string& id : others) {
        const JsonCursor file = JsonCursor::read_file(folder / id / kExperimentFile);
        const auto title = file.find("title");
        list.push_back({.id = id, .title = title ? title->string() : id, .run_time_s = 0});
    }
    if (list.empty()) throw Error(folder.string(), "folders with an experiment.json", "none");
    return list;
}

FigureReport run_figures(const FigureOptions& options, const ProgressMonitor& monitor) {
    // Reads the request and rejects it before anything is run.
    const std::vector<Job> jobs = jobs_of(options);
    for (const Job& job : jobs) {
        const JsonCursor file = JsonCursor::read_file(job.file);
        if (!options.run) figures::check_experiment(file);
    }
    report::AtomicFolder staged(options.out);

    // Runs each figure.
    const report::Stopwatch total;
    Json timing =
        json_object({{"format", "risorius-timing"}, {"version", 1}, {"figures", Json::array()}});
    std::vector<ShownFigure> figures;
    for (Run::Done& done : Run(options, monitor, jobs).all(staged.partial())) {
        timing["figures"].push_back(json_object(
            {{"id", done.shown.result.id}, {"run_s", done.run_s}, {"write_s", done.write_s}}));
        figures.push_back(std::move(done.shown));
    }

    // Writes the common files.
    FigureReport report;
    const bool together = is_several(options);
    for (const ShownFigure& figure : figures) {
        for (const std::string& what : failures_of(figure.result))
            report.failed.push_back({figure.result.id, what});
        const fs::path folder = staged.partial() / figure.folder;
        Json json = figure_json(figure.result);
        std::set<std::string> to_come{"results.json"};
        if (!together) to_come.insert({"index.html", "timing.json"});
        json[report::kFilesKey] = listing(folder, to_come);
        write_json(folder / "results.json", json);
        report.results = json;
    }
    report::write_text(staged.partial() / "index.html", figure_page(figures));
    if (together) {
        report.results = results_of_all(figures);
        report.results[report::kFilesKey] =
            listing(staged.partial(), {"results.json", "timing.json"});
        write_json(staged.partial() / "results.json", report.results);
    }
    timing["total_s"] = total.seconds();
    write_json(staged.partial() / "timing.json", timing);
    monitor.report(1, "written");
    staged.commit();
    return report;
}

}  // namespace risorius::figures
