// Every file and command line under tests/data/broken through the real program: exit code 2, the exact message, and
// nothing left behind.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/json_cursor.h"
#include "paths.h"
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

TEST(BrokenInput, EveryScriptIsRefusedByRender) {
    const Json expected = expected_in("scripts");
    expect_complete("scripts", expected);
    const Folder out;
    for (const auto& [file, message] : expected.items())
        expect_refused("render " + file + " -o " + (out / "x.mp4").string(), kBroken / "scripts",
                       message, out);
}

TEST(BrokenInput, EveryRigIsRefusedByRender) {
    const Json expected = expected_in("rigs");
    expect_complete("rigs", expected);
    const Folder out;
    for (const auto& [file, message] : expected.items())
        expect_refused("render ../../../../samples/smile/script.json --rig " + file + " -o " +
                           (out / "x.mp4").string(),
                       kBroken / "rigs", message, out);
}

TEST(BrokenInput, EveryLandmarkFileIsRefusedByFit) {
    const Json expected = expected_in("landmarks");
    expect_complete("landmarks", expected);
    const Folder out;
    for (const auto& [file, message] : expected.items())
        expect_refused("fit ../../heads/plain_head.obj --landmarks " + file + " -o " +
                           (out / "rig.json").string(),
                       kBroken / "landmarks", message, out);
}

TEST(BrokenInput, EveryExperimentIsRefusedByFigure) {
    const Json expected = expected_in("experiments");
    expect_complete("experiments", expected);
    const Folder out;
    for (const auto& [file, message] : expected.items())
        expect_refused("figure " + file + " -o " + (out / "figure").string(),
                       kBroken / "experiments", message, out);
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
        const std::string quoted = "\"" + file + "\"";
        if (const std::size_t at = text.rfind("for the file format of file " + quoted);
            at != std::string::npos)
            text.replace(text.find(quoted, at), quoted.size(),
                         "\"" + (kBroken / "meshes" / file).string() + "\"");
        expect_refused("render " + (kRoot / "samples/smile/script.json").string() + " --rig " +
                           (rigs / "rig.json").string() + " -o " + (out / "x.mp4").string(),
                       kRoot, text, out);
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
