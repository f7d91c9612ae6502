// SPDX-License-Identifier: MIT
// What the manual shows is what happens: examples follow their schema, names of sources and options are
// right. tests/scenario/manual_test.cpp runs its commands.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "shell.h"
#include "temporary_folder.h"
#include "tools/risorius/schema_check.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RISORIUS_SOURCE_DIR;

/// Runs a command in the root of the repository and catches standard error too.
ShellResult run(const std::string& command) {
    return run_shell("cd '" + kRoot.string() + "' && " + command + " 2>&1");
}

TEST(Documents, PageOfTheCommandLineSaysWhatHelpSays) {
    const TemporaryFolder folder;
    ASSERT_EQ(
        run("'" RISORIUS_BINARY_DIR "/risorius' manual-pages '" + folder.path().string() + "'")
            .code,
        0);
    EXPECT_TRUE(bytes_of(folder / "cli.md") == bytes_of(kRoot / "docs/cli.md"))
        << "docs/cli.md is not what the program says of itself; to make it anew: "
           "build/risorius manual-pages DIR && cp DIR/cli.md docs/";
}

TEST(Documents, PageOfTheThesisHasEveryClaimWithItsVerdict) {
    const std::string page = bytes_of(kRoot / "docs/validation/thesis.md");
    int claims = 0, rows = -2;  // without the head of the table
    for (const auto& entry : fs::directory_iterator(kRoot / "samples/figures")) {
        if (!fs::exists(entry.path() / "experiment.json")) continue;
        const Json json = JsonCursor::read_file(entry.path() / "experiment.json").json();
        if (!json.contains("claims")) continue;
        for (const Json& claim : json["claims"]) {
            ++claims;
            const std::string verdict = claim["verdict"];
            const std::string row = " | " + claim["says"].get<std::string>() + " | " +
                                    claim["finds"].get<std::string>() + " | " +
                                    (verdict == "missed" ? "**missed**" : verdict) + " |\n";
            EXPECT_TRUE(page.find(row) != std::string::npos)
                << "tools/docs/thesis_page.py makes docs/validation/thesis.md anew; missing:"
                << row;
        }
    }
    for (std::size_t at = 0; (at = page.find("\n|", at)) != std::string::npos; ++at) ++rows;
    EXPECT_EQ(rows, claims);
    EXPECT_GT(page.find("**missed**"), 0u);
}

TEST(Documents, PageOfThePeopleIsMadeOfWhatWasMeasured) {
    const std::string tool = (kRoot / "tools/docs/people_page.py").string();
    EXPECT_EQ(run_shell("python3 \"" + tool + "\" --check").code, 0)
        << "tools/docs/people_page.py makes docs/validation/people.md anew";
}

// Pages and comments name sources by module and file: "face/face.cpp".
TEST(Documents, SourcesThatPagesAndCommentsNameAreThere) {
    std::string modules;
    for (const auto& entry : fs::directory_iterator(kRoot / "src/risorius"))
        modules += (modules.empty() ? "" : "|") + entry.path().filename().string();
    const std::regex named("(^|[^\\w/.])(?:src/risorius/)?((?:" + modules +
                           ")/[a-z0-9_/]+\\.(?:h|cpp))");
    int names = 0;
    for (const char* folder : {"docs", "samples", "rigs", "models", "src", "tools"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".md" && ending != ".h" && ending != ".cpp") continue;
            const std::string text = bytes_of(entry.path());
            for (std::sregex_iterator i(text.begin(), text.end(), named), end; i != end; ++i) {
                const std::string file = (*i)[2];
                EXPECT_TRUE(fs::exists(kRoot / "src/risorius" / file) || fs::exists(kRoot / file) ||
                            fs::exists(kRoot / "tests" / file))
                    << entry.path() << " names " << file;
                ++names;
            }
        }
    EXPECT_GT(names, 100);
}

// Examples that say which format they are follow its schema.
TEST(Documents, ExamplesOfFormatsFollowTheirSchema) {
    const std::regex example(
        "<!-- schema: (risorius-[a-z-]+) -->\n(?:<!-- [^\n]* -->\n)*```json\n([^`]*)```");
    int examples = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
        if (entry.path().extension() != ".md") continue;
        const std::string text = bytes_of(entry.path());
        for (std::sregex_iterator i(text.begin(), text.end(), example), end; i != end; ++i) {
            const JsonCursor json = JsonCursor::from_json(Json::parse((*i)[2].str()), "example");
            EXPECT_EQ(message_of([&] { cli::check_against_schema(json, (*i)[1]); }), "no error")
                << entry.path();
            ++examples;
        }
    }
    EXPECT_GT(examples, 5);
}

}  // namespace
}  // namespace risorius
