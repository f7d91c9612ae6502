#include "app/solve_activations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/expression_drive.h"
#include "app/expression_score.h"
#include "app/landmark_points.h"
#include "app/measured_shapes.h"
#include "app/rig_files.h"
#include "app/shape_player.h"
#include "app/staged_file.h"
#include "app/staged_folder.h"
#include "core/error.h"
#include "core/known_names.h"
#include "experiment/experiment_kind.h"
#include "experiment/spare_threads.h"
#include "io/read_mesh.h"
#include "signal/recording.h"
#include "sim/face.h"

namespace risorius::app {

namespace fs = std::filesystem;

namespace {

using track::Kinematic;

constexpr double kOtherParts = 0.2;    // weight of a vertex of eyes, teeth and tongue to the skin's
constexpr double kMoves_m = 1e-5;      // a part whose vertices all move less is not counted
constexpr double kPressure_pa = 3000;  // in the mouth, at most
constexpr double kOnTheSkull_m =
    1e-3;  // landmarks that no muscle moves further tell how the head is turned
constexpr double kRamp_s = 0.3, kHold_s = 0.4;  // of each shape, when they are shown in turn
constexpr int kShapeFps = 30;
constexpr int kShapeRounds = 16, kFrameRounds = 4;
constexpr int kIterations = 400;       // of a pose, and how exactly it is
constexpr double kTolerance_m = 5e-6;  // at rest: what landmarks are told to

/// What is to be met, over all shapes or frames the same points.
struct Given {
    std::vector<std::string> names;
    std::vector<double> times_s;  ///< of frames
    std::vector<Points> fields;   ///< V x 3 each, m, head frame
    Eigen::VectorXd weight;       ///< V
};

track::Drive nothing(const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    return drive;
}

// Skin by its area, and whatever else any of the shapes moves.
Eigen::VectorXd weights_of(const sim::Face& face, const std::vector<Points>& fields) {
    const rig::Head& head = face.head();
    Eigen::VectorXd weight = vertex_areas(face.simulated_skin(), head.vertices);
    const double mean = weight.sum() / static_cast<double>((weight.array() > 0).count());
    std::array<bool, 8> moves{};
    const auto part = [&](long v) {
        return static_cast<std::size_t>(head.carrier[static_cast<std::size_t>(v)]);
    };
    for (const Points& field : fields)
        for (long v = 0; v < field.rows(); ++v)
            if (field.row(v).norm() > kMoves_m) moves[part(v)] = true;
    for (long v = 0; v < weight.size(); ++v)
        if (head.carrier[static_cast<std::size_t>(v)] != rig::Carrier::kSkin &&
            head.carrier[static_cast<std::size_t>(v)] != rig::Carrier::kNone && moves[part(v)])
            weight[v] += kOtherParts * mean;
    return weight;
}

Given given_shapes(const SolveOptions& options, const RigFiles& files, const sim::Face& face) {
    const rig::Head& head = face.head();
    Given out;
    if (options.shapes.extension() == ".glb") {
        const ShapesOfFile shapes = read_shapes_of_file(options.shapes, files, head);
        std::vector<std::string> names;
        for (const ShapeGoal& goal : shapes.goals) names.push_back(goal.name);
        for (const std::string& name : options.only) index_of_name("--only", name, names);
        for (std::size_t s = 0; s < shapes.goals.size(); ++s) {
            const ShapeGoal& goal = shapes.goals[s];
            if (!options.only.empty() && std::find(options.only.begin(), options.only.end(),
                                                   goal.name) == options.only.end())
                continue;
            out.names.push_back(goal.name);
            Points& field =
                out.fields.emplace_back(shapes.rig.shapes[s].dense(head.vertices.rows()));
            if (goal.on_top_of >= 0)
                shapes.rig.shapes[static_cast<std::size_t>(goal.on_top_of)].add_to(field, 1);
        }
    } else {
        for (MeasuredShape& one : read_measured_shapes(
                 options.shapes, {.only = options.only, .apart = true}, files.rig, head)) {
            out.names.push_back(one.name);
            out.fields.push_back(std::move(one.displacement));
        }
    }
    out.weight = weights_of(face, out.fields);
    return out;
}

Given given_meshes(const SolveOptions& options, const RigFiles& files, const sim::Face& face) {
    const rig::Head& head = face.head();
    Given out;
    for (const fs::path& file : options.meshes) {
        const geom::PolygonMesh mesh = io::read_mesh(file);
        if (mesh.vertex_count() != files.mesh.vertex_count())
            throw Error(file.string(),
                        "the " + std::to_string(files.mesh.vertex_count()) +
                            " vertices of the rig's mesh, in its order",
                        std::to_string(mesh.vertex_count()));
        out.names.push_back(file.stem().string());
        out.fields.push_back((mesh.positions - files.mesh.positions) *
                             head.frame.rotation.transpose() * head.frame.metres_per_unit);
    }
    out.weight = weights_of(face, out.fields);
    return out;
}

// The turn and shift that bring `from` nearest to `to`, rows by pairs (Kabsch 1976).
Rigid nearest_motion(const Points& from, const Points& to) {
    return Rigid(Eigen::umeyama(from.transpose(), to.transpose(), false));
}

Given given_landmarks(const SolveOptions& options, const LandmarkPoints& points,
                      const std::vector<double>& most_m, long vertices) {
    const auto table = signal::Recording::read_file(options.landmarks);
    const std::string place = options.landmarks.string();
    const int time = table.find("time_s");
    if (time < 0) throw Error(place, "a column time_s", "none");
    const std::vector<double> times = table.samples(time);
    const std::vector<std::string> ids = points.ids();
    std::vector<std::size_t> known;
    std::vector<Points> rows(times.size());
    std::vector<std::array<std::vector<double>, 3>> numbers;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        std::array<int, 3> columns{};
        int found = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            columns[k] = table.find(ids[i] + "." + "xyz"[k] + "_mm");
            found += columns[k] >= 0;
        }
        if (found == 0) continue;
        if (found < 3)
            throw Error(place, "the columns " + ids[i] + ".x_mm, .y_mm and .z_mm",
                        "only some of them");
        known.push_back(i);
        auto& of = numbers.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) of[k] = table.samples(columns[k]);
    }
    if (known.size() < 4 || times.empty())
        throw Error(place, "rows of at least four landmarks, as prn.x_mm, prn.y_mm, prn.z_mm",
                    times.empty() ? "no rows" : std::to_string(known.size()) + " of them");
    for (std::size_t t = 0; t < times.size(); ++t) {
        if (t > 0 && times[t] <= times[t - 1])
            throw Error(place, "times that rise from row to row",
                        format_number(times[t]) + " s after " + format_number(times[t - 1]));
        rows[t].resize(static_cast<long>(known.size()), 3);
        for (std::size_t i = 0; i < known.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                rows[t](static_cast<long>(i), static_cast<long>(k)) = 1e-3 * numbers[i][k][t];
    }
    std::vector<long> on_skull;
    for (std::size_t i = 0; i < known.size(); ++i)
        if (most_m[known[i]] < kOnTheSkull_m) on_skull.push_back(static_cast<long>(i));
    Given out;
    out.weight = Eigen::VectorXd::Zero(vertices);
    for (const std::size_t i : known) out.weight[points.vertex(ids[i])] = 1;
    double next_s = times[0];
    for (std::size_t t = 0; t < times.size(); ++t) {
        if (times[t] < next_s - 1e-9) continue;
        next_s = std::max(next_s + 1.0 / options.fps, times[t]);
        Points moved = rows[t];
        if (on_skull.size() >= 3) {
            const Rigid back =
                nearest_motion(rows[t](on_skull, Eigen::all), rows[0](on_skull, Eigen::all));
            for (long i = 0; i < moved.rows(); ++i)
                moved.row(i) = (back * Vec3(moved.row(i).transpose())).transpose();
        }
        Points& field = out.fields.emplace_back(Points::Zero(vertices, 3));
        for (std::size_t i = 0; i < known.size(); ++i)
            field.row(points.vertex(ids[known[i]])) =
                moved.row(static_cast<long>(i)) - rows[0].row(static_cast<long>(i));
        out.times_s.push_back(times[t] - times[0]);
        out.names.push_back("frame " + std::to_string(t));
    }
    return out;
}

void add_channel(std::vector<ActivationUnknown>& unknowns, Kinematic which, double most) {
    const track::KinematicChannel& range =
        track::kinematic_channels()[static_cast<std::size_t>(which)];
    const double scale = std::min(most, range.max);
    unknowns.push_back({.name = std::string(range.name),
                        .columns = {},
                        .channels = {which},
                        .least = std::max(range.min / scale, -1.0),
                        .most = 1,
                        .scale = scale});
}

// Muscles and the jaw; pressure; gaze and tongue where their parts are counted.
std::vector<ActivationUnknown> unknowns_of(const RigFiles& files, const rig::Head& head,
                                           const Eigen::VectorXd& weight) {
    std::vector<ActivationUnknown> out =
        activation_unknowns(files.rig, nothing(files.rig.channels()), true);
    add_channel(out, Kinematic::kMouthPressure, kPressure_pa);
    out.back().least = 0;
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

void measure(const sim::Face& face, const Points& given, const Eigen::VectorXd& weight,
             SolvedDrive& out) {
    const Points miss = face.pose().vertices - face.head().vertices - given;
    const double whole = weight.sum();
    out.rms_m = std::sqrt(squares(miss, weight) / whole);
    out.given_rms_m = std::sqrt(squares(given, weight) / whole);
    out.greatest_m = 0;
    for (long v = 0; v < weight.size(); ++v)
        if (weight[v] > 0) out.greatest_m = std::max(out.greatest_m, miss.row(v).norm());
    out.highest = out.drive.excitation.cwiseAbs().maxCoeff();
}

class Solver {
  public:
    Solver(const SolveOptions& options, const RigFiles& files, const Given& given,
           const std::vector<ActivationUnknown>& unknowns)
        : options_(options), files_(files), given_(given), unknowns_(unknowns) {}

    std::vector<SolvedDrive> shapes(const Watch& watch) const {
        std::vector<SolvedDrive> out(given_.fields.size());
        std::mutex telling;
        std::size_t done = 0;
        experiment::SpareThreads spare(experiment::ThreadLimit(options_.threads).count() - 1);
        experiment::parallel_for(
            static_cast<int>(out.size()), {options_.threads, &spare}, [&](int i) {
                if (watch.stopped && watch.stopped()) throw Interrupted();
                const std::unique_ptr<sim::Face> face = at_rest();
                SolvedDrive& one = out[static_cast<std::size_t>(i)];
                ActivationFitOptions fit = usual(kShapeRounds, watch);
                seek(*face, static_cast<std::size_t>(i), nothing(files_.rig.channels()), fit, one);
                const std::lock_guard<std::mutex> lock(telling);
                watch.tell(static_cast<double>(++done) / static_cast<double>(out.size()), one.name);
            });
        return out;
    }

    std::vector<SolvedDrive> sequence(const Watch& watch) const {
        std::vector<SolvedDrive> out(given_.fields.size());
        const std::unique_ptr<sim::Face> face = at_rest();
        ActivationFitOptions fit = usual(kFrameRounds, watch);
        for (const Points& field : given_.fields)
            fit.size = std::max(fit.size, squares(field, given_.weight));
        if (!(fit.size > 0))
            throw Error(options_.landmarks.string(), "landmarks that move", "none that does");
        track::Drive last = nothing(files_.rig.channels());
        fit.keep = options_.smooth;
        for (std::size_t t = 0; t < out.size(); ++t) {
            watch.tell(0.6 * static_cast<double>(t) / static_cast<double>(out.size()),
                       given_.names[t]);
            fit.near = values_of(unknowns_, last);
            seek(*face, t, last, fit, out[t]);
            last = out[t].drive;
        }
        // Between both neighbours
        fit.keep = 2 * options_.smooth;
        fit.rounds = 1;
        for (std::size_t t = out.size(); t-- > 0;) {
            watch.tell(1 - 0.4 * static_cast<double>(t + 1) / static_cast<double>(out.size()),
                       given_.names[t]);
            if (t == 0 || t + 1 == out.size()) continue;
            fit.near = 0.5 * (values_of(unknowns_, out[t - 1].drive) +
                              values_of(unknowns_, out[t + 1].drive));
            seek(*face, t, out[t].drive, fit, out[t]);
        }
        return out;
    }

  private:
    ActivationFitOptions usual(int rounds, const Watch& watch) const {
        ActivationFitOptions fit;
        fit.rounds = rounds;
        fit.price = options_.price;
        fit.ridge = options_.ridge;
        fit.least_gain = 3e-3;
        fit.rest = {.iterations = kIterations,
                    .tolerance_m = kTolerance_m,
                    .planes_m = kTolerance_m,
                    .stopped = watch.stopped};
        return fit;
    }
    std::unique_ptr<sim::Face> at_rest() const {
        auto face = std::make_unique<sim::Face>(
            files_.rig, files_.mesh, sim::quality_named(options_.quality), files_.place());
        const track::Drive rest = nothing(files_.rig.channels());
        face->start([&](double) { return rest; });
        return face;
    }
    void seek(sim::Face& face, std::size_t i, const track::Drive& begin,
              const ActivationFitOptions& fit, SolvedDrive& out) const {
        out.name = given_.names[i];
        if (!given_.times_s.empty()) out.time_s = given_.times_s[i];
        out.drive = begin;
        if (squares(given_.fields[i], given_.weight) > 0 || fit.size > 0)
            out.drive =
                fit_activations(face, unknowns_, given_.fields[i], given_.weight, begin, fit);
        measure(face, given_.fields[i], given_.weight, out);
    }

    const SolveOptions& options_;
    const RigFiles& files_;
    const Given& given_;
    const std::vector<ActivationUnknown>& unknowns_;
};

// Every shape in turn, or the frames as they come; muscles straight to their activation.
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
        Json channel{{"keys", keys}, {"interpolation", "linear"}};
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
    return {{"format", "risorius-script"},
            {"version", 1},
            {"rig", fs::absolute(options.rig)
                        .lexically_normal()
                        .lexically_proximate(fs::absolute(options.out).lexically_normal())
                        .generic_string()},
            {"fps", report.sequence ? options.fps : kShapeFps},
            {"duration_s", duration_s},
            {"seed", 1},
            {"motion", "quasi_static"},
            {"channels", channels}};
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
        Json entry{{"name", one.name}};
        if (sequence) entry["time_s"] = one.time_s;
        entry["rms_mm"] = 1e3 * one.rms_m;
        entry["max_mm"] = 1e3 * one.greatest_m;
        entry["given_rms_mm"] = 1e3 * one.given_rms_m;
        entry["drive"] = drive_json(one.drive, channels);
        list.push_back(entry);
    }
    return {{"format", "risorius-solve"},
            {"version", 1},
            {"name", name},
            {"rig", rig},
            {"given", given},
            {"kind", sequence ? "frames" : "shapes"},
            {"points", points},
            {"rms_mm", 1e3 * rms_m()},
            {"solved", list}};
}

SolveReport solve_activations(const SolveOptions& options, const Watch& watch) {
    const int kinds =
        !options.shapes.empty() + !options.meshes.empty() + !options.landmarks.empty();
    if (kinds != 1)
        throw Error("solve", "one of --shapes, --mesh and --landmarks",
                    kinds == 0 ? "none" : std::to_string(kinds));
    if (!options.only.empty() && options.shapes.empty())
        throw Error("--only", "--shapes to choose from", "none");
    for (const auto& [name, value] :
         {std::pair{"--price", options.price}, std::pair{"--ridge", options.ridge},
          std::pair{"--smooth", options.smooth}})
        if (!(value >= 0 && value <= 1e3))
            throw Error(name, "a number in [0, 1000]", format_number(value));
    if (options.fps < 1 || options.fps > 240)
        throw Error("--fps", "an integer in [1, 240]", std::to_string(options.fps));
    const RigFiles files = read_rig_files(options.rig);
    StagedFolder folder(options.out);
    watch.tell(0, "building the face");
    sim::Face face(files.rig, files.mesh, sim::quality_named(options.quality), files.place());
    Given given;
    if (!options.landmarks.empty()) {
        // How far everything that is sought moves each landmark at most
        const LandmarkPoints points(face.head(), files.rig);
        const track::Drive rest = nothing(files.rig.channels());
        face.start([&](double) { return rest; });
        face.settle(rest.excitation, rest);
        std::vector<int> columns;
        for (const ActivationUnknown& unknown : activation_unknowns(files.rig, rest, true))
            columns.insert(columns.end(), unknown.columns.begin(), unknown.columns.end());
        const std::vector<Points> ways =
            face.sensitivities(columns, std::array{Kinematic::kJawOpen});
        std::vector<double> most_m;
        for (const std::string& id : points.ids()) {
            double most = 0;
            for (const Points& way : ways) most = std::max(most, way.row(points.vertex(id)).norm());
            most_m.push_back(most);
        }
        given = given_landmarks(options, points, most_m, face.head().vertices.rows());
    } else {
        given = options.meshes.empty() ? given_shapes(options, files, face)
                                       : given_meshes(options, files, face);
    }
    const std::vector<ActivationUnknown> unknowns = unknowns_of(files, face.head(), given.weight);
    SolveReport report;
    report.name = files.rig.name;
    report.rig = options.rig.generic_string();
    report.given = (!options.shapes.empty()   ? options.shapes
                    : !options.meshes.empty() ? options.meshes.front()
                                              : options.landmarks)
                       .generic_string();
    report.sequence = !options.landmarks.empty();
    report.points = static_cast<int>((given.weight.array() > 0).count());
    report.channels = files.rig.channels();
    const Solver solver(options, files, given, unknowns);
    report.solved = report.sequence ? solver.sequence(watch) : solver.shapes(watch);

    write_text(folder.partial() / "script.json", script_of(report, options).dump(1) + "\n");
    Json json = report.json();
    json[kFilesKey] = {"results.json", "script.json"};
    write_text(folder.partial() / "results.json", json.dump(2) + "\n");
    folder.commit();
    return report;
}

}  // namespace risorius::app
