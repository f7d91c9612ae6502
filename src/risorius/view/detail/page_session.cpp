// SPDX-License-Identifier: MIT
#include "risorius/view/detail/page_session.h"

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/script.h"

namespace risorius::view {

std::unique_ptr<Session> open_page_session(const std::filesystem::path& script,
                                           const std::string& quality) {
    JsonCursor json = parse_json_text(read_json_text(script), script);
    const track::ScriptHeader header = track::read_script_header(json);
    const auto rig =
        std::make_shared<const scene::RigFiles>(scene::read_rig_files(header.rig_file));
    const auto read = [rig](const JsonCursor& changed) {
        track::ScriptDescription out =
            track::read_script(changed, rig->rig.channels(), rig->rig.facs, rig->rig.expressions);
        if (!out.says.empty())
            throw Error(changed.file().string() + ", events",
                        "no \"say\", which needs a voice: a program on your computer, as `risorius "
                        "view` has it",
                        "one");
        return out;
    };
    return std::make_unique<Session>(SessionInputs{rig, json, quality, read});
}

}  // namespace risorius::view
