// SPDX-License-Identifier: MIT
#include "risorius/inverse/solve_activations.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/parallel.h"
#include "risorius/face/face.h"
#include "risorius/face/statics.h"
#include "risorius/inverse/detail/fit_target.h"
#include "risorius/inverse/detail/landmark_target.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/expression_score.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"

namespace risorius::inverse {

namespace fs = std::filesystem;

namespace {

using track::Kinematic;

constexpr double kPressure_pa = 3000;           // maximum pressure in the mouth
constexpr double kRamp_s = 0.3, kHold_s = 0.4;  // for each shape, when shapes are shown in turn
constexpr int kShapeFps = 30;
constexpr int kShapeRounds = 16, kFrameRounds = 4;
constexpr int kIterations = 400;  // iterations per pose
// Displacement per iteration that counts as equilibrium; landmarks need it to be small
constexpr double kTolerance_m = 5e-6;

track::Drive nothing(const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    return drive;
}

void add_channel(std::vector<ActivationUnknown>& unknowns, Kinematic which, double max) {
    const track::KinematicChannel& range =
        track::kinematic_channels()[static_cast<std::size_t>(which)];
    const double scale = std::min(max, range.max);
    unknowns.push_back({.name = std::string(range.name),
                        .columns = {},
                        .channels = {which},
                        .min = std::max(range.min / scale, -1.0),
                        .max = 1,
                        .scale = scale});
}

// Unknowns of muscles and jaw; of mouth pressure; of gaze and tongue if their parts have weight.
std::vector<ActivationUnknown> unknowns_of(const scene::RigFiles& files, const rig::Head& head,
                                           const Eigen::VectorXd& weight) {
    std::vector<ActivationUnknown> out =
        activation_unknowns(files.rig, nothing(files.rig.channels()), true);
    add_channel(out, Kinematic::kMouthPressure, kPressure_pa);
    out.back().min = 0;
    const auto counted = [&](rig::Carrier part) {
        for (long v = 0; v < weight.size(); ++v)
            if (head.carrier[static_cast<std::size_t>(v)] == part && weight[v] > 0) return true;
        return false;
    };
    if (counted(rig::Carrier::kEyeLeft)) {
        add_channel(out, Kinematic::kGazeYawLeft, 35);
        add_channel(out, Kinematic::kGazePitchLeft, 35);
    }
    if (counted(rig::Carrier::kEyeRight)) {
        add_channel(out, Kinematic::kGazeYawRight, 35);
        add_channel(out, Kinematic::kGazePitchRight, 35);
    }
    if (counted(rig::Carrier::kTongue)) {
        add_channel(out, Kinematic::kTongueOut, 1);
        add_channel(out, Kinematic::kTongueUp, 1);
    }
    return out;
}

Eigen::VectorXd values_of(const std::vector<ActivationUnknown>& unknowns,
                          const track::Drive& drive) {
    Eigen::VectorXd out(static_cast<long>(unknowns.size()));
    for (std::size_t i = 0; i < unknowns.size(); ++i)
        out[static_cast<long>(i)] = value_of(unknowns[i], drive);
    return out;
}

double squares(const Points& field, const Eigen::VectorXd& weight) {
    return weight.dot(field.rowwise().squaredNorm());
}

void measure(const face::Face& face, const Points& given, const Eigen::VectorXd& weight,
             SolvedDrive& out) {
    const Points miss = face.pose().vertices - face.head().vertices - given;
    const double whole = weight.sum();
    out.rms_m = std::sqrt(squares(miss, weight) / whole);
    out.given_rms_m = std::sqrt(squares(given, weight) / whole);
    out.max_m = 0;
    for (long v = 0; v < weight.size(); ++v)
        if (weight[v] > 0) out.max_m = std::max(out.max_m, miss.row(v).norm());
    out.highest = out.drive.excitation.cwiseAbs().maxCoeff();
}

face::StaticOptions accurate(const ProgressMonitor& monitor) {
    return {.iterations = kIterations,
            .tolerance_m = kTolerance_m,
            .planes_m = kTolerance_m,
            .stopped = monitor.stopped};
}

class Solver {
  public:
    Solver(const SolveOptions& options, const scene::RigFiles& files, const FitTarget& given,
           const std::vector<ActivationUnknown>& unknowns)
        : options_(options), files_(files), given_(given), unknowns_(unknowns) {}

    std::vector<SolvedDrive> shapes(const ProgressMonitor& monitor) const {
        std::vector<SolvedDrive> out(given_.fields.size());
        std::mutex telling;
        std::size_t done = 0;
        SpareThreads spare(ThreadLimit(options_.threads).count() - 1);
        parallel_for(static_cast<int>(out.size()), {options_.threads, &spare}, [&](int i) {
            monitor.throw_if_stopped();
            const std::unique_ptr<face::Face> face = at_rest();
            SolvedDrive& one = out[static_cast<std::size_t>(i)];
            ActivationFitOptions fit = usual(kShapeRounds, monitor);
            seek(*face, static_cast<std::size_t>(i), nothing(files_.rig.channels()), fit, one);
            const std::lock_guard<std::mutex> lock(telling);
            monitor.report(static_cast<double>(++done) / static_cast<double>(out.size()), one.name);
        });
        return out;
    }

    std::vector<SolvedDrive> sequence(const ProgressMonitor& monitor) const {
        std::vector<SolvedDrive> out(given_.fields.size());
        const std::unique_ptr<face::Face> face = at_rest();
        ActivationFitOptions fit = usual(kFrameRounds, monitor);
        for (std::size_t t = 0; t < out.size(); ++t)
            fit.size = std::max(fit.size, squares(given_.fields[t], weight_of(t)));
        if (!(fit.size > 0))
            throw Error(options_.landmarks.string(), "landmarks that move", "none that does");
        track::Drive last = nothing(files_.rig.channels());
        fit.keep = options_.temporal_weight;
        for (std::size_t t = 0; t < out.size(); ++t) {
            monitor.report(0.6 * static_cast<double>(t) / static_cast<double>(out.size()),
                           given_.names[t]);
            fit.near = values_of(unknowns_, last);
            seek(*face, t, last, fit, out[t]);
            last = out[t].drive;
        }
        // Keep the solution near both neighbours.
        fit.keep = 2 * options_.temporal_weight;
        fit.rounds = 1;
        for (std::size_t t = out.size(); t-- > 0;) {
            monitor.report(1 - 0.4 * static_cast<double>(t + 1) / static_cast<double>(out.size()),
                           given_.names[t]);
            if (t == 0 || t + 1 == out.size()) continue;
            fit.near = 0.5 * (values_of(unknowns_, out[t - 1].drive) +
                              values_of(unknowns_, out[t + 1].drive));
            seek(*face, t, out[t].drive, fit, out[t]);
        }
        return out;
    }

  private:
    ActivationFitOptions usual(int rounds, const ProgressMonitor& monitor) const {
        ActivationFitOptions fit;
        fit.rounds = rounds;
        fit.l1_weight = options_.l1_weight;
        fit.l2_weight = options_.l2_weight;
        fit.min_gain = 3e-3;
        fit.rest = accurate(monitor);
        return fit;
    }
    std::unique_ptr<face::Face> at_rest() const {
        auto face = std::make_unique<face::Face>(
            files_.rig, files_.mesh, face::quality_named(options_.quality), files_.place());
        const track::Drive rest = nothing(files_.rig.channels());
        face->start([&](double) { return rest; });
        return face;
    }
    void seek(face::Face& face, std::size_t i, const track::Drive& begin,
              const ActivationFitOptions& fit, SolvedDrive& out) const {
        out.name = given_.names[i];
        if (!given_.times_s.empty()) out.time_s = given_.times_s[i];
        out.drive = begin;
        const Eigen::VectorXd weight = weight_of(i);
        if (weight.sum() > 0 && (squares(given_.fields[i], weight) > 0 || fit.size > 0))
            out.drive = fit_activations(face, unknowns_, given_.fields[i], weight, begin, fit);
        measure(face, given_.fields[i], weight.sum() > 0 ? weight : given_.weight, out);
    }
    /// Of the vertices in a shape or frame.
    Eigen::VectorXd weight_of(std::size_t i) const {
        if (given_.sure.empty()) return given_.weight;
        return given_.weight.cwiseProduct(given_.sure[i]);
    }

    const SolveOptions& options_;
    const scene::RigFiles& files_;
    const FitTarget& given_;
    const std::vector<ActivationUnknown>& unknowns_;
};

// The curves of units. Recorded motion must not lag, so that they set activations.
Json channels_of(const std::vector<UnitCurve>& curves) {
    Json out = Json::object();
    for (const UnitCurve& curve : curves) {
        Json keys = Json::array();
        for (const track::Key& key : curve.keys)
            keys.push_back({std::round(1e6 * key.time_s) / 1e6, std::round(1e4 * key.value) / 1e4});
        out[curve.channel] =
            json_object({{"keys", keys}, {"interpolation", "smooth"}, {"activation", true}});
    }
    return out;
}

// A script of every shape in turn, or of the frames of the sequence; activations are set directly.
Json script_of(const SolveReport& report, const SolveOptions& options) {
    const double each_s = 2 * kRamp_s + kHold_s;
    const double duration_s = report.sequence ? report.solved.back().time_s + 1.0 / options.fps
                                              : each_s * static_cast<double>(report.solved.size());
    Json channels = Json::object();
    const auto add = [&](const std::string& name, bool muscle, auto&& value) {
        bool used = false;
        for (const SolvedDrive& one : report.solved) used = used || value(one.drive) != 0;
        if (!used) return;
        Json keys = Json::array();
        const auto key = [&](double t_s, double v) {
            keys.push_back({std::round(1e6 * t_s) / 1e6, std::round(1e6 * v) / 1e6});
        };
        for (std::size_t i = 0; i < report.solved.size(); ++i) {
            const double v = value(report.solved[i].drive);
            if (report.sequence) {
                key(report.solved[i].time_s, v);
                continue;
            }
            const double from_s = each_s * static_cast<double>(i);
            if (i == 0) key(from_s, 0);
            key(from_s + kRamp_s, v);
            key(from_s + kRamp_s + kHold_s, v);
            key(from_s + each_s, 0);
        }
        Json channel = json_object({{"keys", keys}, {"interpolation", "linear"}});
        if (muscle) channel["activation"] = true;
        channels[name] = channel;
    };
    const std::vector<std::string> columns = report.channels.column_names();
    for (std::size_t c = 0; c < columns.size(); ++c)
        add(columns[c], true,
            [c](const track::Drive& drive) { return drive.excitation[static_cast<long>(c)]; });
    for (int k = 0; k < track::kKinematicCount; ++k)
        add(std::string(track::kinematic_channels()[static_cast<std::size_t>(k)].name), false,
            [k](const track::Drive& drive) { return drive.at(static_cast<Kinematic>(k)); });
    if (!report.curves.empty()) channels = channels_of(report.curves);
    return json_object(
        {{"format", "risorius-script"},
         {"version", 1},
         {"rig", fs::absolute(options.rig)
                     .lexically_normal()
                     .lexically_proximate(fs::absolute(options.out).lexically_normal())
                     .generic_string()},
         {"fps", report.sequence ? options.fps : kShapeFps},
         {"duration_s", duration_s},
         {"seed", 1},
         {"motion", "quasi_static"},
         {"channels", channels}});
}

// Whether units are sought; checks the options that say so.
bool solves_units(const SolveOptions& options) {
    const bool sequence = !options.landmarks.empty();
    if (!options.as.empty()) index_of_name(option_name("as"), options.as, {"units", "muscles"});
    for (const std::string& one : options.with)
        index_of_name(option_name("with"), one, {"pressure", "tongue"});
    const bool out = options.as.empty() ? sequence : options.as == "units";
    if (out && !sequence)
        throw Error(option_name("as"), "\"muscles\" for shapes, or " + option_name("landmarks"),
                    "\"units\"");
    if (!out && !options.with.empty())
        throw Error(option_name("with"), option_name("as") + " \"units\"", "\"muscles\"");
    return out;
}

LandmarkOptions landmark_options(const SolveOptions& options) {
    return {.fps = options.fps, .neutral_s = options.neutral_s, .picture_px = options.picture_px};
}

/// Every landmark of the rig by the vertex that it rides on, and the largest motion of each by any of the ways.
std::vector<double> largest_motions(const scene::LandmarkPoints& points,
                                    const std::vector<int>& vertices, const Eigen::MatrixXd& ways) {
    std::vector<double> out;
    for (const std::string& id : points.ids()) {
        const auto row = std::find(vertices.begin(), vertices.end(), points.vertex(id));
        const long first = 3 * (row - vertices.begin());
        out.push_back(ways.middleRows<3>(first).colwise().norm().maxCoeff());
    }
    return out;
}

/// Solves landmarks over time as units.
FitTarget solve_as_units(face::FaceTeam& team, const scene::RigFiles& files,
                         const SolveOptions& options, const ProgressMonitor& monitor,
                         SolveReport& report) {
    const auto with = [&](const char* what) {
        return std::find(options.with.begin(), options.with.end(), what) != options.with.end();
    };
    const rig::Head& head = team.first().head();
    const UnitSources sources(files, with("pressure"), with("tongue"));
    const scene::LandmarkPoints points(head, files.rig);
    std::vector<int> vertices;
    for (const std::string& id : points.ids()) vertices.push_back(points.vertex(id));
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const UnitBench bench(team, sources, vertices);
    std::vector<KnownUnits> known;
    const auto max_m = [&] {
        known = bench.known(files, options.quality, monitor.subrange(0, 0.3));
        return largest_motions(points, vertices, known[0].state.way);
    };
    const FitTarget given =
        given_landmarks(options.landmarks, landmark_options(options), points, max_m, head.vertices);
    UnitSolution found = solve_units(bench, given, std::move(known), {}, monitor.subrange(0.3, 1));
    if (found.curves.empty())
        throw Error(options.landmarks.string(), "landmarks that move as an action unit does",
                    "none that does");
    for (std::size_t t = 0; t < given.fields.size(); ++t) {
        SolvedDrive& one = report.solved.emplace_back();
        one.name = given.names[t];
        one.time_s = given.times_s[t];
        one.drive = std::move(found.drives[t]);
        one.rms_m = found.rms_m[t];
        one.max_m = found.max_m[t];
        one.given_rms_m = std::sqrt(squares(given.fields[t], given.weight) / given.weight.sum());
        one.highest = one.drive.excitation.cwiseAbs().maxCoeff();
        one.simulated = found.simulated[t];
    }
    report.curves = std::move(found.curves);
    return given;
}

/// Reads landmarks for a search for muscles.
FitTarget landmarks_for_muscles(face::Face& face, const scene::RigFiles& files,
                                const SolveOptions& options) {
    const scene::LandmarkPoints points(face.head(), files.rig);
    // Largest displacement of each landmark by any of the unknowns
    const auto max_m = [&] {
        const track::Drive rest = nothing(files.rig.channels());
        face.start([&](double) { return rest; });
        face.solve_equilibrium(rest.excitation, rest);
        std::vector<int> columns;
        for (const ActivationUnknown& unknown : activation_unknowns(files.rig, rest, true))
            columns.insert(columns.end(), unknown.columns.begin(), unknown.columns.end());
        const std::vector<Points> ways =
            face.statics().sensitivities(columns, std::array{Kinematic::kJawOpen});
        std::vector<double> out;
        for (const std::string& id : points.ids()) {
            double max = 0;
            for (const Points& way : ways) max = std::max(max, way.row(points.vertex(id)).norm());
            out.push_back(max);
        }
        return out;
    };
    FitTarget given = given_landmarks(options.landmarks, landmark_options(options), points, max_m,
                                      face.head().vertices);
    if (given.flat)
        throw Error(options.landmarks.string(),
                    "points with a depth, or " + option_name("as") + " \"units\"",
                    "points without one");
    return given;
}

}  // namespace

double SolveReport::rms_m() const {
    double sum = 0;
    for (const SolvedDrive& one : solved) sum += one.rms_m * one.rms_m;
    return solved.empty() ? 0 : std::sqrt(sum / static_cast<double>(solved.size()));
}

Json SolveReport::json() const {
    Json list = Json::array();
    for (const SolvedDrive& one : solved) {
        Json entry = json_object({{"name", one.name}});
        if (sequence) entry["time_s"] = one.time_s;
        if (!curves.empty()) entry["simulated"] = one.simulated;
        entry["rms_mm"] = 1e3 * one.rms_m;
        entry["max_mm"] = 1e3 * one.max_m;
        entry["given_rms_mm"] = 1e3 * one.given_rms_m;
        entry["drive"] = rig::drive_json(one.drive, channels);
        list.push_back(entry);
    }
    Json json = json_object({{"format", "risorius-solve"},
                             {"version", 1},
                             {"name", name},
                             {"rig", rig},
                             {"given", given},
                             {"kind", sequence ? "frames" : "shapes"},
                             {"points", points},
                             {"rms_mm", 1e3 * rms_m()},
                             {"solved", list}});
    for (const UnitCurve& curve : curves) json["curves"][curve.channel] = curve.keys.size();
    if (!set.empty()) json["set"] = set;
    if (sitter_scale) json["sitter_scale"] = *sitter_scale;
    if (!notes.empty()) json["notes"] = notes;
    return json;
}

SolveReport solve_activations(const SolveOptions& options, const ProgressMonitor& monitor) {
    const int kinds =
        !options.shapes.empty() + !options.meshes.empty() + !options.landmarks.empty();
    if (kinds != 1)
        throw Error("solve",
                    "one of " + option_name("shapes") + ", " + option_name("mesh") + " and " +
                        option_name("landmarks"),
                    kinds == 0 ? "none" : std::to_string(kinds));
    if (!options.only.empty() && options.shapes.empty())
        throw Error(option_name("only"), option_name("shapes") + " to choose from", "none");
    for (const auto& [name, value] :
         {std::pair{option_name("l1_weight"), options.l1_weight},
          std::pair{option_name("l2_weight"), options.l2_weight},
          std::pair{option_name("temporal_weight"), options.temporal_weight}})
        if (!(value >= 0 && value <= 1e3))
            throw Error(name, "a number in [0, 1000]", format_number(value));
    if (options.landmarks.empty() && (options.neutral_s || options.picture_px[0] > 0))
        throw Error(option_name(options.neutral_s ? "neutral" : "picture"),
                    option_name("landmarks") + ", which it is about", "none");
    if (options.fps < 1 || options.fps > 240)
        throw Error(option_name("fps"), "an integer in [1, 240]", std::to_string(options.fps));
    const bool as_units = solves_units(options);
    const scene::RigFiles files = scene::read_rig_files(options.rig, monitor.stopped);
    report::AtomicFolder folder(options.out);
    monitor.report(0, "building the face");
    const auto build = [&] {
        return face::Face(files.rig, files.mesh, face::quality_named(options.quality),
                          files.place());
    };
    // A search for units simulates two faces at once; they are built at once, too.
    const bool two = as_units && ThreadLimit(options.threads).count() > 1;
    std::array<std::optional<face::Face>, 2> built;
    parallel_for(two ? 2 : 1, options.threads,
                 [&](int i) { built[static_cast<std::size_t>(i)].emplace(build()); });
    face::Face& face = *built[0];
    SolveReport report;
    FitTarget given;
    if (as_units) {
        std::atomic<bool> taken = !two;
        const auto next = [&] { return taken.exchange(true) ? build() : std::move(*built[1]); };
        face::FaceTeam team(face, next, options.threads);
        given = solve_as_units(team, files, options, monitor, report);
    } else if (!options.landmarks.empty()) {
        given = landmarks_for_muscles(face, files, options);
    } else {
        given = options.meshes.empty() ? given_shapes(options.shapes, options.only, files, face)
                                       : given_meshes(options.meshes, files, face, monitor.stopped);
    }
    report.name = files.rig.name;
    report.rig = options.rig.generic_string();
    report.given = (!options.shapes.empty()   ? options.shapes
                    : !options.meshes.empty() ? options.meshes.front()
                                              : options.landmarks)
                       .generic_string();
    report.sequence = !options.landmarks.empty();
    report.points = static_cast<int>((given.weight.array() > 0).count());
    report.channels = files.rig.channels();
    report.notes = given.notes;
    report.set = given.set;
    if (!given.set.empty() && given.set != "rig") report.sitter_scale = given.sitter_scale;
    if (!as_units) {
        const std::vector<ActivationUnknown> unknowns =
            unknowns_of(files, face.head(), given.weight);
        const Solver solver(options, files, given, unknowns);
        report.solved = report.sequence ? solver.sequence(monitor) : solver.shapes(monitor);
    }

    report::write_text(folder.partial() / "script.json",
                       json_text(script_of(report, options), 1) + "\n");
    Json json = report.json();
    json[report::kFilesKey] = {"results.json", "script.json"};
    report::write_text(folder.partial() / "results.json", json_text(json, 2) + "\n");
    monitor.throw_if_stopped();
    folder.commit();
    return report;
}

}  // namespace risorius::inverse
