// SPDX-License-Identifier: MIT
// risorius landmarks, and fit without landmarks. What needs the face network is skipped where tools/web/fetch_weights.sh has not
// fetched it.
#include <gtest/gtest.h>

#include <filesystem>

#include "paths.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;

const std::string kLandmarksProgram = RISORIUS_BINARY_DIR "/risorius",
                  kAdultMesh = RISORIUS_SOURCE_DIR "/models/adult/head.obj";

bool has_network() { return fs::exists(RISORIUS_BINARY_DIR "/web/facemesh/facemesh.bin"); }

bool says(const ShellResult& result, const std::string& text) {
    return result.output.find(text) != std::string::npos;
}

TEST(LandmarksCommand, WithoutTheNetworkItSaysWhatToRun) {
    // The weights lie beside the program: a copy of it elsewhere has none.
    const TemporaryFolder folder;
    const fs::path program = folder / "risorius";
    fs::copy_file(kLandmarksProgram, program);
    const std::string data = "RISORIUS_DATA=" RISORIUS_SOURCE_DIR " ";
    for (const std::string command : {"landmarks", "fit"}) {
        const ShellResult result =
            run_shell(data + program.string() + " " + command + " " + kAdultMesh + " -o " +
                      (folder / "x.json").string() + " 2>&1");
        EXPECT_EQ(result.code, 2) << command;
        EXPECT_TRUE(says(result, "where tools/web/fetch_weights.sh puts them")) << result.output;
    }
    EXPECT_EQ(folder.listing(), std::set<std::string>{"risorius"});
}

TEST(LandmarksCommand, FitFindsThemSaysSoAndKeepsThem) {
    if (!has_network()) GTEST_SKIP() << "no face network: tools/web/fetch_weights.sh";
    const TemporaryFolder folder;
    const std::string fit = kLandmarksProgram + " fit " + kAdultMesh + " -o " +
                            (folder / "rig.json").string() + " --no-calibrate --quiet 2>&1";
    const ShellResult first =
        run_shell(fit + " && " + kLandmarksProgram + " check " + (folder / "rig.json").string() +
                  " " + (folder / "rig_landmarks.json").string());
    EXPECT_EQ(first.code, 0) << first.output;
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"rig.json", "rig_landmarks.json"}));
    // Corrected landmarks are not written over.
    const std::string before = bytes_of(folder / "rig_landmarks.json");
    const ShellResult again = run_shell(fit);
    EXPECT_EQ(again.code, 2);
    EXPECT_TRUE(says(again, "rig_landmarks.json: expected no file, since")) << again.output;
    EXPECT_EQ(bytes_of(folder / "rig_landmarks.json"), before);
}

TEST(LandmarksCommand, ItsBytesDoNotDependOnTheNumberOfThreads) {
    if (!has_network()) GTEST_SKIP() << "no face network: tools/web/fetch_weights.sh";
    const TemporaryFolder folder;
    const auto found = [&](const std::string& with, const std::string& name) {
        const fs::path file = folder / name;
        EXPECT_EQ(run_shell(with + kLandmarksProgram + " landmarks " + kAdultMesh + " -o " +
                            file.string() + " --quiet 2>&1")
                      .code,
                  0);
        return bytes_of(file);
    };
    EXPECT_EQ(found("taskset -c 0 ", "one.json"), found("", "all.json"));
}

}  // namespace
}  // namespace risorius
