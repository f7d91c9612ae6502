// SPDX-License-Identifier: MIT
// What speech must do on the simulated face of the adult, from the stored utterances of samples/talk: no voice is needed.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/scene/rig_files.h"
#include "risorius/speech/phone_table.h"
#include "risorius/talk/detail/rig_voice.h"
#include "risorius/talk/rig_voice_file.h"
#include "risorius/talk/script_checker.h"

namespace risorius::talk {
namespace {

const std::filesystem::path kSource = RISORIUS_SOURCE_DIR;

const scene::RigFiles& adult() {
    static const scene::RigFiles files = scene::read_rig_files(kSource / "rigs/adult/rig.json");
    return files;
}

class Talking : public testing::Test {
  protected:
    static CheckedSpeech check(const char* name) {
        static ScriptChecker checker(adult(), "video");
        return checker.check(JsonCursor::read_file(kSource / "samples/talk" / name));
    }
};

TEST_F(Talking, ThePosesOfTheAdultAreThoseOfItsRig) {
    // Otherwise they would be simulated: run `risorius fit --voice rigs/adult/rig.json` after a change of the rig or its muscles.
    bool simulated = false;
    const RigVoice voice = voice_of_rig(adult(), [&](double) {
        simulated = true;
        throw std::runtime_error("rig.voice.json is of another rig");
    });
    EXPECT_FALSE(simulated);
    EXPECT_GT(voice.poses().size(), 150u);
}

TEST_F(Talking, LipsCloseInEveryClosureOfBothSentences) {
    for (const auto& [name, closures] :
         {std::pair{"finnish.json", 7}, std::pair{"english.json", 8}}) {
        const CheckedSpeech speech = check(name);
        EXPECT_EQ(speech.total, closures) << name;
        EXPECT_EQ(speech.held, speech.total) << name;
        for (const ClosureCheck& closure : speech.closures[0]) {
            EXPECT_LT(closure.max_gap_mm, 1) << name << ", phone " << closure.phone;
            // The lips meet at the closure, or a little before it; the first closure begins from lips at rest.
            if (closure.phone > 0) {
                EXPECT_LT(closure.contact_s - closure.closure_s, 0.045)
                    << name << ", phone " << closure.phone;
            }
        }
    }
}

TEST_F(Talking, LabiodentalsTouchTheTeethAndVowelsAreApart) {
    const CheckedSpeech speech = check("finnish.json");
    const PlacedUtterance& placed = speech.utterances[0];
    double a_gap = 0, i_gap = 0, i_width = 0, u_width = 0, u_forward = 0, i_forward = 0;
    int as = 0, is = 0, us = 0;
    for (const speech::Phone& phone : placed.utterance.phones) {
        const double from_s = placed.start_s + placed.utterance.seconds(phone.start),
                     to_s = placed.start_s + placed.utterance.seconds(phone.end);
        const auto middle = [&](double Mouth::*measure) {
            return speech.track.at((from_s + to_s) / 2, measure);
        };
        if (phone.symbol == "ʋ") {
            double least = 100;
            for (double t = from_s; t < to_s; t += 0.005)
                least = std::min(least, speech.track.at(t, &Mouth::teeth));
            EXPECT_LT(least, 1) << from_s;
            EXPECT_LT(middle(&Mouth::teeth), 1.5) << from_s;
        }
        if (phone.symbol == "ɑ") {
            a_gap += middle(&Mouth::gap);
            ++as;
        }
        if (phone.symbol == "i") {
            i_gap += middle(&Mouth::gap);
            i_width += middle(&Mouth::width);
            i_forward += middle(&Mouth::lower_protrusion);
            ++is;
        }
        if (phone.symbol == "u" || phone.symbol == "y") {
            u_width += middle(&Mouth::width);
            u_forward += middle(&Mouth::lower_protrusion);
            ++us;
        }
    }
    ASSERT_TRUE(as > 2 && is > 2 && us > 1);
    EXPECT_GT(a_gap / as, 2 * i_gap / is);
    EXPECT_GT(i_width / is - u_width / us, 6);
    EXPECT_GT(u_forward / us - i_forward / is, 3);
}

/// Sustained, as phones.tsv asks: openings within 2.5 mm, width and protrusion within 1.5 mm. Lips that are pursed alone close on
/// each other, and those that are only turned outwards stay wide.
TEST_F(Talking, RoundedVowelsAreSmallAndOpenAndLipsCloseBesideThem) {
    static ScriptChecker checker(adult(), "video");
    const Json phones =
        Json::parse(R"([["_", 0.3], ["u", 0.3], ["_", 0.25], ["y", 0.3], ["_", 0.25],
        ["o", 0.3], ["_", 0.25], ["ø", 0.3], ["_", 0.25], ["u", 0.15], ["p", 0.12], ["u", 0.15], ["_", 0.25]])");
    const CheckedSpeech speech = checker.check(JsonCursor::from_json(
        Json{{"format", "risorius-script"},
             {"version", 1},
             {"rig", (kSource / "rigs/adult/rig.json").generic_string()},
             {"duration_s", 3.6},
             {"events", {{{"say", {{"phones", phones}}}, {"start_s", 0.0}, {"sound", "none"}}}}},
        "script"));
    const speech::PhoneTable table = speech::PhoneTable::standard();
    const PlacedUtterance& placed = speech.utterances.at(0);
    int vowels = 0;
    for (const speech::Phone& phone : placed.utterance.phones) {
        const double from_s = placed.start_s + placed.utterance.seconds(phone.start),
                     to_s = placed.start_s + placed.utterance.seconds(phone.end);
        if (phone.symbol == "_" || phone.symbol == "p" || to_s - from_s < 0.25) continue;
        ++vowels;
        const auto middle = [&](double Mouth::*measure) {
            return speech.track.at((from_s + to_s) / 2, measure);
        };
        const auto target = [&](speech::Parameter parameter) {
            return speech::value_of(table.phone(phone.symbol, phone.symbol).target, parameter);
        };
        const double protrusion =
            (middle(&Mouth::upper_protrusion) + middle(&Mouth::lower_protrusion)) / 2;
        EXPECT_NEAR(middle(&Mouth::gap), target(speech::Parameter::kGap), 2.5) << phone.symbol;
        EXPECT_NEAR(middle(&Mouth::width), target(speech::Parameter::kWidth), 1.5) << phone.symbol;
        EXPECT_NEAR(protrusion, target(speech::Parameter::kProtrusion), 1.5) << phone.symbol;
        // Apart from a closed mouth and from one at rest
        EXPECT_LT(middle(&Mouth::width), -8.5) << phone.symbol;
        EXPECT_GT(middle(&Mouth::gap), 3.5) << phone.symbol;
    }
    EXPECT_EQ(vowels, 4);
    EXPECT_EQ(speech.total, 1);
    // As planned; `risorius speak` closes the rest, which it sees in its own simulation.
    EXPECT_LT(speech.missing_mm, 3.5);
}

TEST_F(Talking, LipsAreStillInSilenceAndNeverTooFast) {
    const CheckedSpeech speech = check("english.json");
    double fastest = 0;
    for (std::size_t i = 1; i < speech.track.mouths.size(); ++i)
        fastest = std::max(fastest, std::abs(speech.track.mouths[i].gap_middle -
                                             speech.track.mouths[i - 1].gap_middle) /
                                        kMouthStep_s);
    EXPECT_LT(fastest, 500);  // Samples of 4 ms; contact begins and ends within one.
    for (double t = 0; t < 0.05; t += 0.01) EXPECT_LT(speech.track.at(t, &Mouth::gap), 0.3);
}

}  // namespace
}  // namespace risorius::talk
