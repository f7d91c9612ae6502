// SPDX-License-Identifier: MIT
// What the page calls (src/web/engine_worker.ts). Texts and bytes go through two buffers: the page writes into input() and reads
// from output(). A function that can fail returns 0 and leaves the message in the output.
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/face/quality.h"
#include "risorius/face/view/skull.h"
#include "risorius/view/detail/page_session.h"
#include "risorius/view/scene_frame.h"

namespace {

using risorius::Json;

std::string given, answer, quality = "preview";
std::unique_ptr<risorius::view::Session> session;

/// Makes an answer, or the message of what is thrown.
template <class Make>
int answered(Make make) {
    try {
        answer = make();
        return 1;
    } catch (const std::exception& error) {
        answer = error.what();
        return 0;
    }
}

std::string list(const std::vector<std::string>& texts) {
    Json out = Json::array();
    for (const std::string& text : texts) out.push_back(text);
    return risorius::json_text(out);
}

}  // namespace

extern "C" {

char* studio_input(int bytes) {
    given.assign(static_cast<std::size_t>(bytes), '\0');
    return given.data();
}
const char* studio_output() { return answer.data(); }
int studio_output_size() { return static_cast<int>(answer.size()); }

/// The input is the quality of the scripts that are opened from now on, a name of face::quality_named().
int studio_quality() {
    return answered([] {
        (void)risorius::face::quality_named(given);
        quality = given;
        return std::string();
    });
}
/// The input is the path of a script. The session that is open stays when this one cannot be opened.
int studio_open() {
    setenv("RISORIUS_DATA", "/", 1);  // where the page puts the files of the toolkit
    return answered([] {
        session = risorius::view::open_page_session(given, quality);
        return session->welcome();
    });
}
/// The input is a message of the page; the output is a list of messages, each a text of its own.
int studio_receive() {
    return answered([] { return list(session->receive(given)); });
}
/// 1: there is a new pose.
int studio_tick() { return session->tick() ? 1 : 0; }
int studio_events() {
    return answered([] { return list(session->events()); });
}
int studio_document() {
    return answered([] { return session->document(); });
}
int studio_scene() {
    return answered([] { return session->scene(); });
}
int studio_muscles() {
    return answered([] { return session->muscles(); });
}
int studio_skull() {
    constexpr double kBoneStep_mm = 2.5;  // as `risorius view`
    return answered([] {
        return risorius::view::encode_skull(
            risorius::face::estimate_skull(session->head(), session->rig(), kBoneStep_mm));
    });
}
int studio_pose() {
    return answered([] { return session->pose(); });
}
int studio_state() {
    return answered([] { return session->state(); });
}
/// The output is the script's file; the script counts as saved.
int studio_save() {
    return answered([] {
        session->saved();
        return session->script_text();
    });
}

}  // extern "C"
