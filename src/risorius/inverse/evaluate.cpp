// SPDX-License-Identifier: MIT
#include "risorius/inverse/evaluate.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/face/surfaces.h"
#include "risorius/inverse/detail/evaluation_page.h"
#include "risorius/inverse/detail/evaluation_pictures.h"
#include "risorius/inverse/fit_activations.h"
#include "risorius/inverse/measured_shapes.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/rig/calibration.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"

namespace risorius::inverse {

namespace {

// The given landmarks of brows, eyes, nose and lips that lie on the simulated skin.
std::vector<int> inner_landmarks(const rig::RigDescription& rig,
                                 const scene::LandmarkPoints& points, const Eigen::VectorXd& area) {
    static const std::set<std::string> kInner{"brow", "eye", "nose", "lip"};
    std::vector<int> out;
    for (const rig::AtlasLandmark& landmark : rig.atlas.landmarks)
        if (kInner.count(landmark.region) && rig.landmarks.count(landmark.id) &&
            area[points.vertex(landmark.id)] > 0)
            out.push_back(points.vertex(landmark.id));
    return out;
}

Json attempt_json(const Attempt& attempt, const track::ChannelTable& channels) {
    Json out = attempt.score.json();
    out["inverted_tets"] = attempt.inverted_tets;
    out["converged"] = attempt.converged;
    out["drive"] = rig::drive_json(attempt.drive, channels);
    return out;
}

Json means_json(const ScoreMeans& means) {
    return json_object({{"expressions", means.count},
                        {"cosine", means.cosine},
                        {"least_cosine", means.min_cosine},
                        {"relative_error", means.relative},
                        {"rms_mm", 1e3 * means.rms_m},
                        {"landmark_mm", 1e3 * means.landmark_m}});
}

// Approximate fraction of the run time that is spent on equilibria; the rest draws pictures.
double converging_fraction(const EvaluateOptions& options) {
    if (options.out.empty() || !options.pictures) return 1;
    return options.fit ? 0.8 : 0.1;
}

void write_report(const Evaluation& evaluation, const scene::RigFiles& files, const rig::Head& head,
                  const Eigen::VectorXd& area, const EvaluateOptions& options,
                  const std::filesystem::path& folder, const ProgressMonitor& monitor) {
    std::optional<EvaluationPictures> pictures;
    std::vector<std::string> written{"index.html", "results.json", "scores.tsv"};
    if (options.pictures) {
        const double before = converging_fraction(options);
        ProgressMonitor drawing = monitor;
        if (monitor.progress)
            drawing.progress = [&](double fraction, const std::string& what) {
                monitor.progress(before + (1 - before) * fraction, what);
            };
        pictures = draw_evaluation(evaluation, files.rig, files.mesh, head, area, folder, drawing);
        for (const std::string& file : pictures->files()) written.push_back(file);
    }
    report::write_text(folder / "index.html",
                       evaluation_page(evaluation, pictures ? &*pictures : nullptr));
    report::write_text(folder / "scores.tsv", evaluation_table(evaluation));
    Json json = evaluation.json();
    json[report::kFilesKey] = written;
    report::write_text(folder / "results.json", json_text(json, 2) + "\n");
}

}  // namespace

const std::vector<std::string>& sixteen_expressions() {
    static const std::vector<std::string> kNames{
        "mouthSmile",   "mouthFrown",     "mouthPucker",  "mouthFunnel",
        "mouthUpperUp", "mouthLowerDown", "mouthStretch", "mouthPress",
        "jawOpen",      "browInnerUp",    "browOuterUp",  "browDown",
        "eyeBlink",     "eyeSquint",      "noseSneer",    "cheekPuff"};
    return kNames;
}

const std::vector<std::string>& twenty_four_expressions() {
    static const std::vector<std::string> kNames = [] {
        std::vector<std::string> names = sixteen_expressions();
        names.insert(names.end(),
                     {"mouthDimple", "mouthRollLower", "mouthRollUpper", "mouthShrugLower",
                      "mouthShrugUpper", "eyeWide", "cheekSquint", "jawForward"});
        return names;
    }();
    return kNames;
}

ScoreMeans Evaluation::means(const std::vector<std::string>& names, bool fitted) const {
    ScoreMeans out;
    for (const EvaluatedExpression& one : expressions) {
        if (std::find(names.begin(), names.end(), one.name) == names.end()) continue;
        if (fitted && !one.fitted) continue;
        const scene::ExpressionScore& score = (fitted ? *one.fitted : one.table).score;
        ++out.count;
        out.cosine += score.cosine;
        out.min_cosine = std::min(out.min_cosine, score.cosine);
        out.relative += score.relative;
        out.rms_m += score.rms_m;
        out.landmark_m += score.landmark_m;
    }
    if (out.count == 0) return out;
    for (double* sum : {&out.cosine, &out.relative, &out.rms_m, &out.landmark_m}) *sum /= out.count;
    return out;
}

bool Evaluation::is_calibrated_on(const std::string& expression) const {
    const auto has = [&](const std::string& wanted) {
        return std::find(calibrated_on.begin(), calibrated_on.end(), wanted) != calibrated_on.end();
    };
    // Also if the expression is one side of a listed one
    return has(expression) || has(rig::split_shape(expression).base);
}

std::vector<ExpressionGroup> Evaluation::groups() const {
    std::vector<std::string> all, tuned, others;
    for (const EvaluatedExpression& one : expressions) {
        all.push_back(one.name);
        (is_calibrated_on(one.name) ? tuned : others).push_back(one.name);
    }
    std::vector<ExpressionGroup> out{{"all", "all", all}};
    const auto add_whole = [&](const char* key, const char* title,
                               const std::vector<std::string>& names) {
        if (means(names, false).count == static_cast<int>(names.size()))
            out.push_back({key, title, names});
    };
    add_whole("sixteen", "the 16", sixteen_expressions());
    add_whole("twenty_four", "the 24", twenty_four_expressions());
    if (!tuned.empty()) {
        out.push_back({"calibrated_on", "those calibrated on", tuned});
        if (!others.empty()) out.push_back({"others", "the others", others});
    }
    return out;
}

Json Evaluation::json() const {
    Json list = Json::array();
    for (const EvaluatedExpression& one : expressions) {
        Json entry =
            json_object({{"name", one.name}, {"table", attempt_json(one.table, channels)}});
        if (one.fitted) entry["fitted"] = attempt_json(*one.fitted, channels);
        list.push_back(entry);
    }
    Json sums = Json::object();
    for (const ExpressionGroup& group : groups()) {
        const ScoreMeans by_fit = means(group.names, true);
        sums[group.key] = json_object({{"table", means_json(means(group.names, false))}});
        if (by_fit.count > 0) sums[group.key]["fitted"] = means_json(by_fit);
    }
    return json_object({{"format", "risorius-evaluation"},
                        {"version", 1},
                        {"name", name},
                        {"rig", rig},
                        {"shapes", shapes},
                        {"nodes", nodes},
                        {"calibrated_on", calibrated_on},
                        {"means", sums},
                        {"expressions", list}});
}

Evaluation evaluate(const EvaluateOptions& options, const ProgressMonitor& monitor) {
    const scene::RigFiles files = scene::read_rig_files(options.rig, monitor.stopped);
    std::optional<report::AtomicFolder> folder;
    if (!options.out.empty()) folder.emplace(options.out);
    face::Face face(files.rig, files.mesh, face::quality_named(options.quality), files.place());
    const std::vector<MeasuredShape> shapes = read_measured_shapes(
        options.shapes, {.only = options.only, .separate_sides = options.separate_sides}, files.rig,
        face.head());
    const Points& rest = face.head().vertices;
    const Eigen::VectorXd area = scene::vertex_areas(face.surfaces().simulated_skin(), rest);
    const std::vector<int> landmarks =
        inner_landmarks(files.rig, scene::LandmarkPoints(face.head(), files.rig), area);

    Evaluation out;
    out.name = files.rig.name;
    out.calibrated_on = rig::calibrated_on(options.rig);
    out.rig = options.rig.generic_string();
    out.shapes = options.shapes.generic_string();
    out.nodes = face.diagnostics().node_count();
    out.channels = files.rig.channels();
    const double converging = converging_fraction(options);
    track::Drive at_rest;
    at_rest.excitation = Eigen::VectorXd::Zero(out.channels.column_count());
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const MeasuredShape& shape = shapes[s];
        monitor.report(converging * static_cast<double>(s) / static_cast<double>(shapes.size()),
                       shape.name);
        EvaluatedExpression one;
        one.name = shape.name;
        one.measured = shape.displacement;
        face.start([&](double) { return at_rest; });
        one.table.drive = shape.drive;
        one.table.converged = face.solve_equilibrium(shape.drive.excitation, shape.drive).converged;
        one.table.vertices = face.pose().vertices;
        one.table.inverted_tets = face.diagnostics().inverted_tets();
        one.table.score =
            scene::score(one.table.vertices - rest, shape.displacement, area, landmarks);
        if (options.fit) {
            Attempt& fitted = one.fitted.emplace();
            const auto unknowns = activation_unknowns(files.rig, shape.drive, shape.sided);
            fitted.drive = fit_activations(face, unknowns, shape.displacement, area, shape.drive);
            fitted.vertices = face.pose().vertices;
            fitted.inverted_tets = face.diagnostics().inverted_tets();
            fitted.score =
                scene::score(fitted.vertices - rest, shape.displacement, area, landmarks);
        }
        out.expressions.push_back(std::move(one));
    }
    if (folder) {
        write_report(out, files, face.head(), area, options, folder->partial(), monitor);
        monitor.throw_if_stopped();
        folder->commit();
    }
    return out;
}

}  // namespace risorius::inverse
