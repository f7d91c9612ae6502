// SPDX-License-Identifier: MIT
// The studio says a text.
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/talk/rig_voice_file.h"
#include "risorius/talk/say_edit.h"
#include "tools/risorius/studio.h"

namespace risorius::cli {

/// The face says a text from the playhead on, at once: its closures are not checked before.
void Studio::say(serve::Peer& peer, const JsonCursor& message) {
    message.allow_keys({"type", "id", "text", "voice", "program"});
    if (!talk::known_voice_of_rig(*script_.rig_files)) return make_voice(message);
    talk::VoiceRequest request;
    request.text = message.at("text").string();
    if (const auto voice = message.find("voice")) request.language = voice->string();
    if (const auto program = message.find("program")) request.program = program->string();
    const Json state = json_or_null(script_.session->state()),
               script = json_or_null(script_.session->script_text());
    const double at_s = state["t_s"].get<double>();
    const talk::SayEdit said = talk::say_edit(script, request, at_s);
    const std::vector<std::string> replies = script_.session->receive(
        json_text(json_object({{"type", "edit"}, {"edits", said.edits}, {"gesture", ""}})));
    bool done = true;
    for (const std::string& reply : replies) {
        const bool document = json_or_null(reply)["type"] == "document";
        if (document)
            tell_document(reply);
        else
            peer.send_text(reply);
        done = done && document;
    }
    if (!done) return;
    script_.session->receive(json_text(json_object({{"type", "seek"}, {"t_s", at_s}})));
    script_.session->receive(json_text(json_object({{"type", "play"}})));
    pose_waits_ = true;
}

/// The mouths that speech needs are simulated once for each rig, which takes minutes: in a process of its own. Then the text is said, if the rig
/// is still that one.
void Studio::make_voice(const JsonCursor& message) {
    if (voice_.running()) message.fail("mouths that are simulated", "some that are not yet");
    const auto tell = [this](const Json& state) { tell_all(json_text(state)); };
    const std::filesystem::path rig = script_.rig_files->file;
    tell(json_object({{"type", "voice"}, {"state", "running"}, {"fraction", 0}}));
    voice_.start(
        {"fit", "--voice", rig.string()}, *server_,
        {.progress =
             [tell](double fraction, const std::string&) {
                 tell(json_object(
                     {{"type", "voice"}, {"state", "running"}, {"fraction", fraction}}));
             },
         .ended =
             [this, tell, rig, asked = message.json()](int exit_code, bool,
                                                       const std::string& text) {
                 const bool done = exit_code == 0;
                 tell(json_object(
                     {{"type", "voice"}, {"state", done ? "done" : "failed"}, {"text", text}}));
                 if (!done || pages_.empty() || script_.rig_files->file != rig) return;
                 this->text(*pages_.front().peer, json_text(asked));
             }});
}

}  // namespace risorius::cli
