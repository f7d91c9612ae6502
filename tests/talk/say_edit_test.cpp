// SPDX-License-Identifier: MIT
#include "risorius/talk/say_edit.h"

#include <gtest/gtest.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/data_folder.h"
#include "risorius/face/quality.h"
#include "risorius/scene/rig_files.h"
#include "risorius/talk/say_event.h"
#include "risorius/track/timeline.h"

namespace risorius::talk {
namespace {

const std::filesystem::path kRig =
    std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json";

bool has_espeak() {
    try {
        speak({.text = "a", .language = "en-us", .program = "espeak"},
              speech::PhoneTable::standard());
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

Json short_script() {
    return {{"format", "risorius-script"},
            {"version", 1},
            {"rig", kRig.string()},
            {"duration_s", 1},
            {"events", Json::array()}};
}

/// A script with edits that add or replace a value.
Json edited(Json script, const Json& edits) {
    for (const Json& edit : edits) {
        const Json::json_pointer place(edit["path"].get<std::string>());
        script[place] = edit["value"];
    }
    return script;
}

PlannedSpeech planned(const Json& script, const scene::RigFiles& files,
                      track::ScriptDescription& read) {
    read = track::read_script(JsonCursor::from_json(script, "script.json"), files.rig.channels(),
                              files.rig.facs, files.rig.expressions);
    PlannedSpeech out = plan_speech(read.says, read.header, files);
    add_to_script(out, read);
    return out;
}

TEST(SayEdit, AddsAnEventThatHasRoomAndTheOnlySound) {
    if (!has_espeak()) GTEST_SKIP() << "risorius-voice-espeak is not built";
    const scene::RigFiles files = scene::read_rig_files(kRig);
    const VoiceRequest request{.text = "Good morning.", .program = "espeak"};
    const SayEdit first = say_edit(short_script(), request, 0);
    EXPECT_EQ(first.wav.substr(0, 4), "RIFF");
    EXPECT_GE(first.start_s, 0.2);
    EXPECT_LE(first.start_s, 0.4);
    const Json once = edited(short_script(), first.edits);
    EXPECT_EQ(once["duration_s"], first.end_s);
    const SayEdit second = say_edit(once, request, 0.5);
    EXPECT_NEAR(second.start_s - first.start_s, 0.5, 0.0015);
    const Json twice = edited(once, second.edits);
    ASSERT_EQ(twice["events"].size(), 2u);
    EXPECT_EQ(twice["events"][0]["sound"], "none");
    track::ScriptDescription read;
    const PlannedSpeech speech = planned(twice, files, read);
    EXPECT_EQ(speech.utterances.size(), 2u);
    EXPECT_EQ(speech.sources.size(), 2u);
    EXPECT_FALSE(speech.sound_file.empty());
}

TEST(SayEdit, TheFirstPictureComesWithinHalfASecondOfTheText) {
    if (!has_espeak()) GTEST_SKIP() << "risorius-voice-espeak is not built";
    const scene::RigFiles files = scene::read_rig_files(kRig);
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    // Processor time of this process; the voice is another one, and takes 20 ms.
    const std::clock_t begin = std::clock();
    const SayEdit said = say_edit(
        short_script(), {.text = "My mother bought five blue papers.", .program = "espeak"}, 0);
    track::ScriptDescription read;
    const PlannedSpeech speech = planned(edited(short_script(), said.edits), files, read);
    const track::Timeline timeline(read, files.rig.channels());
    const face::DriveAt drive = [&](double t_s) { return timeline.at(t_s); };
    face.start(drive);
    const face::FacePose pose = face.pose_at(0, drive);
    const double took_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_LT(took_s, 0.5);
    EXPECT_TRUE(pose.vertices.allFinite());
}

}  // namespace
}  // namespace risorius::talk
