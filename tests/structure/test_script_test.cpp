// SPDX-License-Identifier: MIT
// tools/test.sh with stand-ins for cmake and ctest: what it has run, and whether it tells of what fails.
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

#include "shell.h"
#include "structure/source_tree.h"
#include "temporary_folder.h"

namespace risorius::structure {
namespace {

namespace fs = std::filesystem;

class TestScript : public testing::Test {
  protected:
    TestScript() {
        stand_in("cmake", "[[ $* != *'--build --preset check'* ]] || exit ${CHECK_BUILD:-0}");
        stand_in("ctest",
                 "echo '100% tests passed'\n"
                 "if [[ $* == *'preset release'* ]]; then exit ${RELEASE:-0}; fi\n"
                 "exit ${CHECK:-0}");
    }
    /// Its exit code; `environment` is what the stand-ins are to answer.
    int run(const std::string& environment, const std::string& argument = "") const {
        std::ofstream(folder_ / "calls").close();
        const std::string command = "PATH='" + folder_.path().string() +
                                    "':\"$PATH\" RISORIUS_SKIP_SETUP=1 " + environment + " '" +
                                    (source_dir() / "tools/test.sh").string() + "' " + argument +
                                    " >'" + (folder_ / "said").string() + "' 2>&1";
        return exit_code(std::system(command.c_str()));
    }
    /// The call that begins so.
    std::string call(const std::string& begin) const {
        std::ifstream calls(folder_ / "calls");
        for (std::string line; std::getline(calls, line);)
            if (line.starts_with(begin)) return line;
        return "";
    }
    /// The regular expression of the labels whose tests are run in a build.
    std::string labels(const std::string& build) const {
        const std::string run = call("ctest --preset " + build), option = "--label-regex ";
        const std::size_t begin = run.find(option);
        if (begin == std::string::npos) return "";
        return run.substr(begin + option.size());
    }

  private:
    void stand_in(const char* program, const std::string& script) const {
        const fs::path file = folder_ / program;
        std::ofstream(file) << "#!/usr/bin/env bash\necho \"" << program << " $*\" >>'"
                            << (folder_ / "calls").string() << "'\n"
                            << script << "\nexit 0\n";
        fs::permissions(file, fs::perms::owner_all);
    }
    TemporaryFolder folder_;
};

TEST_F(TestScript, FailsWhenABuildOrATestDoes) {
    EXPECT_EQ(run(""), 0);
    for (const char* failing : {"RELEASE=1", "CHECK=1", "CHECK_BUILD=1"})
        EXPECT_EQ(run(failing), 1) << failing;
    EXPECT_EQ(run("", "--no-sanitizers"), 0);
    EXPECT_EQ(call("ctest --preset check"), "");
    EXPECT_EQ(run("", "--sanitizers"), 2);
}

TEST_F(TestScript, RunsTheTestsOfEveryFolderInOneBuildOrTheOther) {
    ASSERT_EQ(run(""), 0);
    const std::regex release(labels("release")), check(labels("check"));
    for (const auto& entry : fs::recursive_directory_iterator(source_dir() / "tests")) {
        if (!entry.path().filename().string().ends_with("_test.cpp")) continue;
        const std::string folder = entry.path().parent_path().filename().string();
        const bool here = std::regex_match(folder, release),
                   there = std::regex_match(folder, check);
        EXPECT_NE(here, there) << folder;
        const std::string built =
            call(here ? "cmake --build --preset release" : "cmake --build --preset check");
        EXPECT_NE((built + " ").find(" " + folder + "_test "), std::string::npos) << folder;
    }
}

}  // namespace
}  // namespace risorius::structure
