// SPDX-License-Identifier: MIT
#include "tools/risorius/studio_head.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/fitting/part_guess.h"
#include "risorius/io/read_mesh.h"
#include "risorius/landmarks/propose_landmarks.h"
#include "risorius/report/atomic_file.h"
#include "risorius/rig/rig_description.h"
#include "risorius/view/scene_frame.h"
#include "tools/risorius/project_files.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

const std::set<std::string>& mesh_endings() {
    static const std::set<std::string> endings{".obj",  ".ply", ".stl", ".glb",
                                               ".gltf", ".fbx", ".dae"};
    return endings;
}

/// A rig or a file of landmarks is not written over without asking, once for all files.
void ask_to_replace(const JsonCursor& message, const std::vector<fs::path>& files) {
    const auto replace = message.find("replace");
    if (replace && replace->boolean()) return;
    std::string names;
    for (const fs::path& file : files)
        if (fs::exists(file))
            names += (names.empty() ? "" : " and ") + in_quotes(file.filename().string());
    if (!names.empty()) message.fail("consent to replace " + names, "none");
}

}  // namespace

bool is_mesh_file(const fs::path& file) {
    return mesh_endings().contains(file.extension().string());
}

std::string StudioHead::name_of(const fs::path& file) const {
    return file.lexically_proximate(folder_).generic_string();
}

std::string StudioHead::meshes() const {
    constexpr std::size_t kMost = 200;
    std::vector<std::string> names;
    std::error_code ignored;
    for (fs::recursive_directory_iterator at(folder_, fs::directory_options::skip_permission_denied,
                                             ignored);
         at != fs::recursive_directory_iterator() && names.size() < kMost; at.increment(ignored)) {
        const bool hidden = at->path().filename().string().starts_with(".");
        if (at.depth() > 2 || hidden) at.disable_recursion_pending();
        if (mesh_endings().contains(at->path().extension().string()) && !hidden)
            names.push_back(name_of(at->path()));
    }
    std::sort(names.begin(), names.end());
    return json_text(json_object({{"type", "meshes"}, {"files", names}}));
}

std::string StudioHead::mesh(const JsonCursor& message) {
    message.allow_keys({"type", "id", "path"});
    const JsonCursor path = message.at("path");
    const fs::path file = in_project(folder_, path, mesh_endings(), "a mesh");
    const geom::PolygonMesh mesh = io::read_mesh(file);
    open_ = Opened{file, mesh.from_file.inverse(),
                   std::set<std::string>(mesh.group_names.begin(), mesh.group_names.end())};
    view::MeshLabels labels{.file = name_of(file), .rig = name_of(rig_file())};
    for (const std::string_view role : rig::part_roles()) labels.roles.emplace_back(role);
    for (const std::string& group : mesh.group_names)
        labels.role_of_group.push_back(
            mesh.group_names.size() == 1 ? "skin" : fitting::role_suggested_by(group));
    return view::encode_mesh(mesh, labels);
}

std::map<std::string, std::vector<std::string>> StudioHead::parts_of(
    const JsonCursor& message) const {
    std::map<std::string, std::vector<std::string>> parts;
    const auto given = message.find("parts");
    if (!given) return parts;
    const auto& known = rig::part_roles();
    for (const std::string& role : given->keys()) {
        const JsonCursor groups = given->at(role);
        if (std::find(known.begin(), known.end(), role) == known.end())
            groups.fail("a role of a part", in_quotes(role));
        for (const JsonCursor& group : groups.items()) {
            if (!open_->groups.contains(group.string())) group.fail("a group of the mesh");
            if (group.string().find(',') != std::string::npos)
                group.fail("a name without a comma");  // which separates groups in the option
            parts[role].push_back(group.string());
        }
    }
    return parts;
}

fs::path StudioHead::rig_file() const {
    return open_->file.parent_path() / (open_->file.stem().string() + ".rig.json");
}

fs::path StudioHead::write_landmarks(const JsonCursor& message) const {
    if (!open_) message.fail("a mesh that is open", "none");
    Json landmarks = Json::object();
    const JsonCursor given = message.at("landmarks");
    for (const std::string& id : given.keys()) {
        const Vec3 p = (open_->to_file * given.at(id).vec3().homogeneous()).head<3>();
        landmarks[id] = json_object({{"xyz", {p.x(), p.y(), p.z()}}});
    }
    const Json written = json_object({{"format", "risorius-landmarks"},
                                      {"version", 1},
                                      {"mesh", open_->file.filename().string()},
                                      {"landmarks", landmarks}});
    const fs::path file =
        open_->file.parent_path() / (open_->file.stem().string() + ".landmarks.json");
    const bool fits = message.at("type").string() == "fit";
    ask_to_replace(message, fits ? std::vector{file, rig_file()} : std::vector{file});
    const ReadingFormerOutput may_be_replaced;
    OutputSet outputs(file.parent_path(), OutputSet::Then::kRunGoesOn);
    report::write_text(outputs.file(file), json_text(written, 2) + "\n");
    outputs.commit();
    return file;
}

void StudioHead::fit(const JsonCursor& message, const fs::path& landmarks, serve::WebServer& server,
                     std::function<void(const std::string&)> tell) {
    if (fit_.running()) message.fail("one fit at a time", "another that runs");
    const fs::path rig = rig_file();
    std::vector<std::string> arguments{"fit", open_->file.string()};
    arguments.insert(arguments.end(), {"--landmarks", landmarks.string(), "--out", rig.string()});
    const std::pair<const char*, const char*> flags[]{
        {"quick", "--no-calibrate"}, {"cut_lips", "--cut-lips"}, {"repair", "--repair"}};
    for (const auto& [key, option] : flags)
        if (const auto on = message.find(key); on && on->boolean()) arguments.emplace_back(option);
    for (const auto& [role, groups] : parts_of(message))
        for (const std::string& group : groups)
            arguments.insert(arguments.end(), {"--part", role + "=" + group});
    const auto told = [this, rig = name_of(rig), mesh = name_of(open_->file),
                       tell = std::move(tell)](const char* state, double fraction,
                                               const std::string& text) {
        fit_told_ = json_text(json_object({{"type", "fit"},
                                           {"state", state},
                                           {"fraction", fraction},
                                           {"path", mesh},
                                           {"rig", rig},
                                           {"text", text}}));
        tell(fit_told_);
    };
    fit_.start(arguments, server,
               {.progress = [told](double fraction,
                                   const std::string& text) { told("running", fraction, text); },
                .ended =
                    [told](int exit_code, bool cancelled, const std::string& text) {
                        told(exit_code == 0 ? "done"
                             : cancelled    ? "cancelled"
                                            : "failed",
                             exit_code == 0 ? 1 : 0, text);
                    }});
    told("running", 0, "");
}

void StudioHead::find(const JsonCursor& message, serve::WebServer& server,
                      std::function<void(const std::string&)> done) {
    message.allow_keys({"type", "id", "parts"});
    if (!open_) message.fail("a mesh that is open", "none");
    if (searching_) message.fail("one search at a time", "another that runs");
    const auto parts = parts_of(message);
    searching_ = true;
    const Eigen::Matrix4d to_page = open_->to_file.inverse();
    search_ = std::make_unique<std::jthread>(
        [this, file = open_->file, path = name_of(open_->file), to_page, parts, &server, done] {
            Json told = json_object({{"type", "landmarks_found"}, {"path", path}});
            try {
                Json places = Json::object();
                for (const auto& [id, landmark] :
                     landmarks::propose_landmarks({.mesh = file, .parts = parts}).landmarks) {
                    const Vec3 p = (to_page * landmark.xyz.homogeneous()).head<3>();
                    places[id] = json_object(
                        {{"at", {p.x(), p.y(), p.z()}}, {"confidence", landmark.confidence}});
                }
                told["state"] = "done";
                told["landmarks"] = places;
            } catch (const std::exception& error) {
                told["state"] = "failed";
                told["text"] = error.what();
            }
            server.post([this, done, text = json_text(told)] {
                searching_ = false;
                done(text);
            });
        });
}

}  // namespace risorius::cli
