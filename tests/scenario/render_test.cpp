// SPDX-License-Identifier: MIT
// From a script to a video and what lies beside it, end to end on the adult.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "paths.h"
#include "risorius/animate/animate.h"
#include "risorius/core/error.h"
#include "risorius/core/sha256.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_reader.h"
#include "risorius/track/channels.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

/// samples/hello, cut to its first moments and made small, as a file in `folder`.
fs::path short_hello(const Folder& folder, double duration_s, int fps) {
    Json script = JsonCursor::read_file(kRoot / "samples/hello/script.json").json();
    script["rig"] = (kRoot / "rigs/adult/rig.json").string();
    script["duration_s"] = duration_s;
    script["fps"] = fps;
    script["view"]["width_px"] = script["view"]["height_px"] = 128;
    Json events = Json::array();
    for (Json event : script["events"]) {
        event["start_s"] = 0.02;  // the smile and the blink at once
        events.push_back(event);
    }
    script["events"] = events;
    const fs::path file = folder / "hello.json";
    std::ofstream(file) << script.dump();
    return file;
}

/// name -> column of numbers, and the names in order.
struct Table {
    explicit Table(const fs::path& file) {
        std::istringstream text(text_of(file));
        std::string line, cell;
        std::getline(text, line);
        std::istringstream head(line);
        while (std::getline(head, cell, '\t')) names.push_back(cell);
        while (std::getline(text, line)) {
            rows.emplace_back();
            std::istringstream row(line);
            while (std::getline(row, cell, '\t')) rows.back().push_back(std::stod(cell));
        }
    }
    double at(std::size_t row, const std::string& name) const {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) throw std::runtime_error("no column " + name);
        return rows.at(row).at(static_cast<std::size_t>(found - names.begin()));
    }
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
};

Json without_timing(const fs::path& record) {
    Json json = Json::parse(text_of(record));
    json.erase("timing");
    json.erase("out");
    return json;
}

TEST(Render, LeavesAVideoARecordAndATable) {
    const Folder folder;
    animate::RenderRequest options;
    options.script = short_hello(folder, 0.2, 30);
    options.out = folder / "hello.mp4";
    options.landmarks = true;
    const animate::RunRecord record = animate::animate(options);

    media::VideoReader video(options.out);
    EXPECT_EQ(video.frames(), 6);
    EXPECT_EQ(video.width_px(), 128);
    EXPECT_EQ(video.height_px(), 128);
    EXPECT_EQ(video.fps(), 30);
    for (int frame = 0; frame < 6; ++frame) EXPECT_NEAR(video.time_s(frame), frame / 30.0, 1e-6);
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"hello.json", "hello.mp4", "hello.mp4.json",
                                                       "hello.mp4.frames.tsv"}));

    const Json json = Json::parse(text_of(folder / "hello.mp4.json"));
    EXPECT_EQ(json, record.json());
    EXPECT_EQ(json["format"], "risorius-run");
    EXPECT_EQ(json["script"]["sha256"], sha256_of_file(options.script));
    EXPECT_EQ(json["rig"]["sha256"], sha256_of_file(kRoot / "rigs/adult/rig.json"));
    EXPECT_EQ(json["mesh"]["sha256"], sha256_of_file(kRoot / "models/adult/head.obj"));
    ASSERT_EQ(json["tables"].size(), 9u);  // what the adult rig names
    std::set<std::string> tables;
    for (const Json& table : json["tables"]) {
        const fs::path file = table["file"].get<std::string>();
        tables.insert(file.filename().string());
        EXPECT_EQ(table["sha256"], sha256_of_file(file));
    }
    EXPECT_TRUE(tables.count("facs.json") && tables.count("expressions.json"));
    EXPECT_EQ(json["frames"], 6);
    EXPECT_EQ(json["fps"], 30);
    EXPECT_EQ(json["solver"]["steps"], 20);  // to t = 5 / 30 s, in pieces of 1 / 120 s
    EXPECT_EQ(json["frames_sha256"].get<std::string>().size(), 64u);
    EXPECT_GT(json["face"]["tets"], 1000);
    for (const char* key : {"threads", "build_s", "simulate_s", "draw_s", "encode_s", "total_s"})
        EXPECT_TRUE(json["timing"].contains(key)) << key;

    const Table table(folder / "hello.mp4.frames.tsv");
    ASSERT_EQ(table.rows.size(), 6u);
    for (std::size_t row = 0; row < 6; ++row) {
        ASSERT_EQ(table.rows[row].size(), table.names.size());
        EXPECT_EQ(table.at(row, "frame"), static_cast<double>(row));
        EXPECT_NEAR(table.at(row, "time_s"), static_cast<double>(row) / 30, 1e-6);
        for (double value : table.rows[row]) EXPECT_TRUE(std::isfinite(value));
    }
    EXPECT_EQ(table.at(0, "excitation.zygomaticus_major.l"), 0);
    EXPECT_GT(table.at(5, "excitation.zygomaticus_major.l"),
              table.at(5, "activation.zygomaticus_major.l"));
    EXPECT_GT(table.at(5, "activation.zygomaticus_major.l"), 0);
    EXPECT_GT(table.at(0, "lid_aperture_l_mm"), 5);
    EXPECT_GT(table.at(0, "lip_width_mm"), 40);
    // The tip of the nose is in the middle of the picture, below the eyes.
    EXPECT_NEAR(table.at(0, "prn.u_px"), 64, 3);
    EXPECT_GT(table.at(0, "prn.v_px"), table.at(0, "en_l.v_px") + 5);
    EXPECT_GT(table.at(0, "ch_l.u_px"), table.at(0, "ch_r.u_px"));  // seen from the front
}

TEST(Render, DoesNotWriteItsRecordOverAScriptOfThatName) {
    const Folder folder;
    const fs::path script = short_hello(folder, 0.1, 30);
    const std::string before = text_of(script);
    animate::RenderRequest options;
    options.script = script;
    options.out = folder / "hello/";
    try {
        animate::animate(options);
        FAIL() << "the script was written over";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()), script.string() +
                                                 ": expected no file, or the record of an earlier "
                                                 "run, found another file of that name");
    }
    EXPECT_EQ(text_of(script), before);
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"hello.json"}));
}

TEST(Render, GivesTheSameFramesAgainAndForAnyNumberOfThreads) {
    const Folder folder;
    animate::RenderRequest options;
    options.script = short_hello(folder, 0.1, 60);
    const auto render = [&](const char* name, int threads) {
        options.out = folder / name;
        options.threads = threads;
        animate::animate(options);
        return without_timing(folder / (std::string(name) + ".json"));
    };
    const Json once = render("once.mkv", 1);
    EXPECT_EQ(render("two.mkv", 2), once);
    EXPECT_EQ(render("four.mkv", 4), once);
    EXPECT_EQ(text_of(folder / "once.mkv.frames.tsv"), text_of(folder / "four.mkv.frames.tsv"));

    // The hash is that of the pixels in a lossless file.
    media::VideoReader video(folder / "once.mkv");
    Sha256 hash;
    for (int frame = 0; frame < video.frames(); ++frame) {
        const Image image = video.frame(frame);
        hash.add(image.rgba.data(), image.rgba.size());
    }
    EXPECT_EQ(hash.finish(), once["frames_sha256"]);
}

// sim_test holds the face to this at many more rates.
TEST(Render, FrameRatesShareTheirCommonTimes) {
    const Folder folder;
    animate::RenderRequest options;
    options.script = short_hello(folder, 0.25, 60);
    options.size = animate::PictureSize{32, 32};
    options.landmarks = true;
    for (int fps : {60, 48}) {
        options.fps = fps;
        options.out = folder / (std::to_string(fps) + ".mkv");
        animate::animate(options);
    }
    const Table finest(folder / "60.mkv.frames.tsv"), between(folder / "48.mkv.frames.tsv");
    ASSERT_EQ(finest.rows.size(), 15u);
    ASSERT_EQ(between.rows.size(), 12u);
    for (std::size_t row = 0; row < between.rows.size(); row += 4)  // 4 / 48 s = 5 / 60 s
        for (std::size_t column = 1; column < finest.names.size(); ++column) {
            if (finest.names[column] == "motion_energy") continue;  // since the frame before
            EXPECT_EQ(between.rows[row][column], finest.rows[5 * row / 4][column])
                << finest.names[column] << " in row " << row;
        }
}

TEST(Render, AStillIsTheFrameOfItsTime) {
    const Folder folder;
    animate::RenderRequest options;
    options.script = short_hello(folder, 0.2, 60);
    options.out = folder / "frames" / "";
    animate::animate(options);
    options.still_s = 9 / 60.0;
    options.out = folder / "still.png";
    const animate::RunRecord record = animate::animate(options);
    EXPECT_EQ(record.frames, 1);
    const Image frame = media::read_png(folder / "frames/frame_000009.png");
    const Image still = media::read_png(folder / "still.png");
    EXPECT_EQ(frame.rgba, still.rgba);
    EXPECT_TRUE(fs::exists(folder / "frames.json"));
    EXPECT_TRUE(fs::exists(folder / "still.png.frames.tsv"));
}

TEST(Render, ShowsTheMusclesWhenTheScriptOrTheCommandAsks) {
    const Folder folder;
    const fs::path script = short_hello(folder, 0.2, 60);
    Json json = Json::parse(text_of(script));
    json["view"]["show"] = "muscles";
    std::ofstream(script) << json.dump();
    animate::RenderRequest options;
    options.script = script;
    options.still_s = 0.0;
    options.out = folder / "muscles.png";
    EXPECT_EQ(animate::animate(options).show, "muscles");
    EXPECT_EQ(Json::parse(text_of(folder / "muscles.png.json"))["show"], "muscles");
    const Image image = media::read_png(options.out);
    const std::uint8_t *rest = image.pixel(5, 5), *full = image.pixel(30, 5);  // of the scale
    EXPECT_GT(full[1], rest[1] + 100);

    const Outcome refused = run("render '" + script.string() + "' --show bones -o x.mp4", kRoot);
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.errors,
              "risorius: --show: expected one of \"skin\", \"muscles\", \"skull\", \"wire\", "
              "\"strain\", \"error\", "
              "\"landmarks\", \"articulation\", found \"bones\"\n");
}

TEST(Render, ANeutralScriptShowsOnePictureThroughout) {
    const Folder folder;
    std::ofstream(folder / "neutral.json") << Json{
        {"format", "risorius-script"},
        {"version", 1},
        {"rig", (kRoot / "rigs/adult/rig.json").string()},
        {"fps", 30},
        {"duration_s", 0.3},
        {"view",
         {{"width_px", 64}, {"height_px", 64}}}}.dump();
    animate::RenderRequest options;
    options.script = folder / "neutral.json";
    options.out = folder / "neutral.mkv";
    const animate::RunRecord record = animate::animate(options);
    EXPECT_EQ(record.solver.max_inverted_tets, 0);
    media::VideoReader video(options.out);
    ASSERT_EQ(video.frames(), 9);
    const Image first = video.frame(0);
    for (int frame = 1; frame < 9; ++frame) EXPECT_EQ(video.frame(frame).rgba, first.rgba) << frame;
}

TEST(Render, SaysThatMusclesOfTheJawDoNotMoveItUnlessTheyAreToldTo) {
    const Folder folder;
    Json script = Json::parse(text_of(short_hello(folder, 0.1, 10)));
    script["channels"] = {{"masseter_deep.l", {{"keys", {{0, 0.5}}}}},
                          {"zygomaticus_major", {{"keys", {{0, 0}}}}}};
    std::ofstream(folder / "jaw.json") << script.dump();
    animate::RenderRequest options;
    options.script = folder / "jaw.json";
    options.out = folder / "jaw.mkv";
    const animate::RunRecord record = animate::animate(options);
    ASSERT_EQ(record.warnings.size(), 1u);
    EXPECT_EQ(record.warnings[0],
              "channel masseter_deep.l: does not move the jaw, which follows jaw_open, jaw_forward "
              "and jaw_side unless the script says \"jaw\": \"muscles\"");
    EXPECT_EQ(record.jaw, "channels");
    EXPECT_EQ(record.max_tooth_force_n, 0.0);

    script["jaw"] = "muscles";
    std::ofstream(folder / "jaw.json") << script.dump();
    const animate::RunRecord bitten = animate::animate(options);
    EXPECT_TRUE(bitten.warnings.empty());
    EXPECT_EQ(bitten.jaw, "muscles");
    // Half of one deep masseter, 82 N in the table, near the hinge; at rest teeth touch with 5 N.
    EXPECT_GT(bitten.max_tooth_force_n, 12);
}

TEST(Render, AnInterruptedRunLeavesNothing) {
    const Folder folder, out;
    animate::RenderRequest options;
    options.script = short_hello(folder, 0.5, 60);
    for (int threads : {1, 2}) {
        options.threads = threads;
        options.out = out / "new/hello.mp4";
        int told = 0;
        EXPECT_THROW(
            animate::animate(options, {.progress = {}, .stopped = [&] { return ++told > 5; }}),
            Interrupted);
        EXPECT_EQ(out.listing(), std::set<std::string>{});
    }
}

TEST(Render, CtrlCEndsTheProgramWith130AndLeavesNothing) {
    const Folder out;
    const Outcome outcome =
        run("render samples/hello/script.json -o '" + (out / "hello.mp4").string() + "'", kRoot,
            "timeout --preserve-status -s INT 2");
    EXPECT_EQ(outcome.code, 130);
    EXPECT_EQ(outcome.errors, "risorius: interrupted, nothing was written\n");
    EXPECT_EQ(out.listing(), std::set<std::string>{});
}

TEST(Render, ReportsAsJsonOnStandardOutputAndOtherwiseInOneLine) {
    const Folder folder;
    const std::string render = "render '" + short_hello(folder, 0.05, 60).string() + "' -o '" +
                               (folder / "x.mkv").string() + "'";
    const Outcome json = run(render + " --json", kRoot);
    EXPECT_EQ(json.code, 0) << json.errors;
    EXPECT_EQ(json.out, text_of(folder / "x.mkv.json"));
    EXPECT_EQ(json.errors, "");
    const Outcome plain = run(render, kRoot);
    EXPECT_TRUE(
        plain.out.starts_with((folder / "x.mkv").string() + ": 3 frames of 128 x 128 at 60 fps, "))
        << plain.out;
    EXPECT_EQ(run("check samples/smile/script.json --quiet", kRoot).out, "");
}

TEST(AdultRig, HasTheLandmarksOfItsModel) {
    const Json rig = JsonCursor::read_file(kRoot / "rigs/adult/rig.json").json();
    const Json model = JsonCursor::read_file(kRoot / "models/adult/landmarks.json").json();
    EXPECT_EQ(rig["landmarks"].size(), model["landmarks"].size());
    for (const auto& [id, landmark] : model["landmarks"].items())
        EXPECT_EQ(rig["landmarks"][id], landmark)
            << id << ": rigs/README.md says how to fit it again";
}

TEST(Help, EveryCommandHasAnExampleAndItsOptions) {
    for (const char* command : {"render", "fit", "check", "info", "bench"}) {
        const Outcome outcome = run(std::string(command) + " --help", kRoot);
        EXPECT_EQ(outcome.code, 0);
        for (const std::string& words : {std::string("--quiet"), std::string("--json"),
                                         "Example:\n  risorius " + std::string(command)})
            EXPECT_NE(outcome.out.find(words), std::string::npos) << command << ": " << words;
    }
    EXPECT_EQ(run("--version", kRoot).out, "risorius 0.1.0\n");
}

}  // namespace
}  // namespace risorius::scenario
