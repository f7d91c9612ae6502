// SPDX-License-Identifier: MIT
#include "risorius/talk/script_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/read_file.h"
#include "risorius/talk/rig_voice_file.h"
#include "temporary_folder.h"

namespace risorius::talk {
namespace {

PlacedUtterance placed_at(double start_s, int rate_hz, const std::string& word) {
    PlacedUtterance out;
    out.start_s = start_s;
    out.utterance.rate_hz = rate_hz;
    out.utterance.samples = rate_hz;  // 1 s
    for (const auto& [symbol, from, to] : {std::tuple{"_", 0.0, 0.2}, std::tuple{"ɑ", 0.2, 0.5},
                                           std::tuple{"p", 0.5, 0.6}, std::tuple{"_", 0.6, 1.0}}) {
        speech::Phone phone;
        phone.symbol = symbol;
        phone.start = std::llround(from * rate_hz);
        phone.end = std::llround(to * rate_hz);
        if (phone.symbol == "p") {
            phone.closure = phone.start;
            phone.release = phone.end - rate_hz / 100;
        }
        out.utterance.phones.push_back(phone);
    }
    out.utterance.words.push_back({word, rate_hz / 5, 3 * rate_hz / 5});
    return out;
}

TEST(ScriptLabels, UtterancesAreMovedToTheTimeOfTheScript) {
    const std::vector<PlacedUtterance> said{placed_at(2, 16000, "two"),
                                            placed_at(0.5, 48000, "one")};
    const speech::Utterance all = utterance_of_script(said, 4);
    EXPECT_EQ(all.rate_hz, 48000);
    EXPECT_EQ(all.samples, 4 * 48000);
    ASSERT_EQ(all.phones.size(), 7u);  // pause a p pause a p pause
    EXPECT_DOUBLE_EQ(all.seconds(all.phones[1].start), 0.7);
    EXPECT_DOUBLE_EQ(all.seconds(all.phones[5].start), 2.5);
    EXPECT_DOUBLE_EQ(all.seconds(*all.phones[5].release), 2.59);
    ASSERT_EQ(all.words.size(), 2u);
    EXPECT_EQ(all.words[1].text, "two");
    check_utterance(all, speech::PhoneTable::standard(), "all");
    EXPECT_NE(script_textgrid(said, 4).find("name = \"closures\""), std::string::npos);
    EXPECT_EQ(script_textgrid({}, 4), "");
}

TEST(ScriptLabels, WhatOverlapsOrIsCutByTheEndIsLeftOut) {
    const speech::Utterance all = utterance_of_script(
        {placed_at(0, 16000, "one"), placed_at(0.2, 16000, "no"), placed_at(1.7, 16000, "cut")}, 2);
    ASSERT_EQ(all.phones.size(), 5u);  // pause a p pause a
    EXPECT_EQ(all.phones.back().symbol, "ɑ");
    EXPECT_EQ(all.phones.back().end, all.samples);
    check_utterance(all, speech::PhoneTable::standard(), "all");
}

/// Gives `files` a changed copy of the rig file beside its own voice.
template <typename Change>
void change(scene::RigFiles& files, const TemporaryFolder& folder, Change with) {
    Json rig = Json::parse(read_file(files.file, {"a rig", kMegabyte}));
    with(rig);
    std::filesystem::copy_file(voice_file_of(files.file), voice_file_of(folder / "rig.json"));
    std::ofstream(folder / "rig.json", std::ios::binary) << rig;
    files.file = folder / "rig.json";
}

TEST(MouthsOfARig, AreKeptWhenLooksOrUnitsChange) {
    scene::RigFiles files =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    EXPECT_TRUE(known_voice_of_rig(files));
    const TemporaryFolder folder;
    change(files, folder, [](Json& rig) {
        rig["name"] = "somebody";
        rig["appearance"]["seed"] = 77;
        rig["unit_gains"].erase("AU12");
    });
    EXPECT_TRUE(known_voice_of_rig(files));
}

TEST(MouthsOfARig, AreNotSimulatedForACheckOfAScript) {
    scene::RigFiles files =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    const TemporaryFolder folder;
    change(files, folder, [](Json& rig) { rig["tissue"]["damping_s"] = 0.0123; });
    track::ScriptHeader header;
    header.duration_s = 3;
    const JsonCursor say = JsonCursor::from_json(
        Json::parse(R"({"say": {"phones": [["a", 0.3]]}, "start_s": 1})"), "s.json");
    const PlannedSpeech planned = plan_speech({say}, header, files, {.may_simulate = false});
    EXPECT_TRUE(planned.sources.empty());
    EXPECT_EQ(planned.utterances.size(), 1u);
    ASSERT_EQ(planned.notes.size(), 1u);
    EXPECT_NE(planned.notes[0].find("rig.json are not simulated yet"), std::string::npos);
    // A run says that it simulates; it is stopped at once here.
    struct Stop {};
    EXPECT_THROW(plan_speech({say}, header, files, {.report = [](double) { throw Stop(); }}), Stop);
    EXPECT_FALSE(known_voice_of_rig(files));
}

}  // namespace
}  // namespace risorius::talk
