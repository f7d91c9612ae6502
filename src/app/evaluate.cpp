#include "app/evaluate.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/fit_activations.h"
#include "app/landmark_points.h"
#include "app/measured_shapes.h"
#include "app/rig_files.h"
#include "app/staged_file.h"
#include "app/staged_folder.h"
#include "core/error.h"
#include "sim/face.h"

namespace risorius::app {

namespace {

// Given landmarks of brows, eyes, nose and lips that lie on the simulated skin.
std::vector<int> inner_landmarks(const rig::RigDescription& rig, const LandmarkPoints& points,
                                 const Eigen::VectorXd& area) {
    static const std::set<std::string> kInner{"brow", "eye", "nose", "lip"};
    std::vector<int> out;
    for (const rig::AtlasLandmark& landmark : rig.atlas.landmarks)
        if (kInner.count(landmark.region) && rig.landmarks.count(landmark.id) &&
            area[points.vertex(landmark.id)] > 0)
            out.push_back(points.vertex(landmark.id));
    return out;
}

Json drive_json(const track::Drive& drive, const track::ChannelTable& channels) {
    Json out = Json::object();
    const std::vector<std::string> names = channels.column_names();
    for (std::size_t c = 0; c < names.size(); ++c)
        if (drive.excitation[static_cast<long>(c)] != 0)
            out[names[c]] = drive.excitation[static_cast<long>(c)];
    for (std::size_t k = 0; k < drive.kinematic.size(); ++k)
        if (drive.kinematic[k] != 0)
            out[std::string(track::kinematic_channels()[k].name)] = drive.kinematic[k];
    return out;
}

Json attempt_json(const Attempt& attempt, const track::ChannelTable& channels) {
    Json out = attempt.score.json();
    out["inverted_tets"] = attempt.inverted_tets;
    out["converged"] = attempt.converged;
    out["drive"] = drive_json(attempt.drive, channels);
    return out;
}

Json means_json(const ScoreMeans& means) {
    return {{"expressions", means.count},         {"cosine", means.cosine},
            {"least_cosine", means.least_cosine}, {"relative_error", means.relative},
            {"rms_mm", 1e3 * means.rms_m},        {"landmark_mm", 1e3 * means.landmark_m}};
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
        const ExpressionScore& score = (fitted ? *one.fitted : one.table).score;
        ++out.count;
        out.cosine += score.cosine;
        out.least_cosine = std::min(out.least_cosine, score.cosine);
        out.relative += score.relative;
        out.rms_m += score.rms_m;
        out.landmark_m += score.landmark_m;
    }
    if (out.count == 0) return out;
    for (double* sum : {&out.cosine, &out.relative, &out.rms_m, &out.landmark_m}) *sum /= out.count;
    return out;
}

Json Evaluation::json() const {
    Json list = Json::array();
    std::vector<std::string> all;
    for (const EvaluatedExpression& one : expressions) {
        all.push_back(one.name);
        Json entry{{"name", one.name}, {"table", attempt_json(one.table, channels)}};
        if (one.fitted) entry["fitted"] = attempt_json(*one.fitted, channels);
        list.push_back(entry);
    }
    Json sums = Json::object();
    for (const auto& [key, names] : {std::pair<std::string, std::vector<std::string>>{"all", all},
                                     {"sixteen", sixteen_expressions()},
                                     {"twenty_four", twenty_four_expressions()}}) {
        const ScoreMeans by_table = means(names, false), by_fit = means(names, true);
        if (by_table.count == 0) continue;
        sums[key] = {{"table", means_json(by_table)}};
        if (by_fit.count > 0) sums[key]["fitted"] = means_json(by_fit);
    }
    return {{"format", "risorius-evaluation"},
            {"version", 1},
            {"rig", rig},
            {"shapes", shapes},
            {"nodes", nodes},
            {"means", sums},
            {"expressions", list}};
}

Evaluation evaluate(const EvaluateOptions& options, const Watch& watch) {
    const RigFiles files = read_rig_files(options.rig);
    std::optional<StagedFolder> folder;
    if (!options.out.empty()) folder.emplace(options.out);
    sim::Face face(files.rig, files.mesh, sim::quality_named(options.quality), files.place());
    const std::vector<MeasuredShape> shapes = read_measured_shapes(
        options.shapes, {.only = options.only, .apart = options.apart}, files.rig, face.head());
    const Points& rest = face.head().vertices;
    const Eigen::VectorXd area = vertex_areas(face.simulated_skin(), rest);
    const std::vector<int> landmarks =
        inner_landmarks(files.rig, LandmarkPoints(face.head(), files.rig), area);

    Evaluation out;
    out.rig = options.rig.generic_string();
    out.shapes = options.shapes.generic_string();
    out.nodes = face.node_count();
    out.channels = files.rig.channels();
    track::Drive at_rest;
    at_rest.excitation = Eigen::VectorXd::Zero(out.channels.column_count());
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const MeasuredShape& shape = shapes[s];
        watch.tell(static_cast<double>(s) / static_cast<double>(shapes.size()), shape.name);
        EvaluatedExpression one;
        one.name = shape.name;
        one.measured = shape.displacement;
        face.start([&](double) { return at_rest; });
        one.table.drive = shape.drive;
        one.table.converged = face.settle(shape.drive.excitation, shape.drive).converged;
        one.table.vertices = face.pose().vertices;
        one.table.inverted_tets = face.inverted_tets();
        one.table.score = score(one.table.vertices - rest, shape.displacement, area, landmarks);
        if (options.fit) {
            Attempt& fitted = one.fitted.emplace();
            const auto unknowns = activation_unknowns(files.rig, shape.drive, shape.sided);
            fitted.drive = fit_activations(face, unknowns, shape.displacement, area, shape.drive);
            fitted.vertices = face.pose().vertices;
            fitted.inverted_tets = face.inverted_tets();
            fitted.score = score(fitted.vertices - rest, shape.displacement, area, landmarks);
        }
        out.expressions.push_back(std::move(one));
    }
    if (folder) {
        Json json = out.json();
        json[kFilesKey] = {"results.json"};
        write_text(folder->partial() / "results.json", json.dump(2) + "\n");
        folder->commit();
    }
    return out;
}

}  // namespace risorius::app
