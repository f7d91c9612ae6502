// SPDX-License-Identifier: MIT
// The syllables of samples/lipreading: all of them can be said, and the lips close in p, b and m beside every vowel.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "risorius/scene/rig_files.h"
#include "risorius/talk/say_event.h"
#include "risorius/talk/script_checker.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::talk {
namespace {

const std::filesystem::path kKit =
    std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples/lipreading";

const scene::RigFiles& reader_of_lips() {
    static const scene::RigFiles files =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    return files;
}

/// The script of the kit with one syllable, as the batch makes it.
JsonCursor syllable(const std::string& consonant, const std::string& vowel) {
    Json script = JsonCursor::read_file(kKit / "syllables.json").json();
    script["fps"] = 60;
    for (Json& phone : script["events"][0]["say"]["phones"]) {
        if (phone[0] == "${vowel}") phone[0] = vowel;
        if (phone[0] == "${symbol}") phone[0] = consonant;
    }
    return JsonCursor::from_json(script, (kKit / "syllables.json").string());
}

TEST(LipReadingKit, AllSyllablesMoveTheMouth) {
    const Json design = JsonCursor::read_file(kKit / "design.json").json();
    const Json& set = design["sets"][0];
    ASSERT_EQ(set["conditions"].size(), 12u);
    ASSERT_EQ(set["factors"]["vowel"].size(), 3u);
    const track::ChannelTable channels = reader_of_lips().rig.channels();
    for (const Json& condition : set["conditions"])
        for (const Json& vowel : set["factors"]["vowel"]) {
            const std::string name = vowel.get<std::string>() +
                                     condition["symbol"].get<std::string>() +
                                     vowel.get<std::string>();
            track::ScriptDescription script =
                track::read_script(syllable(condition["symbol"], vowel), channels,
                                   reader_of_lips().rig.facs, reader_of_lips().rig.expressions);
            const PlannedSpeech speech = plan_speech(script.says, script.header, reader_of_lips());
            EXPECT_TRUE(speech.notes.empty()) << name;
            ASSERT_EQ(speech.utterances.size(), 1u) << name;
            EXPECT_EQ(speech.utterances[0].utterance.phones.size(), 3u) << name;
            add_to_script(speech, script);
            const track::Timeline timeline(script, channels);
            double most = 0;
            for (double t_s = 0.4; t_s < 1.3; t_s += 0.01)
                most = std::max(most, timeline.at(t_s).excitation.maxCoeff());
            EXPECT_GT(most, 0.05) << name;
        }
}

TEST(LipReadingKit, TheLipsCloseInPBAndM) {
    ScriptChecker checker(reader_of_lips(), "video");
    for (const char* consonant : {"p", "b", "m"})
        for (const char* vowel : {"a", "i", "u"}) {
            const CheckedSpeech speech = checker.check(syllable(consonant, vowel));
            ASSERT_EQ(speech.total, 1) << vowel << consonant;
            EXPECT_EQ(speech.reached, 1) << vowel << consonant;
            EXPECT_NEAR(speech.closures[0][0].contact_s, speech.closures[0][0].closure_s, 0.025)
                << vowel << consonant;
        }
}

}  // namespace
}  // namespace risorius::talk
