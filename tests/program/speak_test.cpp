// SPDX-License-Identifier: MIT
// risorius speak from labels and utterances to files of text, as users call it. No voice is needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/json_text.h"
#include "risorius/core/sha256.h"
#include "risorius/media/detail/sound.h"
#include "risorius/media/video_reader.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

class Speak : public testing::Test {
  protected:
    ShellResult speak(const std::string& arguments) const {
        return run_shell("cd '" + folder_.path().string() + "' && '" +
                         (std::filesystem::path(RISORIUS_BINARY_DIR) / "risorius").string() +
                         "' speak " + arguments + " 2>&1");
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    TemporaryFolder folder_;
};

TEST_F(Speak, LabelsBecomeOtherLabelsAndCurves) {
    write("anna.ctm", "anna 1 0.15 0.10 AA1\nanna 1 0.25 0.09 P\nanna 1 0.34 0.12 AA0\n");
    const auto [code, said] = speak("--labels anna.ctm -o anna.TextGrid");
    EXPECT_EQ(code, 0) << said;
    EXPECT_EQ(said, "anna.TextGrid: 4 phones, 0 words, 0.460 s\n");
    EXPECT_NE(bytes_of(folder_ / "anna.TextGrid").find("text = \"ɑ\""), std::string::npos);
    for (const char* out : {"a.utterance.json", "a.vtt", "a.ctm", "a.tsv", "a.curves.tsv"}) {
        const auto [one, message] = speak("--labels anna.TextGrid -o " + std::string(out));
        EXPECT_EQ(one, 0) << message;
        EXPECT_TRUE(std::filesystem::exists(folder_ / out)) << out;
    }
    // The same phones by way of an utterance
    EXPECT_EQ(speak("a.utterance.json -o b.curves.tsv").code, 0);
    EXPECT_EQ(bytes_of(folder_ / "a.curves.tsv"), bytes_of(folder_ / "b.curves.tsv"));
}

TEST_F(Speak, AVoiceLeavesNothingBehind) {
    // It would look for a sound server in these folders.
    for (const char* name : {"home", "temporary"})
        std::filesystem::create_directory(folder_ / name);
    const ShellResult spoken =
        run_shell("cd '" + folder_.path().string() +
                  "' && env -u XDG_RUNTIME_DIR HOME=$PWD/home TMPDIR=$PWD/temporary '" +
                  (std::filesystem::path(RISORIUS_BINARY_DIR) / "risorius").string() +
                  "' speak ah --program espeak -o ah.TextGrid 2>&1");
    if (spoken.output.find("none on this machine") != std::string::npos)
        GTEST_SKIP() << spoken.output;
    EXPECT_EQ(spoken.code, 0) << spoken.output;
    for (const char* name : {"home", "temporary"})
        EXPECT_TRUE(std::filesystem::is_empty(folder_ / name)) << name;
}

TEST_F(Speak, MistakesAreToldWithTheirPlace) {
    write("bad.ctm", "anna 1 0.15 0.10 AAA\n");
    const auto [code, said] = speak("--labels bad.ctm -o x.TextGrid");
    EXPECT_EQ(code, 2);
    EXPECT_EQ(said,
              "risorius: bad.ctm:1: expected a symbol of the set \"arpabet\" (the nearest is "
              "\"AA\"), found \"AAA\"\n");
    EXPECT_EQ(speak("-o x.TextGrid").code, 2);
    write("a.xyz", "?");
    const auto [unknown, message] = speak("--labels a.xyz -o x.TextGrid");
    EXPECT_EQ(unknown, 2);
    EXPECT_NE(message.find("a.xyz: expected a file of labels: textgrid, ctm"), std::string::npos)
        << message;
    EXPECT_EQ(folder_.listing(), (std::set<std::string>{"a.xyz", "bad.ctm"}));
}

TEST_F(Speak, AVideoWithSpeechHasItsLabelsBesideIt) {
    write("s.json",
          R"({"format": "risorius-script", "version": 1, "rig": ")" +
              (std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json").string() +
              R"(", "duration_s": 1, "fps": 5,
        "events": [{"say": {"phones": [["a", 0.2], ["p", 0.12], ["a", 0.2]]}, "start_s": 0.4}]})");
    const ShellResult result =
        run_shell("cd '" + folder_.path().string() + "' && '" +
                  (std::filesystem::path(RISORIUS_BINARY_DIR) / "risorius").string() +
                  "' render s.json --draft --size 64x64 --quiet -o v.mp4 2>&1");
    ASSERT_EQ(result.code, 0) << result.output;
    const std::string labels = bytes_of(folder_ / "v.mp4.speech.TextGrid");
    EXPECT_NE(labels.find("xmax = 1\n"), std::string::npos);
    EXPECT_NE(labels.find("name = \"visemes\""), std::string::npos);
    EXPECT_NE(labels.find("xmin = 0.6\n"), std::string::npos) << labels;  // the p
}

TEST_F(Speak, NothingIsLeftWhenTheVideoCannotBeMade) {
    write("anna.ctm", "anna 1 0.15 0.10 AA1\nanna 1 0.25 0.09 P\nanna 1 0.34 0.12 AA0\n");
    // An ending that no video has, an option that is no number, and one that is found wrong when the script is there
    for (const char* wrong : {"-o a.xyz", "-o a.json --jaw nan", "-o a.json --jaw ''",
                              "-o a.mp4 --passes 0 --camera moon", "-o a.mp4 --size 63x63"}) {
        const auto [code, said] = speak("--labels anna.ctm --fps 5 --draft " + std::string(wrong));
        EXPECT_EQ(code, 2) << wrong << ": " << said;
        EXPECT_EQ(folder_.listing(), std::set<std::string>{"anna.ctm"}) << wrong;
    }
}

// What the script names is read before it appears under its name: the sound by FFmpeg, too.
TEST_F(Speak, ASoundIsReadBeforeItAppears) {
    if (!std::filesystem::exists(RISORIUS_BINARY_DIR "/risorius-voice-espeak"))
        GTEST_SKIP() << "built without the library espeak-ng";
    const auto [code, said] = speak("Ah. --program espeak --passes 0 -o a.json");
    EXPECT_EQ(code, 0) << said;
    EXPECT_EQ(folder_.listing(),
              (std::set<std::string>{"a.json", "a.speech.tsv", "a.utterance.json", "a.wav"}));
}

TEST_F(Speak, AScriptAndItsUtteranceAppearTogetherAndAreReadBefore) {
    write("anna.ctm", "anna 1 0.15 0.10 AA1\nanna 1 0.25 0.09 P\nanna 1 0.34 0.12 AA0\n");
    const auto [code, said] = speak(
        "--labels anna.ctm --fps 5 --draft --passes 0 --size 64x64 --json -o out/a.mp4 "
        "2>/dev/null");
    ASSERT_EQ(code, 0) << said;
    const Json report = json_or_null(said);
    ASSERT_TRUE(report.is_object()) << said;
    EXPECT_EQ(report.at("phones"), 4);
    EXPECT_EQ(report.at("closures"), 1);
    for (const char* file : {"out/a.mp4", "out/a.mp4.json", "out/a.mp4.frames.tsv",
                             "out/a.script.json", "out/a.utterance.json", "out/a.speech.tsv"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / file)) << file;
    // The record has the checksum of the script that was written.
    const std::string record = bytes_of(folder_ / "out/a.mp4.json");
    EXPECT_NE(record.find(sha256_of_file(folder_ / "out/a.script.json")), std::string::npos)
        << record;
    // The same again, in place of the former ones
    EXPECT_EQ(speak("--labels anna.ctm --fps 5 --draft --passes 0 --size 64x64 -o out/a.mp4").code,
              0);
}

// Times of frames: those of a script that begins 0.05 s before the face moves, in a film of 10 frames a second.
TEST_F(Speak, AFilmOnStandardOutputHasTheFramesAndTheSoundOfTheSpeech) {
    const std::filesystem::path samples =
        std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples/talk";
    const std::string options = " -o - --draft --size 64x64 --fps 10 --quiet";
    const auto [code, said] =
        speak((samples / "english.utterance.json").string() + options + " 2>&1 > film.mkv; true");
    EXPECT_EQ(said, "");
    EXPECT_EQ(folder_.listing(), std::set<std::string>{"film.mkv"});
    const media::Sound spoken = media::read_sound(samples / "english.wav"),
                       film = media::read_sound(folder_ / "film.mkv");
    EXPECT_EQ(film.rate_hz, spoken.rate_hz);
    const auto loud = [](const std::vector<float>& sound) {
        return std::find_if(sound.begin(), sound.end(), [](float x) { return x != 0; }) -
               sound.begin();
    };
    const auto lead = static_cast<std::size_t>(loud(film.samples) - loud(spoken.samples));
    EXPECT_NEAR(static_cast<double>(lead) / film.rate_hz, 0.35, 0.05);
    ASSERT_GE(film.samples.size(), lead + spoken.samples.size());
    EXPECT_TRUE(std::equal(spoken.samples.begin(), spoken.samples.end(),
                           film.samples.begin() + static_cast<std::ptrdiff_t>(lead)));
    const int frames = media::VideoReader(folder_ / "film.mkv").frames();
    EXPECT_EQ(static_cast<std::int64_t>(film.samples.size()),
              std::int64_t{frames} * film.rate_hz / 10);
}

TEST_F(Speak, LinesOfStandardInputFollowEachOtherInOneFilm) {
    if (!std::filesystem::exists(RISORIUS_BINARY_DIR "/risorius-voice-espeak"))
        GTEST_SKIP() << "built without the library espeak-ng";
    const std::string options = " --program espeak --draft --size 64x64 --fps 5 -o - 2>notes";
    std::vector<int> frames;
    for (const char* text : {"ah", "oh", "ah\\n\\noh"}) {
        const ShellResult result =
            run_shell("cd '" + folder_.path().string() + "' && printf '" + text + "\\n' | '" +
                      (std::filesystem::path(RISORIUS_BINARY_DIR) / "risorius").string() +
                      "' speak -" + options + " > film.mkv");
        EXPECT_EQ(result.code, 0) << bytes_of(folder_ / "notes");
        frames.push_back(media::VideoReader(folder_ / "film.mkv").frames());
    }
    EXPECT_GT(frames[0], 3);
    EXPECT_EQ(frames[2], frames[0] + frames[1]);
}

TEST_F(Speak, AlignRefusesWhatItCannotWriteOrHear) {
    const auto align = [&](const std::string& arguments) {
        return run_shell("cd '" + folder_.path().string() + "' && '" +
                         (std::filesystem::path(RISORIUS_BINARY_DIR) / "risorius").string() +
                         "' align " + arguments + " 2>&1");
    };
    const ShellResult ending = align("anna.wav --text a -o anna.txt");
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.output.find("expected a file that ends in .TextGrid"), std::string::npos)
        << ending.output;
    const ShellResult missing = align("anna.wav --text a -o anna.TextGrid");
    EXPECT_EQ(missing.code, 2);
    EXPECT_NE(missing.output.find("anna.wav"), std::string::npos) << missing.output;
    EXPECT_TRUE(folder_.listing().empty());
}

}  // namespace
}  // namespace risorius
