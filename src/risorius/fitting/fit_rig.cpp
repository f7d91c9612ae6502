// SPDX-License-Identifier: MIT
#include "risorius/fitting/fit_rig.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/json_object.h"
#include "risorius/face/diagnostics.h"
#include "risorius/fitting/detail/fit_landmarks.h"
#include "risorius/fitting/detail/fit_page.h"
#include "risorius/fitting/detail/fit_strengths.h"
#include "risorius/fitting/detail/mesh_parts.h"
#include "risorius/fitting/detail/piece_guess.h"
#include "risorius/fitting/fit_units.h"
#include "risorius/fitting/landmark_file.h"
#include "risorius/fitting/part_guess.h"
#include "risorius/geom/repair_mesh.h"
#include "risorius/io/read_mesh.h"
#include "risorius/media/image_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/report/output_paths.h"
#include "risorius/rig/cut_lips.h"
#include "risorius/rig/head.h"
#include "risorius/rig/wrinkle_table.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::fitting {

namespace fs = std::filesystem;

namespace {

constexpr double kSmallestHead = 0.6, kLargestHead = 1.6;  // relative to an average adult
constexpr double kLargestResidual_mm = 25;                 // the RMS of real people is 4 to 8 mm

rig::RigDescription standard_rig(const fs::path& folder) {
    const auto table = [&](const char* name) { return JsonCursor::read_file(folder / name); };
    rig::RigDescription rig;
    rig.atlas.landmarks = rig::read_atlas_landmarks(table("landmarks.json"));
    rig.atlas.thickness = rig::read_thickness(table("tissue_thickness.json"));
    rig.atlas.attachments = rig::read_attachments(table("attachments.json"));
    rig.atlas.bands = rig::read_muscle_bands(table("muscle_bands.json"));
    rig.atlas.wrinkles = rig::read_wrinkles(table(rig::kWrinkleFile), rig.atlas.landmark_ids());
    rig.muscles = rig::read_muscle_table(table("muscles.json"));
    rig.facs = track::read_facs(table("facs.json"), rig.channels());
    rig.expressions = track::read_expressions(table("expressions.json"), rig.facs, rig.channels());
    return rig;
}

void check_frame(const rig::HeadFrame& frame, const FitOptions& options) {
    char size[32];
    std::snprintf(size, sizeof size, "%.2g", frame.size);
    const std::string found = format_number(std::stod(size)) + " times the average adult";
    if (!(frame.size > kSmallestHead && frame.size < kLargestHead)) {
        if (options.metres_per_unit)
            throw Error(option_name("metres_per_unit"), "a unit that makes a head of this mesh",
                        format_number(*options.metres_per_unit) + ", which makes one " + found);
        throw Error(options.landmarks.string() + ":/landmarks",
                    "a head in m, dm, cm, mm, inches or feet (" + option_name("metres_per_unit") +
                        " names another unit)",
                    "one " + found);
    }
    const double residual_mm = 1e3 * frame.residual_m / frame.size;
    if (residual_mm > kLargestResidual_mm)
        throw Error(options.landmarks.string() + ":/landmarks",
                    "landmarks that lie as on a head, within " +
                        format_number(kLargestResidual_mm) + " mm of the atlas (RMS)",
                    format_number(std::round(residual_mm)) + " mm (are they those of this mesh?)");
}

// Turns the pieces of a mesh without groups into groups, unless the user names parts. Returns messages about the guesses.
std::vector<std::string> group_pieces_of(geom::PolygonMesh& mesh, const rig::HeadFrame& frame,
                                         const LandmarkPositions& landmarks,
                                         const FitOptions& options) {
    if (!options.parts.empty()) return {};
    LandmarkPositions in_head;
    for (const auto& [id, p] : landmarks) in_head[id] = frame.to_head(p);
    return group_pieces(
        mesh, [&](const Vec3& p) { return frame.to_head(p); }, in_head, frame.size);
}

// Rejects closed lips of a scan, or cuts them if requested; then `mesh` and `rig` become those of the cut head.
bool open_lips(const FitOptions& options, const rig::Head& head, rig::RigDescription& rig,
               geom::PolygonMesh& mesh, std::vector<std::string>& notes) {
    const bool closed = rig::lips_are_closed(head);
    if (!closed) {
        if (options.cut_lips) notes.push_back("the lips are apart already: nothing was cut");
        return false;
    }
    if (!options.cut_lips)
        throw Error(options.mesh.string(),
                    "lips that can part (" + option_name("cut_lips") + " cuts them)",
                    "skin that runs on from the upper lip to the lower");
    std::vector<int> skin;
    for (const std::string& group : rig.parts.at("skin")) skin.push_back(mesh.group_index(group));
    rig::CutLips cut = rig::cut_lips(mesh, head, skin, options.mesh.string());

    // Landmarks of the lower lip move to its new vertices.
    for (auto& [id, landmark] : rig.landmarks)
        if (landmark.vertex >= 0)
            landmark.vertex = head.welded[static_cast<std::size_t>(landmark.vertex)];
    const std::size_t middle = static_cast<std::size_t>(cut.middle);
    rig.landmarks["stos"] = {.vertex = cut.upper[middle]};
    rig.landmarks["stoi"] = {.vertex = cut.lower[middle]};
    for (const char* id : {"lli_l", "lli_r"}) {
        const auto given = rig.landmarks.find(id);
        if (given == rig.landmarks.end()) continue;
        const auto above = std::find(cut.upper.begin(), cut.upper.end(), given->second.vertex);
        if (above != cut.upper.end())
            given->second.vertex = cut.lower[static_cast<std::size_t>(above - cut.upper.begin())];
    }
    rig.parts["mouth"].push_back(rig::kLiningGroup);
    mesh = std::move(cut.mesh);
    notes.push_back("the lips are cut apart over " + std::to_string(cut.upper.size()) +
                    " points, with a lining behind" +
                    (cut.laid_back == 0 ? ""
                                        : "; " + std::to_string(cut.laid_back) +
                                              " points seen deep between them are laid back"));
    return true;
}

// File of a mesh that was cut, or whose pieces were named.
fs::path changed_mesh_file(const fs::path& rig) {
    fs::path file = rig;
    return file.replace_filename(rig.stem().string() + "_head.obj");
}

// Calibrates each muscle separately, then all together.
void scale_muscles(face::FaceTeam& team, const FitOptions& options, const fs::path& standard,
                   const ProgressMonitor& monitor, rig::RigDescription& rig, FitReport& report) {
    const auto part_of = [&](double begin, double end) {
        ProgressMonitor part = monitor;
        part.progress = [&monitor, begin, end](double done, const std::string& what) {
            monitor.report(begin + (end - begin) * done, what);
        };
        return part;
    };
    const ProgressMonitor alone = part_of(0, options.together ? 0.25 : 1.0),
                          together = part_of(0.25, 0.6), units = part_of(0.6, 1.0);
    report.strengths = calibrate_strength(team, rig, alone);
    if (options.together) {
        const StrengthFit fit = fit_strengths(
            team, rig, scene::read_landmark_displacements(standard / "landmark_ways.json"), {},
            options.out.string(), together);
        report.difference_before = fit.difference_before;
        report.difference = fit.difference;
        rig.lips = fit.lips;
        for (MuscleStrength& found : report.strengths)
            found.strength *= fit.factor.at(found.muscle);
    }
    if (options.together) report.unit_gains = rig.unit_gains = fit_units(team, rig, units);
    for (const MuscleStrength& found : report.strengths) {
        const double strength = std::round(1e4 * found.strength) / 1e4;
        for (rig::SolidMuscle& solid : rig.solids)
            if (solid.muscle == found.muscle) solid.strength = strength;
        if (rig.solid(found.muscle) != nullptr) continue;
        for (rig::MuscleBand& band : rig.atlas.bands)
            if (band.muscle == found.muscle) band.strength = strength;
    }
}

void check_parts(const FitOptions& options, const geom::PolygonMesh& mesh) {
    for (const auto& [role, groups] : options.parts) {
        const auto& roles = rig::part_roles();
        if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
            std::string names;
            for (std::string_view known : roles) names += " " + std::string(known);
            throw Error(option_name("part"), "one of the roles" + names, "\"" + role + "\"");
        }
        for (const std::string& group : groups)
            if (mesh.group_index(group) < 0)
                throw Error(option_name("part"),
                            "a group of the mesh: " + quoted_list(mesh.group_names),
                            "\"" + group + "\"");
    }
}

// The outputs of a fit: the rig, the mesh if it was changed, and the report. They appear together, unless the report is to be in
// a folder elsewhere.
class FitOutputs {
  public:
    /// `changed_mesh`: the mesh if it was changed, else nullptr
    FitOutputs(const FitOptions& options, const geom::PolygonMesh* changed_mesh)
        : options_(options) {
        rig_ = options.out;
        if (changed_mesh) mesh_ = io::obj_files(*changed_mesh, changed_mesh_file(options.out));
        if (!is_private_output(options.out)) {
            own_.emplace(folder_of_output(options.out));
            rig_ = own_->file(options.out);
            for (fs::path& file : mesh_) file = own_->file(file);
        }
        if (!options.report.empty()) add_report();
    }

    // Writes the rig and, if it was changed, the mesh. Returns notes about its pictures.
    std::vector<std::string> write(const fs::path& standard, const geom::PolygonMesh& mesh,
                                   rig::RigDescription& rig) const {
        std::vector<std::string> notes;
        if (!mesh_.empty()) {
            rig.mesh_file = changed_mesh_file(options_.out);
            notes = io::write_obj_with_pictures(mesh, shown_output(rig.mesh_file), mesh_);
        }
        rig::write_rig(rig, rig_,
                       {.standard_folder = standard,
                        .inline_tables = options_.inline_tables,
                        .place = options_.out});
        return notes;
    }
    // The folder of the report; empty without one.
    fs::path report() const { return report_ ? report_->partial() : fs::path(); }

    void commit() {
        if (report_) {
            report::check_results_folder(options_.report);
            report_->commit();
        }
        if (own_) own_->commit();
    }

  private:
    void add_report() {
        const fs::path real = report::real_results_folder(options_.report),
                       root = report::real_results_folder(
                           fs::absolute(folder_of_output(options_.out)));
        const fs::path below = real.lexically_relative(root);
        if (own_ && !below.empty() && below != "." && *below.begin() != "..") {
            report::check_results_folder(options_.report);
            report_.emplace(own_->folder(real));
        } else {
            report_.emplace(options_.report, OutputSet::Then::kRunGoesOn);
        }
    }

    const FitOptions& options_;
    std::optional<OutputSet> own_;
    fs::path rig_;
    std::vector<fs::path>
        mesh_;  // where to write the mesh and its pictures; empty if it was not changed
    std::optional<report::AtomicFolder> report_;
};

void report_head(const rig::RigDescription& rig, const face::Face& face,
                 const LandmarkPositions& landmarks, FitReport& report) {
    const rig::Head& head = face.head();
    report.metres_per_unit = rig.metres_per_unit;
    report.size = head.size;
    report.residual_mm = 1e3 * head.frame.residual_m;
    report.parts = rig.parts;
    report.given_landmarks = static_cast<int>(landmarks.size());
    report.warped_landmarks = head.warped_landmarks;
    report.worth_giving = worth_giving(head, rig.atlas);
    report.nodes = face.diagnostics().node_count();
    report.tets = face.diagnostics().tet_count();
    report.dropped_tets = face.diagnostics().dropped_tets();
    report.inverted_tets = face.diagnostics().inverted_tets();
    report.fibres = face.diagnostics().fibre_count();
    report.eyes = head.eyes[0].present && head.eyes[1].present;
    report.teeth = head.has_teeth;
    if (!report.eyes)
        report.notes.push_back("no eyes among the groups: the lids close over guessed ones");
    if (!report.teeth)
        report.notes.push_back("no teeth among the groups: the lips rest on guessed ones");
}

void add_notes(const std::vector<std::string>& notes, FitReport& report) {
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
}

// Mends the skin. Returns whether there was anything to mend.
bool repair_skin(const rig::RigDescription& rig, geom::PolygonMesh& mesh, FitReport& report) {
    geom::RepairOptions options;
    options.metres_per_unit = rig.metres_per_unit;
    for (const std::string& group : rig.parts.at("skin"))
        options.groups.push_back(mesh.group_index(group));
    const std::vector<std::string> done = geom::repair_mesh(mesh, options);
    add_notes(done, report);
    if (done.empty()) report.notes.push_back("the skin is sound: nothing was repaired");
    return !done.empty();
}

// Finds the roles of groups, and checks the skin. Returns whether the mesh was changed in a way that the rig cannot describe.
bool find_parts(const FitOptions& options, const rig::HeadFrame& frame,
                const LandmarkPositions& landmarks, geom::PolygonMesh& mesh,
                rig::RigDescription& rig, FitReport& report) {
    const auto left_of = [&](const Vec3& p) { return frame.to_head(p).x(); };
    split_materials(mesh, options.parts);
    const std::vector<std::string> by_piece = group_pieces_of(mesh, frame, landmarks, options),
                                   by_side = split_sides(mesh, options.parts, left_of);
    add_notes(by_piece, report);
    add_notes(by_side, report);
    bool changed = !by_piece.empty() || !by_side.empty();
    check_parts(options, mesh);
    const PartGuess guess = guess_parts(mesh, options.parts, left_of);
    rig.parts = guess.parts;
    add_notes(guess.notes, report);
    if (!rig.parts.count("skin"))
        throw Error(options.mesh.string(),
                    "a group whose name says that it is skin (" + option_name("part") +
                        " skin=GROUP names one)",
                    quoted_list(mesh.group_names));
    if (const int faces = hide_body(
            mesh, rig.parts.at("skin"), [&](const Vec3& p) { return frame.to_head(p); },
            frame.to_head(landmarks.at("me")), frame.size)) {
        rig.parts["hidden"].push_back(kBodyGroup);
        report.notes.push_back("the body below the neck is hidden (" + std::to_string(faces) +
                               " faces)");
        changed = true;
    }
    if (options.repair && repair_skin(rig, mesh, report)) changed = true;
    const std::string advice =
        options.repair ? "" : " (" + option_name("repair") + " mends what a scan has of these)";
    for (const geom::MeshFinding& finding : scene::check_skin(rig, mesh, advice).findings)
        if (finding.severity == geom::Severity::kWarning) report.notes.push_back(finding.message());
    return changed;
}

}  // namespace

FitReport fit_rig(const FitOptions& options, const ProgressMonitor& monitor) {
    report::check_overwritten(options.out, {"risorius-rig"}, "no file, or an earlier rig");
    if (options.metres_per_unit &&
        !(*options.metres_per_unit > 0 && std::isfinite(*options.metres_per_unit)))
        throw Error(option_name("metres_per_unit"), "a number in (0, inf)",
                    format_number(*options.metres_per_unit));

    // Read the mesh, the landmarks and the standard anatomy.
    const fs::path standard =
        options.standard.empty() ? data_folder() / "rigs" / "standard" : options.standard;
    rig::RigDescription rig = standard_rig(standard);
    if (options.solids)
        rig.solids = rig::read_solid_muscles(JsonCursor::read_file(standard / "muscle_solids.json"),
                                             rig.muscles);
    rig.name = options.name.empty() ? options.mesh.stem().string() : options.name;
    rig.mesh_file = options.mesh;
    geom::PolygonMesh mesh =
        io::read_mesh(options.mesh, {.metres_per_unit = 1, .stopped = monitor.stopped});
    FitReport report;
    if (!options.landmarks_note.empty()) report.notes.push_back(options.landmarks_note);
    add_notes(mesh.notes, report);
    add_notes(scene::picture_problems(mesh), report);
    rig.landmarks = read_atlas_named_landmarks(options.landmarks, rig.atlas.landmarks);
    add_notes(leave_out_unsure(rig.landmarks, options.landmarks), report);
    add_notes(take_file_coordinates(rig.landmarks, mesh, options.mesh, options.landmarks), report);
    const LandmarkPositions landmarks = landmark_positions(rig, mesh, options.landmarks);
    check_sides(landmarks, rig.atlas, options.landmarks);

    // Find the unit, the size and the roles of groups.
    report.out = options.out;
    report.guessed_unit = !options.metres_per_unit;
    rig.metres_per_unit =
        options.metres_per_unit.value_or(unit_from_landmarks(landmarks, rig.atlas));
    const rig::HeadFrame frame = rig::find_head_frame(landmarks, rig.atlas, rig.metres_per_unit);
    check_frame(frame, options);
    const bool changed = find_parts(options, frame, landmarks, mesh, rig, report);

    // Check that a face can be built from it.
    monitor.report(0, "building the face");
    {
        const rig::Head placed = rig::place_head(rig, mesh, options.out.string());
        for (std::string& note : check_places(placed, landmarks, rig.atlas, options.landmarks))
            report.notes.push_back(std::move(note));
        report.lips_cut = open_lips(options, placed, rig, mesh, report.notes);
    }
    if (std::error_code unknown;
        (report.lips_cut || changed) &&
        fs::equivalent(options.mesh, changed_mesh_file(options.out), unknown))
        throw Error(
            options.out.string(),
            "a name for the rig under which the changed mesh does not take the place of yours",
            changed_mesh_file(options.out).string());
    FitOutputs outputs(options, report.lips_cut || changed ? &mesh : nullptr);
    face::Face face(rig, mesh, face::quality_named("video"), options.out.string());
    const rig::Head& head = face.head();

    // Give every muscle the strength that it needs on this head.
    if (options.calibrate) {
        face::FaceTeam team(
            face,
            [&, same = rig] {
                return face::Face(same, mesh, face::quality_named("video"), options.out.string());
            },
            options.threads);
        scale_muscles(team, options, standard, monitor, rig, report);
    }

    // Write the rig and the report.
    add_notes(outputs.write(standard, mesh, rig), report);
    report_head(rig, face, landmarks, report);
    const BoneEstimate bone = bone_estimate(head, rig, face.diagnostics().shell());
    report.bone = bone_figures(bone);
    if (report.bone.through_skin > 0)
        report.notes.push_back(std::to_string(report.bone.through_skin) +
                               " points of bone lie outside of the skin: look at the report");
    if (const fs::path folder = outputs.report(); !folder.empty()) {
        media::write_png(fit_picture(head, bone, rig, mesh), folder / kFitPicture);
        write_fit_report(report, rig, folder);
    }
    monitor.report(1, "done");
    outputs.commit();
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
    json["bone"] = json_object({{"thinnest_mm", bone.thinnest_mm},
                                {"thickest_mm", bone.thickest_mm},
                                {"mean_mm", bone.mean_mm},
                                {"through_skin", bone.through_skin}});
    json["lips_cut"] = lips_cut;
    json["eyes"] = eyes;
    json["teeth"] = teeth;
    json["expressions"] =
        json_object({{"difference_before", difference_before}, {"difference", difference}});
    for (const auto& [unit, gain] : unit_gains)
        json["unit_gains"][unit] = rig::unit_gain_json(gain);
    json["strengths"] = Json::array();
    for (const MuscleStrength& m : strengths)
        json["strengths"].push_back(json_object({{"muscle", m.muscle},
                                                 {"strength", m.strength},
                                                 {"stretch", m.stretch},
                                                 {"target_stretch", m.target_stretch},
                                                 {"at_limit", m.at_limit},
                                                 {"converged", m.converged}}));
    json["notes"] = notes;
    return json;
}

}  // namespace risorius::fitting
