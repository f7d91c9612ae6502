#include "app/fit_rig.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/landmark_file.h"
#include "app/part_guess.h"
#include "app/rig_files.h"
#include "io/read_mesh.h"
#include "rig/head.h"

namespace risorius::app {

namespace fs = std::filesystem;

namespace {

constexpr double kSmallestHead = 0.6, kLargestHead = 1.6;  // of an average adult
constexpr double kLargestResidual_mm = 25;                 // people differ from the atlas by 4 to 8
constexpr double kFarthestFromSkin_mm = 15;

rig::RigDescription standard_rig(const fs::path& folder) {
    const auto table = [&](const char* name) { return JsonCursor::read_file(folder / name); };
    rig::RigDescription rig;
    rig.atlas.landmarks = rig::read_atlas_landmarks(table("landmarks.json"));
    rig.atlas.thickness = rig::read_thickness(table("tissue_thickness.json"));
    rig.atlas.attachments = rig::read_attachments(table("attachments.json"));
    rig.atlas.bands = rig::read_muscle_bands(table("muscle_bands.json"));
    rig.muscles = rig::read_muscle_table(table("muscles.json"));
    rig.facs = track::read_facs(table("facs.json"), rig.channels());
    rig.expressions = track::read_expressions(table("expressions.json"), rig.facs);
    if (fs::exists(folder / rig::kCalibrationFile))
        rig.calibrated_on = rig::read_calibration(folder / rig::kCalibrationFile);
    return rig;
}

std::string quoted_list(const std::vector<std::string>& ids) {
    std::string out;
    for (const std::string& id : ids) out += (out.empty() ? "\"" : " \"") + id + "\"";
    return out;
}

// In mesh units.
std::map<std::string, Vec3> checked_landmarks(const rig::RigDescription& rig,
                                              const geom::PolygonMesh& mesh, const fs::path& file) {
    const std::string place = file.string() + ":/landmarks";
    std::map<std::string, Vec3> out;
    for (const auto& [id, landmark] : rig.landmarks) {
        if (landmark.vertex >= mesh.vertex_count())
            throw Error(
                place + "/" + id + "/vertex",
                "a vertex of the mesh, in [0, " + std::to_string(mesh.vertex_count() - 1) + "]",
                std::to_string(landmark.vertex));
        out[id] = landmark.vertex >= 0 ? Vec3(mesh.positions.row(landmark.vertex).transpose())
                                       : landmark.xyz;
    }
    std::vector<std::string> missing;
    for (const std::string& id : rig::required_landmarks())
        if (!out.count(id)) missing.push_back(id);
    if (!missing.empty())
        throw Error(place,
                    "the " + std::to_string(rig::required_landmarks().size()) +
                        " landmarks without which no head can be placed",
                    "none for " + quoted_list(missing));
    return out;
}

double unit_from_landmarks(const std::map<std::string, Vec3>& landmarks, const rig::Atlas& atlas) {
    const double size = rig::find_head_frame(landmarks, atlas, 1.0).size;
    double best = 1;
    for (double unit : {1.0, 0.1, 0.01, 0.001, 0.0254, 0.3048})
        if (std::abs(std::log(size * unit)) < std::abs(std::log(size * best))) best = unit;
    return best;
}

// Left and right exchanged, or all in one place: mistakes that would only look like a wrong size below.
void check_sides(const std::map<std::string, Vec3>& landmarks, const rig::Atlas& atlas,
                 const FitOptions& options) {
    const std::string place = options.landmarks.string() + ":/landmarks";
    const Vec3& first = landmarks.begin()->second;
    double widest = 0;
    for (const auto& [id, p] : landmarks) widest = std::max(widest, (p - first).norm());
    if (!(widest > 0)) throw Error(place, "landmarks in different places", "all in one");
    std::map<std::string, Vec3> exchanged;
    for (const auto& [id, p] : landmarks) exchanged[rig::mirrored_landmark(id)] = p;
    const auto misfit = [&](const std::map<std::string, Vec3>& marks) {
        const rig::HeadFrame frame = rig::find_head_frame(marks, atlas, 1.0);
        return frame.residual_m / frame.size;
    };
    if (misfit(exchanged) < 0.5 * misfit(landmarks))
        throw Error(place, "_l on the subject's left and _r on the right",
                    "them the other way round");
}

void check_frame(const rig::HeadFrame& frame, const FitOptions& options) {
    const double step = std::pow(10, std::floor(std::log10(frame.size)) - 1);  // two digits
    const std::string found =
        format_number(std::round(frame.size / step) * step) + " times the average adult";
    if (!(frame.size > kSmallestHead && frame.size < kLargestHead)) {
        if (options.metres_per_unit)
            throw Error("--metres-per-unit", "a unit that makes a head of this mesh",
                        format_number(*options.metres_per_unit) + ", which makes one " + found);
        throw Error(
            options.landmarks.string() + ":/landmarks",
            "a head in m, dm, cm, mm, inches or feet (--metres-per-unit names another unit)",
            "one " + found);
    }
    const double residual_mm = 1e3 * frame.residual_m / frame.size;
    if (residual_mm > kLargestResidual_mm)
        throw Error(options.landmarks.string() + ":/landmarks",
                    "landmarks that lie as on a head, within " +
                        format_number(kLargestResidual_mm) + " mm of the atlas (RMS)",
                    format_number(std::round(residual_mm)) + " mm (are they those of this mesh?)");
}

void check_on_skin(const rig::Head& head, const std::map<std::string, Vec3>& landmarks,
                   const FitOptions& options) {
    for (const auto& [id, in_mesh] : landmarks) {
        const Vec3 p = head.frame.to_head(in_mesh);
        double least = 1e300;
        for (long v = 0; v < head.vertices.rows(); ++v)
            if (head.carrier[static_cast<std::size_t>(v)] == rig::Carrier::kSkin)
                least = std::min(least, (head.vertices.row(v).transpose() - p).squaredNorm());
        const double away_mm = 1e3 * std::sqrt(least) / head.size;
        if (away_mm > kFarthestFromSkin_mm)
            throw Error(options.landmarks.string() + ":/landmarks/" + id, "a point on the skin",
                        "one " + format_number(std::round(away_mm)) + " mm away from it");
    }
}

// Missing landmarks in the order of how many points of muscles are placed by them.
std::vector<std::string> worth_giving(const rig::Head& head, const rig::Atlas& atlas) {
    std::map<std::string, int> uses;
    for (const rig::MuscleBand& band : atlas.bands)
        for (const rig::BandPoint& point : band.points) {
            ++uses[point.landmark];
            const std::string other = rig::mirrored_landmark(point.landmark);
            if (other != point.landmark) ++uses[other];
        }
    std::vector<std::string> out;
    for (const std::string& id : head.warped_landmarks)
        if (uses.count(id)) out.push_back(id);
    std::stable_sort(out.begin(), out.end(), [&](const std::string& a, const std::string& b) {
        return uses.at(a) > uses.at(b);
    });
    return out;
}

}  // namespace

FitReport fit_rig(const FitOptions& options, const Watch& watch) {
    // Read the mesh, the landmarks and the standard anatomy
    const fs::path standard =
        options.standard.empty() ? fs::path(RISORIUS_STANDARD_FOLDER) : options.standard;
    rig::RigDescription rig = standard_rig(standard);
    if (options.solids)
        rig.solids = rig::read_solid_muscles(JsonCursor::read_file(standard / "muscle_solids.json"),
                                             rig.muscles);
    rig.name = options.name.empty() ? options.mesh.stem().string() : options.name;
    rig.mesh_file = options.mesh;
    const geom::PolygonMesh mesh = io::read_mesh(options.mesh);
    rig.landmarks = read_atlas_named_landmarks(options.landmarks, rig.atlas.landmarks);
    const std::map<std::string, Vec3> landmarks = checked_landmarks(rig, mesh, options.landmarks);

    check_sides(landmarks, rig.atlas, options);

    // How large it is, and what its groups are
    FitReport report;
    report.out = options.out;
    report.guessed_unit = !options.metres_per_unit;
    rig.metres_per_unit =
        options.metres_per_unit.value_or(unit_from_landmarks(landmarks, rig.atlas));
    const rig::HeadFrame frame = rig::find_head_frame(landmarks, rig.atlas, rig.metres_per_unit);
    check_frame(frame, options);
    for (const auto& [role, groups] : options.parts) {
        const auto& roles = rig::part_roles();
        if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
            std::string names;
            for (std::string_view known : roles) names += " " + std::string(known);
            throw Error("--part", "one of the roles" + names, "\"" + role + "\"");
        }
        for (const std::string& group : groups)
            if (mesh.group_index(group) < 0)
                throw Error("--part", "a group of the mesh: " + quoted_list(mesh.group_names),
                            "\"" + group + "\"");
    }
    PartGuess guess =
        guess_parts(mesh, options.parts, [&](const Vec3& p) { return frame.to_head(p).x(); });
    rig.parts = guess.parts;
    report.notes = guess.notes;
    if (!rig.parts.count("skin"))
        throw Error(options.mesh.string(),
                    "a group whose name says that it is skin (--part skin=GROUP names one)",
                    quoted_list(mesh.group_names));
    for (const geom::MeshFinding& finding : check_skin(rig, mesh).findings)
        if (finding.severity == geom::Severity::kWarning) report.notes.push_back(finding.message());

    // Prove that a face can be built of it
    watch.tell(0, "building the face");
    check_on_skin(rig::place_head(rig, mesh, options.out.string()), landmarks, options);
    sim::Face face(rig, mesh, sim::quality_named("video"), options.out.string());
    const rig::Head& head = face.head();

    // Make every muscle as strong as it has to be on this head
    if (options.calibrate) {
        report.strengths = calibrate_strength(face, rig, watch);
        for (const MuscleStrength& found : report.strengths) {
            const double strength = std::round(1e4 * found.strength) / 1e4;
            for (rig::SolidMuscle& solid : rig.solids)
                if (solid.muscle == found.muscle) solid.strength = strength;
            if (rig.solid(found.muscle) != nullptr) continue;
            for (rig::MuscleBand& band : rig.atlas.bands)
                if (band.muscle == found.muscle) band.strength = strength;
        }
    }

    // Write it and say what came out
    if (options.out.has_parent_path()) {
        std::error_code failure;
        fs::create_directories(options.out.parent_path(), failure);
        if (failure) throw RunError(options.out.parent_path().string() + ": " + failure.message());
    }
    rig::write_rig(rig, options.out,
                   {.standard_folder = standard, .inline_tables = options.inline_tables});
    report.metres_per_unit = rig.metres_per_unit;
    report.size = head.size;
    report.residual_mm = 1e3 * head.frame.residual_m;
    report.parts = rig.parts;
    report.given_landmarks = static_cast<int>(landmarks.size());
    report.warped_landmarks = head.warped_landmarks;
    report.worth_giving = worth_giving(head, rig.atlas);
    report.nodes = face.node_count();
    report.tets = face.tet_count();
    report.dropped_tets = face.dropped_tets();
    report.inverted_tets = face.inverted_tets();
    report.fibres = face.fibre_count();
    report.eyes = head.eyes[0].present && head.eyes[1].present;
    report.teeth = head.has_teeth;
    if (!report.eyes)
        report.notes.push_back("no eyes among the groups: the lids close over guessed ones");
    if (!report.teeth)
        report.notes.push_back("no teeth among the groups: the lips rest on guessed ones");
    watch.tell(1, "done");
    return report;
}

Json FitReport::json() const {
    Json json;
    json["rig"] = out.generic_string();
    json["metres_per_unit"] = metres_per_unit;
    json["guessed_unit"] = guessed_unit;
    json["size"] = size;
    json["residual_mm"] = residual_mm;
    json["parts"] = parts;
    json["given_landmarks"] = given_landmarks;
    json["warped_landmarks"] = warped_landmarks;
    json["worth_giving"] = worth_giving;
    json["nodes"] = nodes;
    json["tets"] = tets;
    json["dropped_tets"] = dropped_tets;
    json["inverted_tets"] = inverted_tets;
    json["fibres"] = fibres;
    json["eyes"] = eyes;
    json["teeth"] = teeth;
    json["strengths"] = Json::array();
    for (const MuscleStrength& m : strengths)
        json["strengths"].push_back({{"muscle", m.muscle},
                                     {"strength", m.strength},
                                     {"stretch", m.stretch},
                                     {"target_stretch", m.target_stretch},
                                     {"at_limit", m.at_limit},
                                     {"converged", m.converged}});
    json["notes"] = notes;
    return json;
}

}  // namespace risorius::app
