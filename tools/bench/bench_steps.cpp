// SPDX-License-Identifier: MIT
#include "tools/bench/bench_steps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>
#include <utility>

#include "risorius/core/json_object.h"
#include "risorius/face/diagnostics.h"
#include "risorius/report/median.h"
#include "risorius/report/stopwatch.h"
#include "risorius/track/timeline.h"

namespace risorius::bench {

namespace {

constexpr double kTurn = 2 * 3.14159265358979323846;
constexpr double kPose_s = 0.5, kSwitch_s = 0.02, kJaw_hz = 2;
constexpr int kPoses = 4;
// An iteration of a converged step moves the nodes by less than 0.02 micrometres RMS, far below any reported error.
constexpr double kConverged_m = 2e-8;
constexpr int kConvergedIterations = 800;
constexpr int kTimesPlayed = 3;

// Keys of a unit that is active in one of the poses.
Json pose_keys(int pose, double value) {
    Json keys = Json::array();
    if (pose > 0) keys.push_back({0.0, 0.0});
    for (double on = pose * kPose_s; on < kStepTrack_s; on += kPoses * kPose_s) {
        keys.push_back({on, 0.0});
        keys.push_back({on + kSwitch_s, value});
        keys.push_back({on + kPose_s, value});
        if (on + kPose_s + kSwitch_s < kStepTrack_s)
            keys.push_back({on + kPose_s + kSwitch_s, 0.0});
    }
    return json_object({{"keys", keys}, {"interpolation", "linear"}});
}

// The jaw opens to 3/4 in its own pose and to 1/4 in the others.
Json jaw_keys() {
    Json keys = Json::array();
    for (int k = 0; k <= static_cast<int>(std::lround(kStepTrack_s * 30)); ++k) {
        const double t = k / 30.0;
        const bool own = static_cast<int>(t / kPose_s + 1e-9) % kPoses == 2;
        keys.push_back({t, (own ? 0.375 : 0.125) * (1 - std::cos(kTurn * kJaw_hz * t))});
    }
    return json_object({{"keys", keys}});
}

using SkinTrack = std::vector<Points>;  // positions of the skin nodes after each step

struct StepRun {
    SkinTrack skin;
    std::vector<double> step_ms;
    int nodes = 0, tets = 0;
    int max_inverted_tets = 0;
    double iterations = 0;  // mean
};

StepRun play(const scene::RigFiles& files, const face::DriveAt& drive, const StepBench& one,
             const ProgressMonitor& monitor) {
    face::Face face(files.rig, files.mesh, one.quality, files.place());
    face.start(drive);
    StepRun out;
    out.nodes = face.diagnostics().node_count();
    out.tets = face.diagnostics().tet_count();
    for (int step = 0; step < one.steps; ++step) {
        if (step % 20 == 0)
            monitor.report(static_cast<double>(step) / one.steps, "steps, " + one.quality.name);
        const report::CoreStopwatch stopwatch;
        out.iterations += face.step(drive).iterations / static_cast<double>(one.steps);
        out.step_ms.push_back(1e3 * stopwatch.seconds());
        out.skin.push_back(face.diagnostics().skin_nodes());
        out.max_inverted_tets = std::max(out.max_inverted_tets, face.diagnostics().inverted_tets());
    }
    return out;
}

}  // namespace

track::ScriptDescription step_track(const scene::RigFiles& files) {
    Json blinks = Json::array();
    for (const double t : {0.7, 2.2, 3.3})
        blinks.push_back(json_object({{"blink", Json::object()}, {"start_s", t}}));
    const Json script = json_object({{"format", "risorius-script"},
                                     {"version", 1},
                                     {"rig", files.place()},
                                     {"fps", 60},
                                     {"duration_s", kStepTrack_s},
                                     {"seed", 1},
                                     {"channels", json_object({{"AU12", pose_keys(0, 1.0)},
                                                               {"AU6", pose_keys(0, 0.7)},
                                                               {"AU9", pose_keys(1, 1.0)},
                                                               {"AU10", pose_keys(1, 0.7)},
                                                               {"AU25", pose_keys(2, 0.6)},
                                                               {"AU18", pose_keys(3, 1.0)},
                                                               {"jaw_open", jaw_keys()}})},
                                     {"events", blinks}});
    return track::read_script(JsonCursor::from_json(script, "bench"), files.rig.channels(),
                              files.rig.facs, files.rig.expressions);
}

face::Quality preview_with(int skin_vertices) {
    face::Quality quality = face::quality_named("preview");
    quality.shell_vertices = skin_vertices;
    return quality;
}

std::vector<StepBench> usual_step_benches() {
    std::vector<StepBench> out;
    for (const char* name : {"preview", "video", "fine"})
        out.push_back({face::quality_named(name)});
    for (const int vertices : {1700, 3300}) {
        face::Quality quality = preview_with(vertices);
        quality.name += ", " + std::to_string(vertices) + " skin nodes";
        out.push_back({quality, vertices < 2000 ? 240 : 60});
    }
    for (const int vertices : {3300, 6600}) {
        face::Quality quality = face::quality_named("fine");
        quality.name = std::to_string(vertices) + " skin nodes";
        quality.shell_vertices = vertices;
        out.push_back({quality, 60});
    }
    return out;
}

Json bench_steps(const scene::RigFiles& files, const std::vector<StepBench>& cases,
                 const ProgressMonitor& monitor) {
    const track::Timeline timeline(step_track(files), files.rig.channels());
    const face::DriveAt drive = [&](double t_s) { return timeline.at(t_s); };
    // Key: size of the shell, number of steps and length of a substep
    std::map<std::tuple<int, int, double>, SkinTrack> converged;
    const auto key = [](const StepBench& one) {
        return std::tuple(one.quality.shell_vertices, one.steps, one.quality.max_substep_s);
    };
    for (const StepBench& one : cases) {
        if (converged.contains(key(one))) continue;
        face::Quality exact = one.quality;
        exact.name = "converged";
        exact.iterations = kConvergedIterations;
        exact.tolerance_rms_m = kConverged_m;
        exact.precision = solve::Precision::kDouble;
        converged[key(one)] = play(files, drive, {exact, one.steps}, monitor).skin;
    }

    // Every case runs once before any is repeated, because a shared machine can be slow for seconds.
    std::vector<StepRun> runs(cases.size());
    std::vector<std::vector<double>> min_ms(cases.size());
    for (int time = 0; time < kTimesPlayed; ++time)
        for (std::size_t i = 0; i < cases.size(); ++i) {
            StepRun run = play(files, drive, cases[i], monitor);
            if (time == 0) {
                min_ms[i] = run.step_ms;
                runs[i] = std::move(run);
                continue;
            }
            for (std::size_t step = 0; step < run.step_ms.size(); ++step)
                min_ms[i][step] = std::min(min_ms[i][step], run.step_ms[step]);
            runs[i].step_ms.insert(runs[i].step_ms.end(), run.step_ms.begin(), run.step_ms.end());
        }

    Json out = Json::array();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const StepRun& run = runs[i];
        const SkinTrack& exact = converged[key(cases[i])];
        double squares = 0, largest = 0;
        long count = 0;
        for (std::size_t step = 0; step < run.skin.size(); ++step) {
            const Points off = run.skin[step] - exact[step];
            squares += off.squaredNorm();
            largest = std::max(largest, off.rowwise().norm().maxCoeff());
            count += off.rows();
        }
        out.push_back(json_object(
            {{"quality", cases[i].quality.name},
             {"nodes", run.nodes},
             {"tets", run.tets},
             {"most_inverted_tets", run.max_inverted_tets},
             {"steps", cases[i].steps},
             {"iterations", run.iterations},
             {"step_ms", report::median(run.step_ms)},
             {"least_step_ms", report::median(min_ms[i])},
             {"mean_step_ms", std::accumulate(run.step_ms.begin(), run.step_ms.end(), 0.0) /
                                  static_cast<double>(run.step_ms.size())},
             {"rms_mm", 1e3 * std::sqrt(squares / static_cast<double>(count))},
             {"largest_mm", 1e3 * largest}}));
    }
    return out;
}

}  // namespace risorius::bench
