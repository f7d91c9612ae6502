// SPDX-License-Identifier: MIT
#include "tools/risorius/check_files.h"

#include <algorithm>

#include "risorius/animate/render_inputs.h"
#include "risorius/animate/render_job.h"
#include "risorius/animate/render_request.h"
#include "risorius/core/data_folder.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/figures/registry.h"
#include "risorius/fitting/landmark_file.h"
#include "risorius/fitting/part_guess.h"
#include "risorius/io/read_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/speech/utterance.h"
#include "risorius/stimuli/batch.h"
#include "risorius/study/run_study.h"
#include "risorius/track/script.h"
#include "tools/risorius/schema_check.h"
#include "tools/risorius/stop_signals.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

/// Adds what the reader of a mesh left out, and what is wrong with its pictures.
void note_pictures(const geom::PolygonMesh& mesh, CheckResult& result) {
    for (const std::string& note : mesh.notes) result.notes.push_back(readable_text(note));
    for (std::string& note : scene::picture_problems(mesh)) result.notes.push_back(std::move(note));
}

void check_rig(const fs::path& file, CheckResult& result) {
    const scene::RigFiles files = scene::read_rig_files(file, stop_is_asked);
    const rig::Head head = rig::place_head(files.rig, files.mesh, files.place());
    result.notes = files.rig.notes;
    note_pictures(files.mesh, result);
    if (!head.warped_landmarks.empty())
        result.notes.push_back(std::to_string(head.warped_landmarks.size()) +
                               " landmarks are not given and placed by the atlas");
}

/// Adds a note for each event after the last frame of a script.
void note_late_events(const track::ScriptDescription& script, CheckResult& result) {
    const double end_s = script.header.duration_s;
    const auto note = [&](const std::string& what, const std::string& does, double at_s) {
        if (at_s <= end_s + 1e-9) return;
        result.notes.push_back(what + " " + does + " at " + format_number(at_s) +
                               " s, after the end at " + format_number(end_s) + " s");
    };
    for (const track::ChannelTrack& channel : script.channels)
        if (!channel.keys.empty())
            note("\"" + channel.name + "\"", "has a key", channel.keys.back().time_s);
    for (const track::ExpressionEvent& event : script.expressions)
        if (const double until = event.start_s + event.onset_s + event.hold_s; until > end_s)
            note("\"" + event.expression + "\"", "is over", until + event.offset_s);
        else
            note("\"" + event.expression + "\"", "has gone back", until + event.offset_s);
}

/// Adds a note for each channel and event that changes nothing in any frame.
void note_idle_channels(const track::ScriptDescription& script, CheckResult& result) {
    for (const track::ChannelTrack& channel : script.channels)
        if (std::all_of(channel.keys.begin(), channel.keys.end(),
                        [](const track::Key& key) { return key.value == 0; }))
            result.notes.push_back("\"" + channel.name + "\" is 0 in every key and never acts");
    for (const track::ExpressionEvent& event : script.expressions)
        if (event.intensity == 0)
            result.notes.push_back("\"" + event.expression + "\" has an intensity of 0");
    for (const track::BlinkEvent& event : script.blinks)
        if (event.intensity == 0)
            result.notes.push_back("the blink at " + format_number(event.start_s) +
                                   " s has an intensity of 0");
}

/// Reads and checks all that `risorius render` reads and checks before it draws.
/// Only a face knows which vertices soft tissue moves.
void check_pulled_vertices(const JsonCursor& json, const animate::RenderJob& job) {
    if (job.script.pulls.empty()) return;
    const scene::RigFiles& files = job.rig->files;
    const face::Face face(files.rig, files.mesh, job.quality, files.place());
    const std::vector<char> soft = face.diagnostics().soft_vertices();
    for (std::size_t i = 0; i < job.script.pulls.size(); ++i)
        if (!soft[static_cast<std::size_t>(job.script.pulls[i].vertex)])
            json.at("pulls").items()[i].at("vertex").fail(
                "a vertex of the mesh that soft tissue moves");
}

void check_script(const JsonCursor& json, CheckResult& result) {
    animate::RenderRequest request;
    request.script = result.file;
    request.script_in_memory = json;
    request.out = "check.mkv";  // nothing is written
    // A check is quick: it does not simulate the mouths of a rig that has not spoken yet.
    animate::RenderInputs inputs({.progress = {}, .stopped = stop_is_asked},
                                 animate::RenderInputs::Poses::kOnlyKnown);
    const animate::RenderJob job = animate::plan_render_job(request, inputs);
    result.notes = job.script.notes;
    result.notes.insert(result.notes.end(), job.speech.notes.begin(), job.speech.notes.end());
    note_late_events(job.script, result);
    note_idle_channels(job.script, result);
    const scene::RigFiles& files = job.rig->files;
    rig::place_head(files.rig, files.mesh, files.place());
    check_pulled_vertices(json, job);
}

void check_landmarks(const fs::path& file, CheckResult& result) {
    const auto atlas = rig::read_atlas_landmarks(
        JsonCursor::read_file(data_folder() / "rigs/standard/landmarks.json"));
    const auto landmarks = fitting::read_atlas_named_landmarks(file, atlas);
    for (const std::string& id : rig::required_landmarks())
        if (!landmarks.count(id)) result.notes.push_back("no \"" + id + "\", which fit needs");
    for (const std::string& id : rig::required_landmarks())
        if (const auto at = landmarks.find(id);
            at != landmarks.end() && at->second.confidence < fitting::kLeastConfidence)
            result.notes.push_back("\"" + id + "\" has a confidence of " +
                                   format_number(at->second.confidence) +
                                   ": fit needs it corrected, without the key");
}

// Only the skin has to be a manifold surface. Eyes and teeth may be open and intersect.
void check_mesh_file(const fs::path& file, CheckResult& result) {
    const geom::PolygonMesh mesh =
        io::read_mesh(file, {.metres_per_unit = 1, .stopped = stop_is_asked});
    geom::MeshCheckOptions options;
    options.scale = geom::Severity::kIgnore;  // its unit is unknown
    for (std::size_t g = 0; g < mesh.group_names.size(); ++g)
        if (fitting::role_suggested_by(mesh.group_names[g]) == "skin")
            options.groups.push_back(static_cast<int>(g));
    const geom::MeshReport report = geom::inspect_mesh(mesh, file.string(), options);
    for (const geom::MeshFinding& finding : report.findings)
        if (finding.severity == geom::Severity::kError)
            throw Error(
                finding.place, finding.expected,
                finding.found +
                    (geom::can_be_repaired(finding.check) ? " (fit --repair mends a scan)" : ""));
    for (const geom::MeshFinding& finding : report.findings)
        result.notes.push_back(readable_text(finding.message()));
    note_pictures(mesh, result);
}

void check(CheckResult& result, const ProgressMonitor& monitor) {
    if (result.file.extension() != ".json") {
        result.format = "mesh";
        return check_mesh_file(result.file, result);
    }
    const JsonCursor json = JsonCursor::read_file(result.file);
    const std::vector<std::string> formats = schema_formats();
    const std::string format =
        json.at("format").one_of(std::vector<std::string_view>(formats.begin(), formats.end()));
    result.format = format.substr(std::string("risorius-").size());
    if (result.format == "script") check_script(json, result);
    if (result.format == "design") result.notes = stimuli::plan_batch(result.file, monitor).notes;
    if (result.format == "experiment") figures::check_experiment(json);
    if (result.format == "landmarks") check_landmarks(result.file, result);
    if (result.format == "rig") check_rig(result.file, result);
    if (result.format == "study") study::check_study(result.file);
    if (result.format == "utterance") speech::read_utterance(json, speech::PhoneTable::standard());
    // The readers give the best messages. The schema also covers formats that only programs write, and keys that only a run
    // reads.
    check_against_schema(json, format);
}

}  // namespace

CheckResult check_file(const fs::path& file, const ProgressMonitor& monitor) {
    CheckResult result{.file = file, .format = "", .error = "", .notes = {}};
    try {
        check(result, monitor);
    } catch (const Error& error) {
        result.error = error.what();
    }
    return result;
}

}  // namespace risorius::cli
