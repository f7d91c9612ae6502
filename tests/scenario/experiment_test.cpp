// SPDX-License-Identifier: MIT
// The experiments that come with a stimulus set: PsychoPy's program is run with a stand-in for PsychoPy, jsPsych's page is
// played by the real jsPsych in a real browser.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "risorius/media/loudness.h"
#include "risorius/media/wav_file.h"
#include "risorius/report/run_program.h"
#include "risorius/stimuli/batch.h"
#include "scenario/jspsych.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;
using report::run_program;

const fs::path kStandIns = kRoot / "tests/data/experiment";

/// A set of two clips, one of them with sound, for all tests of this suite.
class Experiment : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = new Folder;
        media::Sound voice;
        voice.rate_hz = 16000;
        for (int i = 0; i < 8000; ++i)
            voice.samples.push_back(0.2f * static_cast<float>(std::sin(0.17 * i)));
        media::write_wav(voice, *folder / "voice.wav");
        Json design = Json::parse(R"j({"format": "risorius-design", "version": 1,
            "name": "Which <one>?", "clips": {"quality": "preview", "ending": "mp4"},
            "match": {"loudness": {"lufs": -30}},
            "experiment": {"programs": ["psychopy", "jspsych"], "question": "\"Happy\" & <so>?",
                "answers": {"a": "happiness", "f": "fear"}, "correct": "expression",
                "fixation_s": 0.05, "jspsych_from": "../../node_modules"},
            "sets": [{"name": "two", "clip": "${expression}", "audio": "${voice}",
                "audio_start_s": 0.1, "parameters": {"voice": null},
                "factors": {"expression": ["happiness", "fear"]},
                "overrides": [{"when": {"expression": "fear"}, "set": {"voice": "voice.wav"}}],
                "script": {"format": "risorius-script", "version": 1, "fps": 10, "duration_s": 0.6,
                    "events": [{"expression": "${expression}", "start_s": 0.05, "onset_s": 0.3,
                                "hold_s": 0.1, "offset_s": 0.3}],
                    "view": {"width_px": 64, "height_px": 64, "antialiasing": 1}}}]})j");
        design["sets"][0]["script"]["rig"] = (kRoot / "rigs/adult/rig.json").string();
        std::ofstream(*folder / "design.json") << design.dump();
        // Ended as by a loss of power as soon as the first clip is told of
        const std::string batch = "'" RISORIUS_BINARY_DIR
                                  "/risorius' batch design.json -o set "
                                  "--workers 1 --json";
        first_event = new std::string(
            run_program({"sh", "-c",
                         "cd '" + folder->path().string() + "' && mkfifo events && { " + batch +
                             " >events & pid=$!; head -n 1 events; kill -9 $pid; wait $pid; } "
                             "2>/dev/null; ls set"})
                .output);
        stimuli::BatchOptions options;
        options.design = *folder / "design.json";
        options.out = *folder / "set";
        options.workers = 1;
        report = new stimuli::BatchReport(stimuli::make_batch(options));
        ASSERT_TRUE(report->complete);
    }
    static void TearDownTestSuite() {
        delete report;
        delete first_event;
        delete folder;
    }
    static std::string missing_browser() { return missing_for_pages(folder->path()); }
    static Folder* folder;
    static std::string* first_event;
    static stimuli::BatchReport* report;
};
Folder* Experiment::folder = nullptr;
std::string* Experiment::first_event = nullptr;
stimuli::BatchReport* Experiment::report = nullptr;

TEST_F(Experiment, GoesOnAfterAKillWhereItWas) {
    EXPECT_NE(first_event->find(R"({"event":"made","stim_id":"happiness"})"), std::string::npos)
        << *first_event;
    EXPECT_EQ(first_event->find("SHA256SUMS"), std::string::npos) << *first_event;
    EXPECT_EQ(report->kept, 1);
    EXPECT_EQ(report->made, 1);
    for (const auto& entry : fs::recursive_directory_iterator(*folder / "set"))
        EXPECT_EQ(entry.path().filename().string().find(".part-"), std::string::npos)
            << entry.path();
}

TEST_F(Experiment, SoundIsAsLoudAsAskedForInTableClipAndFile) {
    const fs::path stimuli = *folder / "set/stimuli";
    const media::Sound alone = media::read_sound(stimuli / "stim-fear_audio.wav");
    EXPECT_EQ(alone.length(), 9600);
    EXPECT_EQ(alone.samples[1599], 0);
    EXPECT_NE(alone.samples[1601], 0);
    // Samples of 16 bits
    media::Sound recording = alone;
    recording.samples.erase(recording.samples.begin(), recording.samples.begin() + 1600);
    EXPECT_NEAR(media::loudness_of(recording).integrated_lufs, -30, 0.01);
    const media::Sound coded = media::read_sound(stimuli / "stim-fear_audiovideo.mp4");
    EXPECT_NEAR(media::loudness_of(coded).integrated_lufs, -30, 0.5) << "AAC";
    EXPECT_NE(text_of(stimuli / "stimuli.tsv").find("\t-30\t"), std::string::npos);
    EXPECT_TRUE(fs::exists(stimuli / "stim-happiness_video.mp4"));
}

/// The files in experiment/data with an ending.
std::vector<fs::path> data_files(const fs::path& experiment, const std::string& ending) {
    std::vector<fs::path> out;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(experiment / "data", none))
        if (entry.path().filename().string().ends_with(ending)) out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

/// Plays experiment.py on a screen of so many hertz.
report::ProgramResult play(const fs::path& experiment, const std::string& hz) {
    return run_program({"env", "PYTHONPATH=" + (kStandIns / "stand_in").string(),
                        "PYTHONDONTWRITEBYTECODE=1", "STAND_IN_HZ=" + hz, "python3",
                        (experiment / "experiment.py").string(), "--participant", "7", "--window"});
}

/// The codes that triggers.tsv has for a clip, as "1@0.0000 0@0.0167 ..." with pulses of `pulse_s`.
std::string codes_in_table(const fs::path& set, const std::string& clip, double pulse_s) {
    std::istringstream table(text_of(set / "triggers.tsv"));
    std::string line, out;
    while (std::getline(table, line)) {
        std::istringstream cells(line);
        std::string id, event, code, frame, time, merged;
        for (std::string* cell : {&id, &event, &code, &frame, &time, &merged})
            std::getline(cells, *cell, '\t');
        if (id != clip || merged != "n/a") continue;
        char text[64];
        std::snprintf(text, sizeof text, "%s%s@%.4f 0@%.4f", out.empty() ? "" : " ", code.c_str(),
                      std::stod(time), std::stod(time) + pulse_s);
        out += text;
    }
    return out;
}

TEST_F(Experiment, OfPsychoPyShowsEveryFrameAndSendsTheCodesOfTheTable) {
    if (run_program({"python3", "--version"}).exit_code != 0) GTEST_SKIP() << "no python3 here";
    const fs::path here = *folder / "set/experiment";
    for (const auto& [hz, pulse_s] : {std::pair{"60", 1 / 60.0}, std::pair{"120", 2 / 120.0}}) {
        const std::vector<fs::path> before = data_files(here, ".csv");
        std::map<fs::path, std::string> texts;
        for (const fs::path& file : before) texts[file] = text_of(file);
        const report::ProgramResult result = play(here, hz);
        ASSERT_EQ(result.exit_code, 0) << result.output;
        // A second run of a participant leaves the first one's data
        const std::vector<fs::path> after = data_files(here, ".csv");
        ASSERT_EQ(after.size(), before.size() + 1);
        for (const auto& [file, text] : texts) EXPECT_EQ(text_of(file), text);
        std::istringstream data(text_of(after.back()));
        std::string line;
        std::getline(data, line);
        int trials = 0;
        for (; std::getline(data, line); ++trials) {
            const bool happy = line.find("happiness,stim") != std::string::npos;
            EXPECT_NE(
                line.find("," +
                          codes_in_table(*folder / "set", happy ? "happiness" : "fear", pulse_s) +
                          ",0,0.00"),
                std::string::npos)
                << line;
            EXPECT_NE(line.find(happy ? ",a,happiness,1," : ",a,happiness,0,"), std::string::npos)
                << line;
            EXPECT_NE(line.find(",0.0500,1@"), std::string::npos)
                << "a fixation of 0.05 s, although decoding takes time: " << line;
        }
        EXPECT_EQ(trials, 2);
    }
    EXPECT_EQ(data_files(here, "_events.tsv").size(), 2u);
    EXPECT_EQ(text_of(data_files(here, "_events.tsv").front())
                  .find("onset\tduration\ttrial_type\tresponse_time\tstimulus_id\t"),
              0u);
}

TEST_F(Experiment, OfPsychoPyChecksEverythingBeforeItOpensAFile) {
    if (run_program({"python3", "--version"}).exit_code != 0) GTEST_SKIP() << "no python3 here";
    const fs::path here = *folder / "set/experiment";
    const std::size_t before = data_files(here, ".csv").size();
    for (const char* hz : {"144", "75"}) {
        const report::ProgramResult result = play(here, hz);
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_NE(result.output.find("do not divide the screen's"), std::string::npos)
            << result.output;
    }
    EXPECT_EQ(data_files(here, ".csv").size(), before);
}

TEST_F(Experiment, OfPsychoPyFailsForAClipOfAnotherLength) {
    if (run_program({"python3", "--version"}).exit_code != 0) GTEST_SKIP() << "no python3 here";
    const fs::path here = *folder / "set/experiment";
    const std::string whole = text_of(here / "conditions.csv");
    std::string table = whole;
    for (std::size_t at; (at = table.find(",6,10,")) != std::string::npos;)
        table.replace(at, 6, ",7,10,");
    std::ofstream(here / "conditions.csv") << table;
    const report::ProgramResult result = play(here, "60");
    std::ofstream(here / "conditions.csv") << whole;
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.output.find("expected 7 frames, found 6"), std::string::npos) << result.output;
}

TEST_F(Experiment, ThatWasEditedStaysAndTheNewOneIsBesideIt) {
    const fs::path program = *folder / "set/experiment/experiment.py";
    const std::string whole = text_of(program);
    std::ofstream(program, std::ios::app) << "# mine\n";
    stimuli::BatchOptions options;
    options.design = *folder / "design.json";
    options.out = *folder / "set";
    options.workers = 1;
    EXPECT_EQ(stimuli::make_batch(options).changed,
              std::vector<std::string>{"experiment/experiment.py"});
    EXPECT_EQ(text_of(program), whole + "# mine\n");
    EXPECT_EQ(text_of(*folder / "set/experiment/experiment.py.new"), whole);
    options.replace = true;
    EXPECT_TRUE(stimuli::make_batch(options).changed.empty());
    EXPECT_EQ(text_of(program), whole);
    EXPECT_FALSE(fs::exists(*folder / "set/experiment/experiment.py.new"));
}

TEST_F(Experiment, OfJsPsychIsPlayedInABrowserToItsEnd) {
    if (const std::string missing = missing_browser(); !missing.empty()) GTEST_SKIP() << missing;
    const report::ProgramResult played =
        run_program({"python3", (kStandIns / "play.py").string(), folder->path().string(),
                     "set/experiment/index.html", (*folder / "data.json").string(), "chromium"});
    ASSERT_EQ(played.exit_code, 0) << played.output;
    const std::string said = text_of(*folder / "data.json");
    const Json data = Json::parse(said, nullptr, false);
    ASSERT_TRUE(data.is_array()) << said;
    std::set<std::string> shown;
    int answered = 0;
    for (const Json& trial : data) {
        const std::string task = trial.value("task", "");
        if (task == "clip") {
            shown.insert(trial.at("stim_id").get<std::string>());
            EXPECT_GT(trial.at("frames_seen").get<int>(), 0);
            EXPECT_EQ(trial.at("flag"), trial.at("frames_seen") < 5 ? "frames_missing" : "");
            EXPECT_EQ(trial.at("participant"), "7");
        }
        if (task != "answer" || trial.at("repeated")) continue;
        ++answered;
        EXPECT_EQ(trial.at("answer"), "happiness");
        EXPECT_EQ(trial.at("correct"), trial.at("stim_id") == "happiness");
    }
    EXPECT_EQ(shown, (std::set<std::string>{"fear", "happiness"}));
    EXPECT_EQ(answered, 2);
    EXPECT_NE(said.find("&#34;Happy&#34; &#38; &#60;so&#62;?"), std::string::npos);
}

// The answers of a participant must outlive a server that is gone: as a file, and in the browser until they are saved.
TEST_F(Experiment, OfJsPsychKeepsItsAnswersWhenTheyCannotBeSaved) {
    if (const std::string missing = missing_browser(); !missing.empty()) GTEST_SKIP() << missing;
    const report::ProgramResult played = run_program(
        {"python3", (kStandIns / "play.py").string(), folder->path().string(),
         "set/experiment/index.html", (*folder / "left.json").string(), "chromium", "--dead-save"});
    ASSERT_EQ(played.exit_code, 0) << played.output;
    const std::string said = text_of(*folder / "left.json");
    const Json left = Json::parse(said, nullptr, false);
    ASSERT_TRUE(left.is_object()) << said;
    const auto answers = [](const Json& trials) {
        std::set<std::string> out;
        for (const Json& trial : trials)
            if (trial.value("task", "") == "answer" && trial.value("answer", "") == "happiness")
                out.insert(trial.at("stim_id").get<std::string>());
        return out;
    };
    const std::set<std::string> both{"fear", "happiness"};
    ASSERT_EQ(left.at("kept").size(), 1u) << "runs";
    EXPECT_EQ(answers(left.at("kept").at(0)), both);
    EXPECT_EQ(left.at("file"), "data-7.csv");
    const auto csv = left.at("csv").get<std::string>();
    std::size_t rows = 0;
    for (std::size_t at = 0; (at = csv.find("\"answer\"", at)) != std::string::npos; ++at) ++rows;
    EXPECT_GE(rows, 3u) << "the heading and a row for each answer\n" << csv;
    ASSERT_EQ(left.at("offered").size(), 1u);
    EXPECT_NE(left.at("offered").at(0).get<std::string>().find("Which <one>? 7"), std::string::npos)
        << left.at("offered");
}

/// The design of this suite with pictures in place of its clips, made into `stills`.
stimuli::BatchReport make_stills(const Folder& folder) {
    Json design = Json::parse(text_of(folder / "design.json"));
    design.erase("match");
    design["clips"] = Json::parse(R"({"quality": "draft", "ending": "png", "shown_s": 0.25})");
    design["experiment"]["jspsych_from"] = "../../node_modules";
    for (const char* key : {"audio", "audio_start_s", "parameters", "overrides"})
        design["sets"][0].erase(key);
    std::ofstream(folder / "stills.json") << design.dump();
    stimuli::BatchOptions options;
    options.design = folder / "stills.json";
    options.out = folder / "stills";
    options.workers = 1;
    return stimuli::make_batch(options);
}

TEST_F(Experiment, OfPicturesShowsEachForItsTime) {
    ASSERT_TRUE(make_stills(*folder).complete);
    if (run_program({"python3", "--version"}).exit_code != 0) GTEST_SKIP() << "no python3 here";
    const fs::path here = *folder / "stills/experiment";
    const report::ProgramResult result = play(here, "60");
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const std::string data = text_of(data_files(here, ".csv").front());
    for (const char* clip : {"happiness", "fear"}) {
        const std::string codes = codes_in_table(*folder / "stills", clip, 1 / 60.0);
        EXPECT_EQ(codes, "1@0.0000 0@0.0167 4@0.2500 0@0.2667");
        EXPECT_NE(data.find("stim-" + std::string(clip) + "_image.png"), std::string::npos) << data;
        EXPECT_NE(data.find("," + codes + ",0,0.00"), std::string::npos) << data;
    }
    EXPECT_NE(text_of(data_files(here, "_events.tsv").front()).find("\t0.2500\t"),
              std::string::npos);
    if (const std::string missing = missing_browser(); !missing.empty()) GTEST_SKIP() << missing;
    const report::ProgramResult played = run_program(
        {"python3", (kStandIns / "play.py").string(), folder->path().string(),
         "stills/experiment/index.html", (*folder / "stills_data.json").string(), "chromium"});
    ASSERT_EQ(played.exit_code, 0) << played.output;
    const Json trials = Json::parse(text_of(*folder / "stills_data.json"), nullptr, false);
    ASSERT_TRUE(trials.is_array()) << trials;
    std::set<std::string> shown;
    for (const Json& trial : trials)
        if (trial.value("task", "") == "clip") {
            shown.insert(trial.at("stim_id").get<std::string>());
            EXPECT_NE(trial.at("stimulus").get<std::string>().find("_image.png"),
                      std::string::npos);
            EXPECT_TRUE(trial.at("first_frame_ms").is_number());
        }
    EXPECT_EQ(shown, (std::set<std::string>{"fear", "happiness"}));
}

TEST_F(Experiment, PageNamesTheVersionsAndHashesOfWhatItLoads) {
    const fs::path modules = jspsych();
    if (modules.empty()) GTEST_SKIP() << "no jsPsych here (tools/setup.sh test fetches it by npm)";
    if (run_program({"openssl", "version"}).exit_code != 0) GTEST_SKIP() << "no openssl here";
    Json design = Json::parse(text_of(*folder / "design.json"));
    design["experiment"].erase("jspsych_from");
    std::ofstream(*folder / "design.json") << design.dump();
    stimuli::BatchOptions options;
    options.design = *folder / "design.json";
    options.out = *folder / "set";
    options.workers = 1;
    EXPECT_EQ(stimuli::make_batch(options).kept, 2);
    const std::string page = text_of(options.out / "experiment/index.html");
    const Json wanted = Json::parse(text_of(kStandIns / "package.json")).at("dependencies");
    int found = 0;
    for (std::size_t at = 0;
         (at = page.find("https://cdn.jsdelivr.net/npm/", at)) != std::string::npos;
         ++at, ++found) {
        const std::string address = page.substr(at + 29, page.find('"', at) - at - 29);
        const std::size_t version = address.rfind('@'), slash = address.find('/', version);
        const std::string package = address.substr(0, version);
        EXPECT_EQ(wanted.at(package), address.substr(version + 1, slash - version - 1));
        const report::ProgramResult hash =
            run_program({"sh", "-c", "openssl dgst -sha384 -binary \"$0\" | openssl base64 -A",
                         (modules / package).string() + address.substr(slash)});
        EXPECT_NE(page.find("integrity=\"sha384-" + hash.output + "\"", at), std::string::npos)
            << address;
    }
    EXPECT_EQ(found, 5);
}

}  // namespace
}  // namespace risorius::scenario
