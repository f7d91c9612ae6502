// SPDX-License-Identifier: MIT
#include "tools/bench/bench_machine.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "risorius/animate/animate.h"
#include "risorius/core/data_folder.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/text_lines.h"
#include "risorius/core/version.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/solver/stress.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/median.h"
#include "risorius/report/stopwatch.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/timeline.h"
#include "tools/bench/bench_growth.h"
#include "tools/bench/bench_pictures.h"
#include "tools/bench/bench_poses.h"
#include "tools/bench/bench_shapes.h"
#include "tools/bench/bench_solids.h"
#include "tools/bench/bench_steps.h"

namespace risorius::bench {

namespace fs = std::filesystem;

namespace {

constexpr double kTrack_s = 4.0;

// A smile, raised brows, a blink, an open jaw and a frown: everything that is slow in a face.
Json bench_script(const std::string& rig, double duration_s) {
    return Json::parse(R"({
        "format": "risorius-script", "version": 1, "rig": ")" +
                       json_text(rig).substr(1, json_text(rig).size() - 2) + R"(",
        "fps": 60, "duration_s": )" +
                       format_number(duration_s) + R"(, "seed": 1,
        "channels": {
            "AU12": {"keys": [[0.0, 0], [0.4, 0.9], [0.8, 0.9], [1.2, 0]]},
            "AU6": {"keys": [[0.0, 0], [0.4, 0.7], [0.8, 0.7], [1.2, 0]]},
            "AU1": {"keys": [[1.2, 0], [1.45, 0.8], [1.9, 0]]},
            "AU2": {"keys": [[1.2, 0], [1.45, 0.8], [1.9, 0]]},
            "AU25": {"keys": [[2.0, 0], [2.25, 0.6], [2.6, 0]]},
            "jaw_open": {"keys": [[2.0, 0], [2.3, 0.6], [2.7, 0]]},
            "AU4": {"keys": [[2.6, 0], [2.9, 0.8], [3.3, 0]]},
            "AU15": {"keys": [[2.6, 0], [2.9, 0.6], [3.3, 0]]},
            "AU18": {"keys": [[3.2, 0], [3.5, 0.8], [3.9, 0]]}
        },
        "events": [{"blink": {}, "start_s": 0.5}]
    })");
}

Json describe_machine() {
    std::string cpu = "unknown";
    const std::filesystem::path file = "/proc/cpuinfo";
    const std::string info =
        std::filesystem::exists(file) ? read_file(file, {"a list of processors", kMegabyte}) : "";
    for (TextLines lines(info); lines.next();)
        if (lines.line().starts_with("model name")) {
            const std::size_t colon = lines.line().find(": ");
            if (colon != std::string_view::npos) cpu = lines.line().substr(colon + 2);
            break;
        }
    return json_object({{"cpu", cpu}, {"cores", std::thread::hardware_concurrency()}});
}

double peak_memory_mb() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux reports kB
}

/// A temporary folder, removed with its contents.
class ScratchFolder {
  public:
    ScratchFolder()
        : path_(fs::temp_directory_path() / ("risorius-bench-" + std::to_string(::getpid()))) {
        fs::create_directories(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    fs::path operator/(const char* name) const { return path_ / name; }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

struct Bench {
    scene::RigFiles files;
    track::Timeline timeline;
    const ProgressMonitor& monitor;

    face::DriveAt drive() const {
        return [this](double t_s) { return timeline.at(t_s); };
    }

    // Simulates the whole track on one core.
    Json simulate(const std::string& quality) const {
        monitor.report(0, "simulating, " + quality);
        face::Face face(files.rig, files.mesh, face::quality_named(quality), files.place());
        face.start(drive());
        std::vector<double> step_ms;
        int iterations = 0;
        const int steps = static_cast<int>(kTrack_s / face::kStep_s);
        for (int step = 0; step < steps; ++step) {
            if (step % 20 == 0) monitor.report(0.3 * step / steps, "simulating, " + quality);
            const report::Stopwatch stopwatch;
            iterations += face.step(drive()).iterations;
            step_ms.push_back(1e3 * stopwatch.seconds());
        }
        return json_object({{"nodes", face.diagnostics().node_count()},
                            {"tets", face.diagnostics().tet_count()},
                            {"fibres", face.diagnostics().fibre_count()},
                            {"build_s", face.diagnostics().build_s()},
                            {"step_ms", report::median(step_ms)},
                            {"slowest_step_ms", *std::max_element(step_ms.begin(), step_ms.end())},
                            {"mean_iterations", static_cast<double>(iterations) / steps}});
    }

    // Simulates the same track with and without the standard volume muscles. Steps alternate, so that both run under the same
    // load.
    Json compare_solids() const {
        monitor.report(0.25, "volume muscles");
        rig::RigDescription bundles = files.rig, solids = files.rig;
        bundles.solids.clear();
        solids.solids = rig::read_solid_muscles(
            JsonCursor::read_file(data_folder() / "rigs/standard/muscle_solids.json"),
            files.rig.muscles);
        const rig::RigDescription* const rigs[2] = {&bundles, &solids};
        std::vector<face::Face> faces;
        std::array<std::vector<double>, 2> step_ms;
        std::array<int, 2> iterations{};
        double volume_error = 0;
        for (const rig::RigDescription* rig : rigs) {
            faces.emplace_back(*rig, files.mesh, face::quality_named("fine"), files.place());
            faces.back().start(drive());
        }
        const int steps = static_cast<int>(kTrack_s / face::kStep_s);
        for (int step = 0; step < steps; ++step)
            for (std::size_t k = 0; k < 2; ++k) {
                const report::Stopwatch stopwatch;
                const face::StepStats figures = faces[k].step(drive());
                step_ms[k].push_back(1e3 * stopwatch.seconds());
                iterations[k] += figures.iterations;
                volume_error = std::max(volume_error, figures.muscle_volume_error);
            }
        const double without = report::median(step_ms[0]), with = report::median(step_ms[1]);
        const auto sum = [](const std::vector<double>& ms) {
            return std::accumulate(ms.begin(), ms.end(), 0.0);
        };
        return json_object({{"volume_muscles", faces[1].diagnostics().solid_figures().size()},
                            {"nodes", faces[1].diagnostics().node_count()},
                            {"step_ms_without", without},
                            {"step_ms_with", with},
                            {"ratio", with / without},
                            {"ratio_of_means", sum(step_ms[1]) / sum(step_ms[0])},
                            {"mean_iterations_without", static_cast<double>(iterations[0]) / steps},
                            {"mean_iterations_with", static_cast<double>(iterations[1]) / steps},
                            {"largest_volume_error", volume_error}});
    }

    // One second from script to video
    Json whole_way(const ScratchFolder& scratch) const {
        monitor.report(0.7, "from script to video");
        animate::RenderRequest request;
        request.script = scratch / "script.json";
        report::write_text(request.script,
                           json_text(bench_script(fs::absolute(files.file).generic_string(), 1.0)));
        request.out = scratch / "video.mp4";
        request.threads = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
        ProgressMonitor inner = monitor;
        if (monitor.progress)
            inner.progress = [this](double fraction, const std::string&) {
                monitor.progress(0.7 + 0.3 * fraction, "from script to video");
            };
        const animate::RunRecord record = animate::animate(request, inner);
        return json_object({{"seconds_of_video", 1.0},
                            {"threads", request.threads},
                            {"total_s", record.timing.total_s},
                            {"build_s", record.timing.build_s},
                            {"simulate_s", record.timing.simulate_s},
                            {"draw_s", record.timing.draw_s},
                            {"encode_s", record.timing.encode_s},
                            {"real_time_factor", 1.0 / record.timing.total_s}});
    }
};

Json bench_rig(const fs::path& rig_file, const BenchOptions& options,
               const ProgressMonitor& monitor) {
    scene::RigFiles files = scene::read_rig_files(rig_file);
    const ScratchFolder scratch;
    if (options.only_steps)
        return json_object({{"rig", rig_file.generic_string()},
                            {"name", files.rig.name},
                            {"steps", bench_steps(files, usual_step_benches(), monitor)}});
    if (options.only_poses)
        return json_object({{"rig", rig_file.generic_string()},
                            {"name", files.rig.name},
                            {"poses", bench_poses(files, {}, monitor)}});
    if (options.only_shapes)
        return json_object({{"rig", rig_file.generic_string()},
                            {"name", files.rig.name},
                            {"blend_shapes", bench_shapes(files, options.shapes, monitor)}});
    if (options.only_pictures)
        return json_object({{"rig", rig_file.generic_string()},
                            {"name", files.rig.name},
                            {"pictures", bench_pictures(files, scratch.path(), monitor)},
                            {"peak_memory_mb", peak_memory_mb()}});
    const track::ChannelTable channels = files.rig.channels();
    const auto script = track::read_script(
        JsonCursor::from_json(bench_script(rig_file.generic_string(), kTrack_s), "bench"), channels,
        files.rig.facs, files.rig.expressions);
    const Bench bench{std::move(files), track::Timeline(script, channels), monitor};

    Json out;
    out["rig"] = rig_file.generic_string();
    out["name"] = bench.files.rig.name;
    out["vertices"] = bench.files.mesh.vertex_count();
    out["preview"] = bench.simulate("preview");
    out["video"] = bench.simulate("video");
    out["fine"] = bench.simulate("fine");
    if (options.tables) {
        out["fine_volume_muscles"] = bench.compare_solids();
        out["steps"] = bench_steps(bench.files, usual_step_benches(), monitor);
    }
    out["pictures"] = bench_pictures(bench.files, scratch.path(), monitor);
    out["blend_shapes"] = bench_shapes(bench.files, {}, monitor);
    out["whole_way"] = bench.whole_way(scratch);
    out["peak_memory_mb"] = peak_memory_mb();
    return out;
}

Json stress_rig(const fs::path& rig_file, const BenchOptions& options) {
    const scene::RigFiles files = scene::read_rig_files(rig_file);
    face::Face face(files.rig, files.mesh, face::quality_named(options.quality), files.place());
    const auto penetration = [](const face::Penetration& of) -> Json {
        return json_object({{"lips", 1e3 * of.lips_m},
                            {"bone", 1e3 * of.bone_m},
                            {"eyeball", 1e3 * of.eyeball_m}});
    };
    const report::Stopwatch stopwatch;
    const face::StressReport report = face::stress(
        face, files.rig.channels(), {.steps = options.stress_steps, .seed = options.seed});
    return json_object({{"rig", rig_file.generic_string()},
                        {"quality", options.quality},
                        {"seed", options.seed},
                        {"tets", face.diagnostics().tet_count()},
                        {"steps", report.steps},
                        {"broken_steps", report.broken_steps},
                        {"most_inverted_tets", report.max_inverted_tets},
                        {"mean_inverted_tets", report.mean_inverted_tets},
                        {"longest_inverted_steps", report.longest_inverted_steps},
                        {"furthest_mm", 1e3 * report.furthest_m},
                        {"usual_penetration_mm", penetration(report.usual_penetration)},
                        {"deepest_penetration_mm", penetration(report.deepest_penetration)},
                        {"inverted_at_rest", report.inverted_at_rest},
                        {"left_at_rest_mm", 1e3 * report.residual_displacement_m},
                        {"step_ms", 1e3 * stopwatch.seconds() / std::max(1, report.steps)}});
}

}  // namespace

Json bench_machine(const BenchOptions& options, const ProgressMonitor& monitor) {
    std::vector<fs::path> rigs = options.rigs;
    if (rigs.empty() && options.faces) rigs.push_back(data_folder() / "rigs/adult/rig.json");
    Json out;
    out["format"] = "risorius-bench";
    out["version"] = 1;
    out["toolkit"] = kVersion;
    out["machine"] = describe_machine();
    for (const fs::path& rig : rigs)
        scene::read_rig_files(rig);  // reports errors before measurements start

    if (options.stress_steps > 0) {
        out["stress"] = Json::array();
        for (std::size_t i = 0; i < rigs.size(); ++i) {
            monitor.report(static_cast<double>(i) / static_cast<double>(rigs.size()),
                           rigs[i].string() + ", random drive");
            out["stress"].push_back(stress_rig(rigs[i], options));
        }
        return out;
    }

    if (options.only_growth) {
        const ScratchFolder scratch;
        out["growth"] =
            bench_growth(scene::read_rig_files(rigs.front()), scratch.path(), {}, monitor);
        if (!options.growth_chart.empty()) draw_growth(out["growth"], options.growth_chart);
        return out;
    }

    // Solids take about as long as one rig. They come last because they raise the peak memory.
    const double parts = 1 + static_cast<double>(rigs.size());
    out["rigs"] = Json::array();
    for (std::size_t i = 0; i < rigs.size(); ++i) {
        ProgressMonitor one = monitor;
        if (monitor.progress)
            one.progress = [&, i](double fraction, const std::string& what) {
                monitor.progress((static_cast<double>(i) + fraction) / parts,
                                 rigs[i].string() + ", " + what);
            };
        out["rigs"].push_back(bench_rig(rigs[i], options, one));
    }
    out["solids"] = Json::array();
    if (options.only_steps || options.only_poses || options.only_pictures || options.only_shapes)
        return out;
    if (options.faces && !options.tables) return out;
    ProgressMonitor solids = monitor;
    if (monitor.progress)
        solids.progress = [&](double fraction, const std::string& what) {
            monitor.progress((parts - 1 + fraction) / parts, what);
        };
    out["solids"] = {bench_solids({}, solids),
                     bench_solids({.nodes_per_edge = {13, 22}, .psi_n_per_m5 = 10}, solids)};
    return out;
}

}  // namespace risorius::bench
