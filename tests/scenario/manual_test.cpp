// SPDX-License-Identifier: MIT
// The manual holds: its commands run, its links lead somewhere, its site builds. A suite per part, so that they run side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

/// Runs a command in the root of the repository and catches standard error too.
ShellResult shell(const std::string& command) {
    return run_shell("cd '" + kRoot.string() + "' && { " + command + "; } 2>&1");
}

bool installed(const std::string& program) { return shell("command -v " + program).code == 0; }

/// Runs the examples of the pages, relative to the root of the repository.
void expect_examples_run(const std::vector<std::string>& pages) {
    ASSERT_FALSE(pages.empty());
    std::string command =
        "python3 tools/docs/run_examples.py --program '" RISORIUS_BINARY_DIR "/risorius'";
    for (const std::string& page : pages) command += " '" + page + "'";
    const ShellResult result = shell(command);
    EXPECT_EQ(result.code, 0) << result.output;
}

/// The pages right inside a folder, in the order of their names.
std::vector<std::string> pages_in(const std::string& folder) {
    std::vector<std::string> pages;
    for (const auto& entry : fs::directory_iterator(kRoot / folder))
        if (entry.path().extension() == ".md")
            pages.push_back(folder + "/" + entry.path().filename().string());
    std::sort(pages.begin(), pages.end());
    return pages;
}

TEST(ManualFirstSteps, CommandsRun) {
    std::vector<std::string> pages = pages_in("docs");
    pages.insert(pages.begin(), "README.md");
    expect_examples_run(pages);
}

TEST(ManualTutorials, CommandsRun) { expect_examples_run(pages_in("docs/tutorials")); }

TEST(ManualHowTo, CommandsRun) { expect_examples_run(pages_in("docs/howto")); }

TEST(ManualReference, CommandsRun) {
    std::vector<std::string> pages;
    for (const char* folder : {"docs/formats", "docs/theory"})
        for (const std::string& page : pages_in(folder)) pages.push_back(page);
    expect_examples_run(pages);
}

TEST(ManualSite, LinksLeadSomewhere) {
    const ShellResult result = shell("tools/docs.sh --links");
    EXPECT_EQ(result.code, 0) << result.output;
}

TEST(ManualSite, BuildsWithoutWarnings) {
    if (!installed("mkdocs") || !installed("doxygen"))
        GTEST_SKIP() << "mkdocs and doxygen are not installed (tools/setup.sh docs)";
    const ShellResult result = shell("tools/docs.sh");
    EXPECT_EQ(result.code, 0) << result.output;
}

TEST(ManualReadme, IsOnePage) {
    const std::string text = text_of(kRoot / "README.md");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 200);
}

}  // namespace
}  // namespace risorius::scenario
