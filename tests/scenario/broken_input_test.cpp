// SPDX-License-Identifier: MIT
// Every file and command line under tests/data/broken: the exact message, and nothing left behind. Command lines and one
// file of each command go through the real program, whose start takes most of the time, and end with exit code 2.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/animate/animate.h"
#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/figures/run_figure.h"
#include "risorius/fitting/fit_rig.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

const fs::path kBroken = kRoot / "tests/data/broken";

Json expected_in(const char* folder) {
    return JsonCursor::read_file(kBroken / folder / "expected.json").json();
}

/// Each file but expected.json is expected to fail, and each expectation has its file.
void expect_complete(const char* folder, const Json& expected) {
    std::set<std::string> files, named;
    for (const auto& entry : fs::directory_iterator(kBroken / folder))
        files.insert(entry.path().filename().string());
    files.erase("expected.json");
    for (const auto& [file, message] : expected.items()) named.insert(file);
    EXPECT_EQ(files, named);
}

void expect_refused(const std::string& arguments, const fs::path& from, const std::string& message,
                    const Folder& out) {
    const Outcome outcome = run(arguments, from);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.errors, "risorius: " + message + "\n") << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(out.listing(), std::set<std::string>{}) << arguments;
}

/// Where relative paths start, until it is gone.
class WorkingFolder {
  public:
    explicit WorkingFolder(const fs::path& folder) : before_(fs::current_path()) {
        fs::current_path(folder);
    }
    ~WorkingFolder() { fs::current_path(before_); }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;

  private:
    fs::path before_;
};

/// What a command of the program calls with a file, and how the program is told to.
struct Command {
    std::function<void(const std::string& file)> call;
    std::function<std::string(const std::string& file)> arguments;
};

std::string message_of(const Command& command, const std::string& file) {
    try {
        command.call(file);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

void expect_every_file_refused(const char* folder, const Command& command, const Folder& out) {
    const Json expected = expected_in(folder);
    expect_complete(folder, expected);
    ASSERT_FALSE(expected.empty());
    expect_refused(command.arguments(expected.begin().key()), kBroken / folder,
                   expected.begin().value(), out);
    const WorkingFolder here(kBroken / folder);
    for (const auto& [file, message] : expected.items()) {
        EXPECT_EQ(message_of(command, file), message) << file;
        EXPECT_EQ(out.listing(), std::set<std::string>{}) << file;
    }
}

TEST(BrokenInput, EveryScriptIsRefusedByRender) {
    const Folder out;
    expect_every_file_refused("scripts",
                              {.call =
                                   [&](const std::string& file) {
                                       animate::RenderRequest options;
                                       options.script = file;
                                       options.out = out / "x.mp4";
                                       animate::animate(options);
                                   },
                               .arguments =
                                   [&](const std::string& file) {
                                       return "render " + file + " -o " + (out / "x.mp4").string();
                                   }},
                              out);
}

TEST(BrokenInput, EveryRigIsRefusedByRender) {
    const Folder out;
    const std::string script = "../../../../samples/smile/script.json";
    expect_every_file_refused("rigs",
                              {.call =
                                   [&](const std::string& file) {
                                       animate::RenderRequest options;
                                       options.script = script;
                                       options.rig = file;
                                       options.out = out / "x.mp4";
                                       animate::animate(options);
                                   },
                               .arguments =
                                   [&](const std::string& file) {
                                       return "render " + script + " --rig " + file + " -o " +
                                              (out / "x.mp4").string();
                                   }},
                              out);
}

TEST(BrokenInput, EveryLandmarkFileIsRefusedByFit) {
    const Folder out;
    const std::string mesh = "../../heads/plain_head.obj";
    expect_every_file_refused("landmarks",
                              {.call =
                                   [&](const std::string& file) {
                                       fitting::FitOptions options;
                                       options.mesh = mesh;
                                       options.landmarks = file;
                                       options.out = out / "rig.json";
                                       fitting::fit_rig(options);
                                   },
                               .arguments =
                                   [&](const std::string& file) {
                                       return "fit " + mesh + " --landmarks " + file + " -o " +
                                              (out / "rig.json").string();
                                   }},
                              out);
}

TEST(BrokenInput, EveryExperimentIsRefusedByFigure) {
    const Folder out;
    expect_every_file_refused("experiments",
                              {.call =
                                   [&](const std::string& file) {
                                       figures::FigureOptions options;
                                       options.figure = file;
                                       options.out = out / "figure";
                                       figures::run_figures(options);
                                   },
                               .arguments =
                                   [&](const std::string& file) {
                                       return "figure " + file + " -o " + (out / "figure").string();
                                   }},
                              out);
}

TEST(BrokenInput, EveryMeshIsRefusedByTheRigThatNamesIt) {
    const Json expected = expected_in("meshes");
    expect_complete("meshes", expected);
    const Folder rigs, out;
    Json rig = JsonCursor::read_file(kBroken / "rigs/wrong_unit.json").json();
    rig["mesh"]["metres_per_unit"] = 1.0;
    rig["mesh"]["parts"] = {{"skin", {"skin"}}};
    rig["landmarks"] = (kRoot / "tests/data/heads/plain_landmarks.json").string();
    rig["facs"] = (kRoot / "rigs/standard/facs.json").string();
    rig["expressions"] = (kRoot / "rigs/standard/expressions.json").string();
    for (auto& [key, table] : rig["anatomy"].items())
        table = (kRoot / "rigs/standard" / fs::path(table.get<std::string>()).filename()).string();
    for (const auto& [file, message] : expected.items()) {
        rig["mesh"]["file"] = (kBroken / "meshes" / file).string();
        std::ofstream(rigs / "rig.json") << rig.dump();
        // Messages that end in the reader's own words repeat the path as it was given.
        std::string text = (kBroken / "meshes" / "").string() + message.get<std::string>();
        const std::string in_quotes = "\"" + file + "\"";
        if (const std::size_t at = text.rfind("for the file format of file " + in_quotes);
            at != std::string::npos)
            text.replace(text.find(in_quotes, at), in_quotes.size(),
                         "\"" + (kBroken / "meshes" / file).string() + "\"");
        animate::RenderRequest options;
        options.script = kRoot / "samples/smile/script.json";
        options.rig = rigs / "rig.json";
        options.out = out / "x.mp4";
        EXPECT_EQ(message_of({.call = [&](const std::string&) { animate::animate(options); },
                              .arguments = {}},
                             file),
                  text);
        EXPECT_EQ(out.listing(), std::set<std::string>{}) << file;
    }
}

TEST(BrokenInput, EveryCommandLineIsRefused) {
    const Folder out;
    const auto filled = [&](std::string text) {
        for (std::size_t at; (at = text.find("$OUT")) != std::string::npos;)
            text.replace(at, 4, out.path().string());
        return text;
    };
    const Json expected = expected_in("cli");
    EXPECT_GE(expected.size(), 20u);
    for (const Json& line : expected)
        expect_refused(filled(line["arguments"]), kRoot, filled(line["says"]), out);
}

TEST(BrokenInput, TheBrokenSampleSaysWhatItsReadmePromises) {
    const Folder out;
    const std::string readme = text_of(kRoot / "samples/broken/README.md");
    const Outcome outcome =
        run("render samples/broken/script.json -o " + (out / "x.mp4").string(), kRoot);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(readme.find("    " + outcome.errors), std::string::npos) << outcome.errors;
    EXPECT_EQ(run("check samples/broken/script.json", kRoot).errors, outcome.errors);
}

TEST(BrokenInput, CheckTellsOfEveryFileAndThenFails) {
    const Outcome outcome = run(
        "check rigs/adult/rig.json samples/broken/script.json samples/smile/script.json", kRoot);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out,
              "rigs/adult/rig.json: rig, fine\nsamples/smile/script.json: script, fine\n");
}

}  // namespace
}  // namespace risorius::scenario
