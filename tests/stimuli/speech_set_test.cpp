// SPDX-License-Identifier: MIT
// A ladder of asynchronies of a spoken syllable: what is seen stays, and the sound moves by what was asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "risorius/animate/frame_rows.h"
#include "risorius/media/wav_file.h"
#include "risorius/stimuli/batch.h"
#include "stimuli/batch_fixture.h"

namespace risorius::stimuli {
namespace {

class SpeechSet : public Batch {};

TEST_F(SpeechSet, MovesTheSoundAndNothingElse) {
    const std::string apa = RISORIUS_SOURCE_DIR "/samples/mcgurk/apa.utterance.json";
    Json json = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "syllables",
        "clips": {"quality": "draft", "ending": "mkv"}, "match": {"loudness": {"lufs": -30}},
        "experiment": {"programs": ["psychopy"], "answers": {"a": "yes"}},
        "sets": [{"name": "ladder", "clip": "soa_${soa_ms}", "factors": {"soa_ms": [-80, 0, 80]},
            "script": {"format": "risorius-script", "version": 1, "duration_s": 2, "fps": 30,
                "view": {"width_px": 48, "height_px": 48, "antialiasing": 1}}}]})");
    json["sets"][0]["script"]["rig"] = kAdult;
    json["sets"][0]["script"]["events"] = {
        {{"say", {{"utterance", apa}}}, {"burst_s", 1}, {"sound", "none"}},
        {{"say", {{"utterance", apa}}}, {"burst_s", "= 1 + soa_ms / 1000"}, {"face", false}}};
    const fs::path file = folder().path() / "ladder.json";
    std::ofstream(file) << json.dump();
    const BatchOptions set{.design = file, .out = folder().path() / "ladder", .workers = 2};
    const BatchReport report = make_batch(set);
    ASSERT_TRUE(report.complete) << (report.failed.empty() ? "" : report.failed[0].second);

    const animate::FrameRows rows = animate::frame_rows(text_of(set.out / "stimuli/stimuli.tsv"));
    std::map<int, Json> sidecars;
    std::map<int, double> heard_s;
    const std::map<int, std::string> names{{-80, "soaM80"}, {0, "soa0"}, {80, "soa80"}};
    int row = 0;
    for (const auto& [soa_ms, clip] : names) {
        const std::string stem = (set.out / "stimuli/stim-").string() + clip;
        sidecars[soa_ms] = Json::parse(text_of(stem + "_audiovideo.json"));
        EXPECT_NEAR(rows.number(row, rows.column("soa_measured_ms")), soa_ms, 1) << clip;
        EXPECT_NEAR(rows.number(row, rows.column("release_s")), 1, 1e-3);
        EXPECT_LT(rows.number(row, rows.column("closure_s")),
                  rows.number(row, rows.column("release_s")));
        EXPECT_GT(rows.number(row, rows.column("lip_onset_s")), 0.2);
        EXPECT_LT(rows.number(row, rows.column("lip_onset_s")), 1);
        ++row;
        const media::Sound sound = media::read_sound(stem + "_audio.wav");
        float peak = 0;
        for (const float sample : sound.samples) peak = std::max(peak, std::abs(sample));
        const auto first = std::find_if(sound.samples.begin(), sound.samples.end(),
                                        [&](float one) { return std::abs(one) > 0.05f * peak; });
        heard_s[soa_ms] = static_cast<double>(first - sound.samples.begin()) / sound.rate_hz;
    }
    for (const auto& [soa_ms, sidecar] : sidecars) {
        EXPECT_EQ(sidecar.at("pictures_sha256"), sidecars.at(0).at("pictures_sha256"));
        EXPECT_NEAR(sidecar.at("audio").at("gain_db").get<double>(),
                    sidecars.at(0).at("audio").at("gain_db").get<double>(), 1e-9);
        // Sound minus onset of the lips
        EXPECT_NEAR(heard_s.at(soa_ms) - heard_s.at(0), soa_ms / 1000.0, 1e-3) << soa_ms;
        EXPECT_EQ(sidecar.at("speech").at("lip_onset_s"),
                  sidecars.at(0).at("speech").at("lip_onset_s"));
    }
    // The program for PsychoPy plays the sound, and its onset has a code.
    EXPECT_NE(text_of(set.out / "experiment/conditions.csv").find("stim-soa80_audio.wav"),
              std::string::npos);
    EXPECT_NE(text_of(set.out / "triggers.tsv").find("soa80\tsound_onset\t5\t"), std::string::npos);
    EXPECT_EQ(make_batch(set).kept, 3);
}

}  // namespace
}  // namespace risorius::stimuli
