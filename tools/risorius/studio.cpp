// SPDX-License-Identifier: MIT
#include "tools/risorius/studio.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/io/read_mesh.h"
#include "risorius/report/atomic_file.h"
#include "risorius/talk/say_event.h"
#include "risorius/view/document.h"
#include "tools/risorius/project_files.h"
#include "tools/risorius/studio_page.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

Json new_script(const fs::path& rig) {
    return json_object({{"format", "risorius-script"},
                        {"version", 1},
                        {"rig", rig.generic_string()},
                        {"duration_s", 4},
                        {"channels", Json::object()},
                        {"events", Json::array()}});
}

std::string error_text(const Json& id, const std::string& text) {
    return json_text(json_object({{"type", "error"}, {"id", id}, {"message", text}}));
}

}  // namespace

Studio::Studio(const fs::path& file, const std::string& quality)
    : quality_(quality), start_(file.empty()) {
    const bool is_mesh = is_mesh_file(file);
    const fs::path given =
        file.empty() || is_mesh ? data_folder() / "rigs" / "adult" / "rig.json" : file;
    const fs::path place = file.empty() ? fs::current_path() : fs::absolute(file).parent_path();
    folder_ = fs::weakly_canonical(place);
    if (is_mesh) {
        (void)io::read_mesh(file);  // what is wrong with it is said before a page is opened
        mesh_ = file.filename().string();
    }
    head_ = std::make_unique<StudioHead>(folder_);
    drop_ = std::make_unique<StudioDrop>(folder_);
    export_ = std::make_unique<StudioExport>(folder_);
    open(given);
}

Studio::~Studio() = default;

void Studio::open(const fs::path& file) {
    OpenScript opened;
    const ReadingFormerOutput script_may_be_replaced;
    const std::string text = read_json_text(file);
    JsonCursor json = parse_json_text(text, file);
    if (format_of(json.json()) == "risorius-rig") {
        json = JsonCursor::from_json(new_script(fs::absolute(file)),
                                     (folder_ / "script.json").string());
    } else {
        opened.file = fs::absolute(file);
        opened.on_disk = text;
    }
    const track::ScriptHeader header = track::read_script_header(json);
    const std::shared_ptr<const animate::RigInput> rig = inputs_.rig(header.rig_file);
    const std::shared_ptr<const scene::RigFiles> files(rig, &rig->files);
    opened.session = std::make_unique<view::Session>(view::SessionInputs{
        files, json, quality_, [this, files](const JsonCursor& script) {
            const track::ScriptHeader head = track::read_script_header(script);
            if (fs::weakly_canonical(head.rig_file) != fs::weakly_canonical(files->file))
                script.at("rig").fail("the rig that is open; open the script anew for another");
            track::ScriptDescription read = track::read_script(
                script, files->rig.channels(), files->rig.facs, files->rig.expressions);
            const talk::PlannedSpeech speech =
                talk::plan_speech(read.says, read.header, *files, inputs_.mouth_poses());
            talk::add_to_script(speech, read);
            planned_ = sound_of(speech);
            return read;
        }});
    opened.rig = fs::weakly_canonical(files->file);
    opened.rig_files = files;
    perform_.finish();
    bones_.reset();  // waits: the bones are those of the session that goes
    skull_.reset();
    script_ = std::move(opened);
    sound_ = planned_;
    pictures_.clear();
    scene_ = std::make_shared<const std::string>(script_.session->scene());
}

void Studio::run(serve::WebServer& server, const std::function<bool()>& stopped) {
    server_ = &server;
    const serve::Handler handler{
        .opened = [this](serve::Peer& peer) { opened(peer); },
        .text = [this](serve::Peer& peer, const std::string& message) { text(peer, message); },
        .binary = [this](serve::Peer& peer, const std::string& bytes) { binary(peer, bytes); },
        .closed = [this](serve::Peer& peer) { closed(peer); },
        .tick = [this] { tick(); }};
    make_pictures(server);
    server.run(handler, [&] { return stopped() || idle_ticks_ > kTicksWithoutPage; });
    // First: what runs may take longer to end than a signal leaves time for (stop_signals.h).
    if (script_.session->dirty()) write_recovery();
    painter_.reset();
    bones_.reset();
    head_->finish();
    export_->finish();
    perform_.finish();
    thumbnails_.finish();
    voice_.finish();
}

Studio::Page* Studio::page_of(const serve::Peer& peer) {
    const auto found = std::find_if(pages_.begin(), pages_.end(),
                                    [&](const Page& page) { return page.peer == &peer; });
    return found == pages_.end() ? nullptr : &*found;
}

void Studio::greet(Page& page) {
    page.has_muscles = page.wants_muscles = page.wants_skull = page.has_skull = false;
    Json welcome = json_or_null(script_.session->welcome());
    welcome["steers"] = page.peer == pages_.front().peer;
    welcome["folder"] = folder_.string();
    welcome["file"] =
        script_.file.empty() ? Json() : Json(script_.file.lexically_proximate(folder_).string());
    if (!mesh_.empty()) welcome["mesh"] = mesh_;
    if (start_) welcome["start"] = true;
    page.peer->send_text(json_text(welcome));
    page.peer->send_binary(scene_);
    page.peer->send_text(script_.session->document());
    send_sound(page);
    for (const auto& picture : pictures_) page.peer->send_binary(picture);
    if (export_->running()) page.peer->send_text(export_->last());
    if (head_->fits()) page.peer->send_text(head_->fit_told());
    page.credit = kFirstCredit;
    pose_waits_ = true;
}

void Studio::opened(serve::Peer& peer) {
    pages_.push_back({&peer});
    ever_seen_ = true;
    idle_ticks_ = 0;
    greet(pages_.back());
}

void Studio::closed(serve::Peer& peer) {
    const bool steered = !pages_.empty() && pages_.front().peer == &peer;
    std::erase_if(pages_, [&](const Page& page) { return page.peer == &peer; });
    if (!steered) return;
    perform_.finish();
    script_.session->receive(
        json_text(json_object({{"type", "perform"}, {"values", Json::object()}})));
    // Nobody holds the skin any more.
    const Json state = json_or_null(script_.session->state());
    for (const Json& pull : state["pulls"])
        script_.session->receive(
            json_text(json_object({{"type", "pull_end"}, {"pull", pull["pull"]}})));
    if (!pages_.empty())
        pages_.front().peer->send_text(
            json_text(json_object({{"type", "steers"}, {"steers", true}})));
}

void Studio::send_sound(const Page& page) const {
    page.peer->send_text(sound_.message);
    if (sound_.wav) page.peer->send_binary(sound_.wav);
}

/// The document, and what it says when that has changed.
void Studio::tell_document(const std::string& document) {
    tell_all(document);
    if (same_sound(planned_, sound_)) return;
    sound_ = planned_;
    for (const Page& page : pages_) send_sound(page);
}

void Studio::tell_all(const std::string& message) {
    for (const Page& page : pages_) page.peer->send_text(message);
}

void Studio::text(serve::Peer& peer, const std::string& message) {
    Page* page = page_of(peer);
    if (!page) return;
    const Json json = json_or_null(message);
    const auto field = [&](const char* key) {
        return json.is_object() && json.contains(key) ? json[key] : Json();
    };
    const Json type = field("type");
    const auto is = [&](const char* name) { return type == Json(name); };
    if (is("credit")) {
        page->credit = std::min(page->credit + 1, kFirstCredit);
        return;
    }
    if (is("files")) {
        peer.send_text(list_of_scripts(folder_));
        return;
    }
    if (page != &pages_.front()) {
        peer.send_text(error_text(field("id"), "this page only looks: another one steers"));
        return;
    }
    try {
        const JsonCursor cursor = JsonCursor::from_json(json, "message");
        if (is("save")) {
            save(cursor);
        } else if (is("say")) {
            say(peer, cursor);
        } else if (is("meshes") || is("mesh") || is("save_landmarks") || is("fit") ||
                   is("cancel_fit") || is("find_landmarks")) {
            new_head(peer, type.get<std::string>(), cursor);
        } else if (is("camera")) {
            camera(cursor);
        } else if (is("thumbnail")) {
            thumbnail(cursor);
        } else if (is("render") || is("shapes") || is("cancel") || is("result")) {
            make(peer, type.get<std::string>(), cursor);
        } else if (is("open")) {
            open_for_all(listed_script(cursor));
        } else if (is("drop")) {
            drop_->begin(cursor);
        } else {
            if (is("sights")) page->wants_muscles = field("muscles") == Json(true);
            if (is("sights") && field("skull") == Json(true)) {
                page->wants_skull = true;
                make_skull();
            }
            if (page->wants_muscles &&
                !std::exchange(page->has_muscles, page->wants_muscles || page->has_muscles))
                peer.send_binary(std::make_shared<const std::string>(script_.session->muscles()));
            for (const std::string& reply : script_.session->receive(message))
                if (json_or_null(reply)["type"] == "document")
                    tell_document(reply);
                else
                    peer.send_text(reply);
            pose_waits_ = true;
        }
    } catch (const Error& error) {
        peer.send_text(error_text(field("id"), error.what()));
    } catch (const RunError& error) {
        peer.send_text(error_text(field("id"), error.what()));
    }
}

/// A script of the list: {"sample": "smile"} or {"path": below the folder}.
fs::path Studio::listed_script(const JsonCursor& message) const {
    if (const auto sample = message.find("sample"))
        return data_folder() / "samples" / fs::path(sample->string()).filename() / "script.json";
    return project_script(message.at("path"));
}

void Studio::thumbnail(const JsonCursor& message) {
    message.allow_keys({"type", "id", "sample", "path"});
    Json about = message.json();
    about.erase("id");
    thumbnails_.ask(listed_script(message), std::move(about), *server_,
                    [this](const std::string& text) { tell_all(text); });
}

void Studio::new_head(serve::Peer& peer, const std::string& type, const JsonCursor& message) {
    if (type == "meshes") return peer.send_text(head_->meshes());
    if (type == "cancel_fit") return head_->cancel_fit();
    if (type == "mesh")
        return peer.send_binary(std::make_shared<const std::string>(head_->mesh(message)));
    const auto tell = [this](const std::string& text) { tell_all(text); };
    if (type == "find_landmarks") {
        head_->find(message, *server_, tell);
        return tell_all(
            json_text(json_object({{"type", "landmarks_found"}, {"state", "running"}})));
    }
    message.allow_keys(
        {"type", "id", "landmarks", "replace", "quick", "cut_lips", "repair", "parts"});
    const fs::path file = head_->write_landmarks(message);
    const std::string name = file.lexically_proximate(folder_).generic_string();
    tell_all(json_text(json_object({{"type", "landmarks_saved"}, {"path", name}})));
    if (type != "fit") return;
    head_->fit(message, file, *server_, tell);
}

/// A script or a rig is opened; the page is told of anything else.
void Studio::dropped(const fs::path& file) {
    const ReadingFormerOutput script_may_be_replaced;
    const std::string name = file.filename().string();
    if (file.extension() == ".json" &&
        format_of(JsonCursor::read_file(file).json()) != "risorius-landmarks")
        return open_for_all(file);
    tell_all(json_text(
        json_object({{"type", "dropped"}, {"path", name}, {"mesh", is_mesh_file(file)}})));
}

void Studio::open_for_all(const fs::path& file) {
    if (script_.session->dirty()) write_recovery();
    open(file);
    start_ = false;
    mesh_.clear();
    for (Page& one : pages_) greet(one);
    make_pictures(*server_);
}

/// The page that steers may have a camera: what it sees moves the face.
void Studio::camera(const JsonCursor& message) {
    perform_.receive(message, script_.rig_files, *server_,
                     {.tell = [this](const std::string& text) { tell_all(text); },
                      .values =
                          [this](const std::map<std::string, double>& values) {
                              Json json = Json::object();
                              for (const auto& [name, value] : values) json[name] = value;
                              script_.session->receive(
                                  json_text(json_object({{"type", "perform"}, {"values", json}})));
                              pose_waits_ = true;
                          }});
}

/// A picture of the camera, or a piece of a file that was dropped.
void Studio::binary(serve::Peer& peer, const std::string& bytes) {
    if (pages_.empty() || &peer != pages_.front().peer) return;
    try {
        if (!StudioDrop::is_piece(bytes))
            perform_.picture(bytes);
        else if (const auto file = drop_->add(bytes))
            dropped(*file);
    } catch (const Error& error) {
        peer.send_text(error_text(nullptr, error.what()));
    }
}

/// The script as it is played, for what is made of it.
ScriptNow Studio::script_now() const {
    const std::string text = script_.session->script_text();
    ScriptNow now{script_.file, false, text, script_.rig};
    const ReadingFormerOutput script_may_be_replaced;
    std::error_code failed;
    now.saved = !script_.session->dirty() && fs::exists(script_.file, failed) &&
                read_json_text(script_.file) == script_.on_disk;
    return now;
}

void Studio::make(serve::Peer& peer, const std::string& type, const JsonCursor& message) {
    const auto tell = [this](const std::string& text) { tell_all(text); };
    if (type == "render") {
        export_->render(message, script_now(), *server_, tell);
    } else if (type == "shapes") {
        export_->shapes(message, script_now(), *server_, tell);
    } else if (type == "cancel") {
        export_->cancel();
    } else {
        peer.send_binary(std::make_shared<const std::string>(export_->result(message)));
    }
}

void Studio::tick() {
    const bool nobody = pages_.empty() && ever_seen_ && !export_->running() && !head_->fits();
    idle_ticks_ = nobody ? idle_ticks_ + 1 : 0;
    if (pages_.empty()) return;
    const auto begin = std::chrono::steady_clock::now();
    const bool moved = script_.session->tick();
    if (moved) {
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - begin;
        step_ms_ += 0.1 * (took.count() - step_ms_);
    }
    for (const std::string& event : script_.session->events()) tell_all(event);
    send_pose(moved);
}

/// A pose goes to every page that is ready for one. What a slow page misses is left out; the steps are not.
void Studio::send_pose(bool moved) {
    pose_waits_ = pose_waits_ || moved;
    if (!pose_waits_) return;
    const bool any = std::any_of(pages_.begin(), pages_.end(), [](const Page& page) {
        return page.credit > 0 && page.peer->waiting() < kMostWaiting;
    });
    if (!any) return;
    pose_waits_ = false;
    const auto pose = std::make_shared<const std::string>(script_.session->pose());
    Json state = json_or_null(script_.session->state());
    state["step_ms"] = std::round(step_ms_ * 10) / 10;
    const std::string text = json_text(state);
    for (Page& page : pages_) {
        if (page.credit == 0 || page.peer->waiting() >= kMostWaiting) continue;
        --page.credit;
        page.peer->send_text(text);
        page.peer->send_binary(pose);
    }
}

// Files

fs::path Studio::project_script(const JsonCursor& name) const {
    return in_project(folder_, name, {".json"}, "a file .json");
}

void Studio::save(const JsonCursor& message) {
    message.allow_keys({"type", "id", "path", "overwrite"});
    const auto path = message.find("path");
    if (!path && script_.file.empty()) message.fail("a name for the script", "none");
    const bool asked = message.has("overwrite") && message.at("overwrite").boolean();
    const fs::path file =
        path ? project_script(*path)
             : project_script(JsonCursor::from_json(
                   Json(script_.file.lexically_proximate(folder_).string()), "save"));
    const bool same = !script_.file.empty() && file == fs::weakly_canonical(script_.file);
    const ReadingFormerOutput script_may_be_replaced;
    if (!asked && fs::exists(file) && (!same || read_json_text(file) != script_.on_disk))
        message.fail("a file that nobody has changed meanwhile, or consent to replace it",
                     in_quotes(file.filename().string()));
    std::string text = script_.session->script_text();
    if (!same) {
        Json moved = json_or_null(text);
        const JsonCursor now =
            parse_json_text(text, script_.file.empty() ? folder_ / "script.json" : script_.file);
        const fs::path rig = fs::weakly_canonical(fs::absolute(now.at("rig").path()));
        const fs::path relative = rig.lexically_relative(file.parent_path());
        moved["rig"] = relative.empty() ? rig.generic_string() : relative.generic_string();
        text = view::Document(moved).text();
    }
    OutputSet outputs(file.parent_path(), OutputSet::Then::kRunGoesOn);
    report::write_text(outputs.file(file), text);
    outputs.commit();
    script_.session->saved();
    script_.file = file;
    script_.on_disk = text;
    tell_all(json_text(json_object(
        {{"type", "saved"}, {"path", file.lexically_proximate(folder_).generic_string()}})));
    tell_all(script_.session->document());
}

void Studio::write_recovery() const {
    const fs::path near = script_.file.empty() ? folder_ / "script.json" : script_.file;
    const fs::path file = folder_ / (near.stem().string() + ".recovered.json");
    try {
        OutputSet outputs(file.parent_path(), OutputSet::Then::kRunGoesOn);
        report::write_text(outputs.file(file), script_.session->script_text());
        outputs.commit();
    } catch (const std::exception&) {
        // The disk is full or read-only, and nobody is left to be told.
    }
}

}  // namespace risorius::cli
