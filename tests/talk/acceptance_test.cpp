// SPDX-License-Identifier: MIT
// What speech must do on the simulated face of the adult, from the stored utterances of samples/talk: no voice is needed.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/scene/rig_files.h"
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
    for (const auto& [name, least_held] :
         {std::pair{"finnish.json", 7}, std::pair{"english.json", 7}}) {
        const CheckedSpeech speech = check(name);
        EXPECT_EQ(speech.reached, speech.total) << name;
        EXPECT_GE(speech.held, least_held) << name;
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
            EXPECT_LT(least, 2.5) << from_s;
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
