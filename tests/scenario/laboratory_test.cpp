// SPDX-License-Identifier: MIT
// A set as a laboratory makes it, small: two heads, two expressions, two tempi and five controls, matched within the face.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "message_of.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/core/sha256.h"
#include "risorius/media/tone.h"
#include "risorius/media/video_reader.h"
#include "risorius/report/run_program.h"
#include "risorius/scene/face_oval.h"
#include "risorius/stimuli/batch.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kMean = 0.28, kSd = 0.09;

Json laboratory_design(const fs::path& other_head) {
    Json design = Json::parse(R"j({"format": "risorius-design", "version": 1, "name": "A",
        "clips": {"quality": "preview", "crf": 10},
        "match": {"luminance": {"within": "face"}},
        "experiment": {"programs": ["psychopy"], "answers": {"h": "happiness", "f": "fear"},
            "correct": "expression"},
        "sets": [{"name": "a", "clip": "${head}_${expression}_${onset_s}",
            "factors": {"head": ["one", "two"], "expression": ["happiness", "fear"],
                        "onset_s": [0.15, 0.3]},
            "controls": ["reversed", "phase_scrambled", {"control": "palsy", "side": "left"},
                         "apex", "neutral"],
            "overrides": [{"when": {"head": "two"}, "set": {"rig": "two"}}],
            "script": {"format": "risorius-script", "version": 1, "rig": "${rig}", "fps": 20,
                "duration_s": 0.6, "events": [{"expression": "${expression}", "start_s": 0.1,
                    "onset_s": "${onset_s}", "hold_s": 0.2, "offset_s": 0.2}],
                "view": {"width_px": 128, "height_px": 128, "background": "#808080"}}}]})j");
    design["match"]["luminance"]["mean"] = kMean;
    design["match"]["luminance"]["sd"] = kSd;
    Json& set = design["sets"][0];
    set["parameters"]["rig"] = (kRoot / "rigs/adult/rig.json").string();
    set["overrides"][0]["set"]["rig"] = other_head.string();
    return design;
}

/// The rows of a table with tabs, each as column -> cell.
std::vector<std::map<std::string, std::string>> table_of(const fs::path& file) {
    const animate::FrameRows rows = animate::frame_rows(text_of(file));
    std::vector<std::map<std::string, std::string>> out;
    for (const std::vector<std::string>& cells : rows.cells) {
        out.emplace_back();
        for (std::size_t c = 0; c < cells.size(); ++c) out.back()[rows.names[c]] = cells[c];
    }
    return out;
}

/// The rows of a table with commas and no quotes.
std::vector<std::map<std::string, std::string>> table_with_commas(const fs::path& file) {
    std::string text = text_of(file);
    std::erase(text, '\r');
    std::replace(text.begin(), text.end(), ',', '\t');
    const animate::FrameRows rows = animate::frame_rows(text);
    std::vector<std::map<std::string, std::string>> out;
    for (const std::vector<std::string>& cells : rows.cells) {
        out.emplace_back();
        for (std::size_t c = 0; c < cells.size(); ++c) out.back()[rows.names[c]] = cells[c];
    }
    return out;
}

class Laboratory : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = new Folder;
        ASSERT_EQ(run("head --model 1 --seed 7 -o two --quiet", folder->path()).code, 0);
        design = new Json(laboratory_design(*folder / "two/rig.json"));
        const stimuli::BatchReport report = stimuli::make_batch(options());
        ASSERT_TRUE(report.complete);
        EXPECT_EQ(report.made, 8 * 5 + 2) << "and a neutral face of each head";
    }
    static void TearDownTestSuite() {
        delete design;
        delete folder;
    }
    static stimuli::BatchOptions options() {
        std::ofstream(*folder / "design.json") << design->dump();
        return {.design = *folder / "design.json", .out = *folder / "set", .workers = 2};
    }
    static fs::path video_of(const std::string& clip) {
        return *folder / ("set/stimuli/stim-" + clip + "_video.mp4");
    }
    static inline Folder* folder = nullptr;
    static inline Json* design = nullptr;
};

/// Luminance of a clip as it is decoded, within the soft oval of the face; the background does not count.
media::LuminanceSums decoded_luminance(const fs::path& set, const std::string& clip) {
    media::VideoReader video(set / ("stimuli/stim-" + clip + "_video.mp4"));
    const animate::FrameRows rows =
        animate::frame_rows(text_of(set / ("stimuli/stim-" + clip + "_annot-frames_events.tsv")));
    media::LuminanceSums sums;
    for (int n = 0; n < video.frames(); ++n) {
        const Image frame = video.frame(n);
        std::vector<Vec2> border;
        for (const std::string& id : scene::FaceOval::landmarks())
            if (const int u = rows.column(id + ".u_px"); u >= 0)
                border.emplace_back(rows.number(n, u), rows.number(n, u + 1));
        std::vector<float> weights =
            scene::FaceOval(border).soft_pixels(frame.width_px, frame.height_px, 0.08);
        for (std::size_t i = 0; i < weights.size(); ++i)
            if (std::abs(frame.rgba[4 * i] - 128) + std::abs(frame.rgba[4 * i + 2] - 128) < 4)
                weights[i] = 0;
        sums.add(frame, weights);
    }
    return sums;
}

TEST_F(Laboratory, BackgroundIsThatOfTheScriptInEveryFrameOfEveryClip) {
    int largest = 0;
    for (const auto& row : table_of(*folder / "set/luminance/luminance.tsv")) {
        media::VideoReader video(video_of(row.at("stim_id")));
        for (int n = 0; n < video.frames(); ++n) {
            const Image frame = video.frame(n);
            for (int y = 0; y < 5; ++y)
                for (int x = 0; x < 5; ++x)
                    for (int k = 0; k < 3; ++k) {
                        ASSERT_NEAR(frame.pixel(x, y)[k], 128, 1) << row.at("stim_id") << " " << n;
                        largest = std::max(largest, std::abs(frame.pixel(x, y)[k] - 128));
                    }
        }
    }
    RecordProperty("largest_difference_from_128", largest);
}

TEST_F(Laboratory, LuminanceIsWhatIsShownAndWhatWasAskedFor) {
    std::map<char, media::LuminanceSums> of_head;
    double largest = 0;
    int neutral = 0;
    for (const auto& row : table_of(*folder / "set/luminance/luminance.tsv")) {
        const std::string& clip = row.at("stim_id");
        const media::LuminanceSums decoded = decoded_luminance(*folder / "set", clip);
        const double mean_error = std::stod(row.at("mean_after")) - decoded.mean(),
                     sd_error = std::stod(row.at("sd_after")) - decoded.sd();
        EXPECT_NEAR(mean_error, 0, 0.002) << clip;
        EXPECT_NEAR(sd_error, 0, 0.002) << clip;
        largest = std::max({largest, std::abs(mean_error), std::abs(sd_error)});
        if (row.at("control") == "n/a") of_head[clip[0]].add(decoded);
        neutral += row.at("control") == "neutral";
        EXPECT_LE(std::stod(row.at("cut_off")), 0.005) << clip;
    }
    ASSERT_EQ(of_head.size(), 2u);
    for (const auto& [head, sums] : of_head) {
        EXPECT_NEAR(sums.mean(), kMean, 0.002) << head;
        EXPECT_NEAR(sums.sd(), kSd, 0.003) << head;
        RecordProperty(std::string("mean_of_head_") + head, std::to_string(sums.mean()));
        RecordProperty(std::string("sd_of_head_") + head, std::to_string(sums.sd()));
    }
    RecordProperty("largest_difference_from_a_decode", std::to_string(largest));
    EXPECT_EQ(neutral, 2) << "one neutral face of a head, one brightness";
}

TEST_F(Laboratory, TargetsThatCutOffTooMuchAreRefused) {
    Json strong = *design;
    std::swap(strong, *design);
    (*design)["match"]["luminance"]["sd"] = 0.3;
    const std::string message = risorius::message_of([] { stimuli::make_batch(options()); });
    EXPECT_NE(message.find("match/luminance: expected 0.5 % clipped at most, with this mean "
                           "\"sd\": 0."),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("% of the values of "), std::string::npos) << message;
    std::swap(strong, *design);
}

TEST_F(Laboratory, StillsHaveNoMomentsAndTheyNeverComeAfterTheClip) {
    std::map<std::string, std::map<std::string, int>> moments;
    for (const auto& row : table_of(*folder / "set/triggers.tsv"))
        moments[row.at("stim_id")][row.at("event")] = std::stoi(row.at("frame"));
    ASSERT_EQ(moments.size(), 42u);
    for (const auto& [clip, at] : moments) {
        EXPECT_EQ(at.at("clip_on"), 0);
        EXPECT_EQ(at.at("clip_off"), 12);
        const bool still = clip.ends_with("Apex") || clip.ends_with("Neutral");
        EXPECT_EQ(at.count("movement_onset"), still ? 0u : 1u) << clip;
        EXPECT_EQ(at.count("apex"), still ? 0u : 1u) << clip;
        if (still) continue;
        EXPECT_LE(at.at("movement_onset"), at.at("apex")) << clip;
        EXPECT_LT(at.at("apex"), 12) << clip;
    }
}

/// Plays experiment.py of the set on a screen of so many hertz.
report::ProgramResult play_on(const fs::path& experiment, const std::string& hz) {
    return report::run_program(
        {"env", "PYTHONPATH=" + (kRoot / "tests/data/experiment/stand_in").string(),
         "PYTHONDONTWRITEBYTECODE=1", "STAND_IN_HZ=" + hz, "python3",
         (experiment / "experiment.py").string(), "--participant", "7", "--window"});
}

TEST_F(Laboratory, PortGetsTheTableOfTriggersInAllClips) {
    if (report::run_program({"python3", "--version"}).exit_code != 0)
        GTEST_SKIP() << "no python3 here";
    const fs::path here = *folder / "set/experiment";
    std::map<std::string, std::vector<std::pair<int, double>>> wanted;
    for (const auto& row : table_of(*folder / "set/triggers.tsv"))
        if (row.at("merged_into") == "n/a")
            wanted[row.at("stim_id")].emplace_back(std::stoi(row.at("code")),
                                                   std::stod(row.at("time_s")));
    for (const char* hz : {"60", "120"}) {
        fs::remove_all(here / "data");
        const report::ProgramResult result = play_on(here, hz);
        ASSERT_EQ(result.exit_code, 0) << result.output;
        fs::path data;
        for (const auto& entry : fs::directory_iterator(here / "data"))
            if (entry.path().extension() == ".csv") data = entry.path();
        std::set<std::string> clips;
        for (const auto& row : table_with_commas(data)) {
            const std::string& clip = row.at("stim_id");
            clips.insert(clip);
            std::istringstream codes(row.at("codes"));
            std::vector<std::pair<int, double>> sent;
            double last_s = 0;
            for (std::string one; codes >> one;) {
                const int code = std::stoi(one);
                const double at_s = std::stod(one.substr(one.find('@') + 1));
                if (code != 0)
                    sent.emplace_back(code, at_s);
                else
                    EXPECT_TRUE(at_s - last_s >= 0.010 && at_s - last_s <= 0.020)
                        << clip << " at " << hz << " Hz: " << at_s - last_s << " s";
                last_s = at_s;
            }
            ASSERT_EQ(sent.size(), wanted.at(clip).size()) << clip;
            for (std::size_t i = 0; i < sent.size(); ++i) {
                EXPECT_EQ(sent[i].first, wanted.at(clip)[i].first) << clip;
                EXPECT_NEAR(sent[i].second, wanted.at(clip)[i].second, 1e-4) << clip;
            }
        }
        EXPECT_EQ(clips.size(), 42u) << "all clips";
    }
    // Screens on which a frame of 20 fps does not last whole refreshes
    fs::remove_all(here / "data");
    for (const char* hz : {"50", "144"}) {
        const report::ProgramResult result = play_on(here, hz);
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_NE(result.output.find("do not divide the screen's"), std::string::npos)
            << result.output;
        EXPECT_FALSE(fs::exists(here / "data")) << "refused before any file is opened";
    }
}

TEST_F(Laboratory, ClipsThatShowNoExpressionHaveNoRightAnswer) {
    std::istringstream table(text_of(*folder / "set/experiment/conditions.csv"));
    const auto cells_of = [](const std::string& line) {
        std::istringstream text(line);
        std::vector<std::string> cells;
        for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
        return cells;
    };
    std::string line;
    std::getline(table, line);
    const std::vector<std::string> names = cells_of(line);
    const auto key = static_cast<std::size_t>(std::find(names.begin(), names.end(), "correct_key") -
                                              names.begin());
    ASSERT_LT(key, names.size()) << line;
    int without = 0;
    while (std::getline(table, line)) {
        const std::vector<std::string> cells = cells_of(line);
        ASSERT_LT(key, cells.size()) << line;
        const bool none = line.find("Neutral,") != std::string::npos ||
                          line.find("PhaseScrambled,") != std::string::npos;
        without += none;
        if (none) {
            EXPECT_EQ(cells[key], "") << line;
        }
        if (line.find("fear0p15,") == 0) {
            EXPECT_EQ(cells[key], "f") << line;
        }
    }
    EXPECT_EQ(without, 8 + 2);
}

TEST_F(Laboratory, FolderOfSomebodyElseIsLeftAsItIs) {
    const fs::path theirs = *folder / "study";
    std::map<std::string, std::string> before;
    for (const char* name : {"dataset_description.json", "sub-01/eeg/sub-01_eeg.edf",
                             "stimuli/stim-mine_image.png", "index.html", "SHA256SUMS"}) {
        fs::create_directories((theirs / name).parent_path());
        std::ofstream(theirs / name) << R"({"Name": "theirs", "BIDSVersion": "1.10.0"})";
        before[name] = sha256_of_file(theirs / name);
    }
    std::ofstream(theirs / "SHA256SUMS")
        << before["stimuli/stim-mine_image.png"] << "  stimuli/stim-mine_image.png\n";
    before["SHA256SUMS"] = sha256_of_file(theirs / "SHA256SUMS");
    EXPECT_EQ(run("batch design.json -o study", folder->path()).code, 2);
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(theirs))
        files += entry.is_regular_file() ? 1 : 0;
    EXPECT_EQ(files, before.size());
    for (const auto& [name, sha256] : before)
        EXPECT_EQ(sha256_of_file(theirs / name), sha256) << name;
}

}  // namespace
}  // namespace risorius::scenario
