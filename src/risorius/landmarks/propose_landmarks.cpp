// SPDX-License-Identifier: MIT
#include "risorius/landmarks/propose_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/parallel.h"
#include "risorius/io/read_mesh.h"
#include "risorius/landmarks/detail/by_definition.h"
#include "risorius/landmarks/detail/certainty.h"
#include "risorius/landmarks/detail/landmark_pictures.h"
#include "risorius/landmarks/detail/registration.h"
#include "risorius/landmarks/similarity.h"
#include "risorius/rig/head.h"

namespace risorius::landmarks {

namespace fs = std::filesystem;

namespace {

constexpr std::array<double, 6> kUnits_m{1.0, 0.1, 0.01, 0.001, 0.0254, 0.3048};
constexpr double kSmallestHead = 0.6, kLargestHead = 1.6;  // of the average adult, as rigs may have

std::vector<TemplateHead> read_templates(const LandmarkOptions& options, const rig::Atlas& atlas,
                                         const FaceNetwork& network) {
    std::vector<TemplateFiles> files = options.templates;
    if (files.empty()) {
        const fs::path adult = data_folder() / "models" / "adult";
        files.push_back(
            {adult / "head.obj", adult / "landmarks.json", adult / "landmarks_by_definition.json"});
    }
    std::vector<TemplateHead> out;
    for (const TemplateFiles& file : files) {
        const geom::PolygonMesh mesh = io::read_mesh(file.mesh);
        out.push_back(template_head(file.mesh.string(), mesh, known_landmarks(file, mesh, atlas),
                                    atlas, network));
    }
    return out;
}

/// From the frame of the first template to the mesh.
Similarity to_mesh_of(const TemplateHead& known, const FacePoints& face) {
    std::vector<Vec3> from, to;
    std::vector<double> weights;
    for (std::size_t k = 0; k < face.points.size(); ++k) {
        if (!(known.face[k].weight > 0) || !(face.points[k].weight > 0)) continue;
        from.push_back(known.face[k].at);
        to.push_back(face.points[k].at);
        const double spread = std::max(face.points[k].spread, face.spread);
        weights.push_back(1 / (spread * spread));
    }
    return nearest_similarity(from, to, weights);
}

/// The mesh and its points in the frame of the templates.
ShownHead moved(const geom::PolygonMesh& mesh, const Similarity& motion,
                const LandmarkOptions& options) {
    geom::PolygonMesh out = mesh;
    for (Eigen::Index v = 0; v < out.positions.rows(); ++v)
        out.positions.row(v) = motion(mesh.positions.row(v).transpose()).transpose();
    return shown_head(out, options.mesh.string(), options.parts);
}

/// As each template places the landmarks; once more, with the lips held, where their line shows that the mouth was missed.
std::vector<std::map<std::string, PlacedLandmark>> placed_by_all(
    const std::vector<TemplateHead>& known, const ShownHead& head,
    const std::vector<SeenPoint>& face) {
    std::vector<std::map<std::string, PlacedLandmark>> out(known.size());
    const auto place = [&](const std::map<std::string, Vec3>& lips) {
        parallel_for(static_cast<int>(known.size()), {}, [&](int i) {
            const auto at = static_cast<std::size_t>(i);
            out[at] = placed_landmarks(known[at], head, face, lips);
        });
    };
    place({});
    std::map<std::string, Vec3> mean;
    for (const char* id : {"sto", "ch_l", "ch_r"}) {
        mean[id] = Vec3::Zero();
        for (const auto& by : out) mean[id] += by.at(id).at / static_cast<double>(out.size());
    }
    const auto lips = missed_lips(head, mean);
    if (!lips.empty()) place(lips);
    return out;
}

void find_unit(const LandmarkOptions& options, double units_per_metre, LandmarkProposal& out) {
    out.guessed_unit = !options.metres_per_unit;
    out.metres_per_unit = options.metres_per_unit.value_or(kUnits_m[0]);
    if (out.guessed_unit)
        for (const double unit : kUnits_m)
            if (std::abs(std::log(unit * units_per_metre)) <
                std::abs(std::log(out.metres_per_unit * units_per_metre)))
                out.metres_per_unit = unit;
    out.size = out.metres_per_unit * units_per_metre;
    if (out.size > kSmallestHead && out.size < kLargestHead) return;
    if (!out.guessed_unit)
        throw Error(option_name("metres_per_unit"),
                    "a unit in which the head has the size of a person's (about " +
                        format_number(std::round(1e6 / units_per_metre) / 1e6) + ")",
                    format_number(out.metres_per_unit) + ", a head " +
                        format_number(std::round(100 * out.size) / 100) +
                        " times the average adult");
    out.metres_per_unit = 1 / units_per_metre;
    out.size = 1;
    out.usual_unit = false;
    out.notes.push_back(
        "in no usual unit the mesh has the size of a head: it is taken to be as large as the "
        "average adult");
}

}  // namespace

Certainty ProposedLandmark::certainty() const {
    return confidence >= kSureFrom       ? Certainty::kSure
           : confidence >= kDoubtfulFrom ? Certainty::kDoubtful
                                         : Certainty::kUnsure;
}

std::vector<std::string> LandmarkProposal::unsure_required() const {
    std::vector<std::string> out;
    for (const std::string& id : rig::required_landmarks()) {
        const auto found = landmarks.find(id);
        if (found == landmarks.end() || found->second.certainty() == Certainty::kUnsure)
            out.push_back(id);
    }
    return out;
}

LandmarkProposal propose_landmarks(const LandmarkOptions& options, const ProgressMonitor& monitor) {
    const fs::path standard =
        options.standard.empty() ? data_folder() / "rigs" / "standard" : options.standard;
    rig::Atlas atlas;
    atlas.landmarks = rig::read_atlas_landmarks(JsonCursor::read_file(standard / "landmarks.json"));
    const geom::PolygonMesh mesh =
        io::read_mesh(options.mesh, {.metres_per_unit = 1, .stopped = monitor.stopped});
    const FaceNetwork network(options.weights.empty() ? weights_folder() : options.weights);
    monitor.report(0, "looking for the face");
    LandmarkProposal out;
    out.mesh = options.mesh.filename().string();
    out.notes = mesh.notes;
    const auto seen =
        find_face_points(shown_head(mesh, options.mesh.string(), options.parts), network);
    if (!seen)
        throw Error(options.mesh.string(), "a mesh of a head with a face that can be recognized",
                    "no face in any of 24 orientations");

    monitor.report(0.5, "looking at the heads whose landmarks are known");
    const std::vector<TemplateHead> known = read_templates(options, atlas, network);
    const Similarity to_mesh = to_mesh_of(known.front(), *seen), to_known = to_mesh.inverse();
    find_unit(options, to_mesh.scale, out);
    const ShownHead head = moved(mesh, to_known, options);
    std::vector<SeenPoint> face = seen->points;
    for (SeenPoint& point : face) {
        point.at = to_known(point.at);
        point.spread *= to_known.scale;
    }

    monitor.report(0.7, "bringing them onto the mesh");
    const auto placed = placed_by_all(known, head, face);
    const std::map<std::string, JudgedLandmark> judged = judged_landmarks(placed, head, atlas);
    const Eigen::Matrix4d to_file = mesh.from_file.inverse();
    for (const auto& [id, landmark] : judged) {
        ProposedLandmark& to = out.landmarks[id];
        to.xyz = (to_file * to_mesh(landmark.at).homogeneous()).head<3>();
        to.expected_mm = 1e3 * out.size * landmark.expected_m;
        to.confidence = std::exp2(-to.expected_mm / kHalved_mm);
        to.reason = landmark.reason;
    }
    out.score = seen->score;
    out.spread_mm = 1e3 * out.size * to_known.scale * seen->spread;
    out.up = to_mesh.rotation.col(1);
    out.forward = to_mesh.rotation.col(2);
    for (const TemplateHead& head_of : known) out.templates.push_back(head_of.name);
    if (options.pictures) out.pictures = landmark_pictures(head, judged, out.landmarks);
    monitor.report(1, "done");
    return out;
}

}  // namespace risorius::landmarks
