// SPDX-License-Identifier: MIT
// What laboratories ask of scripts with speech: bursts of a face and a sound that meet to the sample, and noise of a known level.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "risorius/media/mono_sound.h"
#include "risorius/scene/rig_files.h"
#include "risorius/speech/windows.h"
#include "risorius/talk/detail/speech_noise.h"
#include "risorius/talk/say_event.h"
#include "risorius/track/script.h"

namespace risorius::talk {
namespace {

const std::filesystem::path kSamples =
    std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples/mcgurk";

PlannedSpeech planned_sets(const Json& events) {
    static const scene::RigFiles files =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    const Json script{{"format", "risorius-script"},
                      {"version", 1},
                      {"rig", files.file.string()},
                      {"duration_s", 2},
                      {"fps", 60},
                      {"events", events}};
    const track::ScriptDescription read =
        track::read_script(JsonCursor::from_json(script, (kSamples / "script.json").string()),
                           files.rig.channels(), files.rig.facs, files.rig.expressions);
    return plan_speech(read.says, read.header, files);
}

Json seen_and_heard(const char* seen, const char* heard, double soa_s) {
    const auto file = [](const char* name) {
        return Json{{"utterance", std::string(name) + ".utterance.json"}};
    };
    return {{{"say", file(seen)}, {"burst_s", 1}, {"sound", "none"}},
            {{"say", file(heard)}, {"burst_s", 1 + soa_s}, {"face", false}}};
}

TEST(SpeechSets, TheBurstsOfFaceAndSoundMeetToTheSample) {
    const speech::PhoneTable table = speech::PhoneTable::standard();
    for (const char* heard : {"apa", "aka", "ata"}) {
        const speech::Utterance u =
            speech::read_utterance(kSamples / (std::string(heard) + ".utterance.json"), table);
        const std::int64_t release = u.phones[1].release.value();
        EXPECT_DOUBLE_EQ(speech::first_burst_s(u, table).value(), u.seconds(release));
        for (const int soa_samples : {-10297, -1, 0, 1, 1470}) {
            const PlannedSpeech speech = planned_sets(
                seen_and_heard("apa", heard, static_cast<double>(soa_samples) / u.rate_hz));
            EXPECT_EQ(speech.sound_offset_samples + release, u.rate_hz + soa_samples) << heard;
            ASSERT_EQ(speech.utterances.size(), 2u);
            const PlacedUtterance& face = speech.utterances[0];
            EXPECT_NEAR(face.start_s + speech::first_burst_s(face.utterance, table).value(), 1,
                        1e-12);
            EXPECT_EQ(speech.sources.size(), 1u);
        }
    }
}

TEST(SpeechSets, ABurstNeedsAStop) {
    const Json events{{{"say", {{"phones", Json::array({Json::array({"a", 0.2})})}}},
                       {"burst_s", 1},
                       {"sound", "none"}}};
    EXPECT_NE(message_of([&] {
                  planned_sets(events);
              }).find("/events/0/burst_s: expected a stop or nasal in what is said, found none"),
              std::string::npos);
}

TEST(SpeechSets, NoiseHasTheAskedLevelAndTheSpectrumOfTheSpeech) {
    const speech::PhoneTable table = speech::PhoneTable::standard();
    const speech::Utterance u = speech::read_utterance(kSamples / "ata.utterance.json", table);
    const std::vector<float> sound = media::read_mono_sound(u.sound).samples;
    const NoisySpeech loud = with_noise(sound, u, -12, 3), again = with_noise(sound, u, -12, 3);
    EXPECT_EQ(loud.samples, again.samples);
    EXPECT_NE(loud.samples, with_noise(sound, u, -12, 4).samples);
    EXPECT_EQ(loud.before, u.rate_hz / 2 + u.rate_hz % 2);
    EXPECT_EQ(loud.samples.size(), sound.size() + 2 * static_cast<std::size_t>(loud.before));
    EXPECT_LE(*std::max_element(loud.samples.begin(), loud.samples.end()), 0.981f);
    // What is left when the speech is taken away
    double noise = 0, speech = 0, noise_lag = 0, speech_lag = 0, last_noise = 0;
    std::size_t spoken = 0;
    for (std::size_t i = 0; i < sound.size(); ++i) {
        const double n =
            loud.samples[i + static_cast<std::size_t>(loud.before)] / loud.gain - sound[i];
        noise += n * n;
        noise_lag += n * last_noise;
        last_noise = n;
    }
    for (const speech::Phone& phone : u.phones)
        for (std::int64_t i = std::max<std::int64_t>(1, phone.start);
             !phone.is_pause() && i < phone.end; ++i, ++spoken) {
            const double s = sound[static_cast<std::size_t>(i)];
            speech += s * s;
            speech_lag += s * sound[static_cast<std::size_t>(i - 1)];
        }
    const double snr_db = 10 * std::log10(speech / static_cast<double>(spoken) /
                                          (noise / static_cast<double>(sound.size())));
    EXPECT_NEAR(snr_db, -12, 0.5);  // of a part of the noise
    EXPECT_NEAR(noise_lag / noise, speech_lag / speech, 0.05);
}

}  // namespace
}  // namespace risorius::talk
