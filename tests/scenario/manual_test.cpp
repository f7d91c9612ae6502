// SPDX-License-Identifier: MIT
// The manual holds: its commands run, its links lead somewhere, its site builds. A suite per part, so that they run side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

/// What a shell command says, standard error included.
Outcome shell(const std::string& command) {
    const Folder scratch;
    const std::string all =
        "cd '" + kRoot.string() + "' && " + command + " >'" + (scratch / "out").string() + "' 2>&1";
    const int status = std::system(all.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(scratch / "out"), ""};
}

bool installed(const std::string& program) { return shell("command -v " + program).code == 0; }

/// Runs the examples of the pages, relative to the root of the repository.
void expect_examples_run(const std::vector<std::string>& pages) {
    ASSERT_FALSE(pages.empty());
    std::string command =
        "python3 tools/docs/run_examples.py --program '" RISORIUS_BINARY_DIR "/risorius'";
    for (const std::string& page : pages) command += " '" + page + "'";
    const Outcome outcome = shell(command);
    EXPECT_EQ(outcome.code, 0) << outcome.out;
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
    const Outcome outcome = shell("tools/docs.sh --links");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
}

TEST(ManualSite, BuildsWithoutWarnings) {
    if (!installed("mkdocs") || !installed("doxygen"))
        GTEST_SKIP() << "mkdocs and doxygen are not installed (tools/setup.sh docs)";
    const Outcome outcome = shell("tools/docs.sh");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
}

TEST(ManualReadme, IsOnePage) {
    const std::string text = text_of(kRoot / "README.md");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 200);
}

}  // namespace
}  // namespace risorius::scenario
