// SPDX-License-Identifier: MIT
// The library and the program as others have them: installed, moved, found by CMake and pkg-config, far from the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "paths.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;

const fs::path kSamples = fs::path(RISORIUS_SOURCE_DIR) / "samples/cpp";

/// What a command prints, standard error too, and its exit code; without the data folder that tests may be given.
ShellResult run(const std::string& command) {
    // By way of bash whatever the system's shell is, since completions are bash's
    const std::string script = "exec bash -c \"$(cat <<'END_OF_TEST'\nunset RISORIUS_DATA\n" +
                               command + "\nEND_OF_TEST\n)\" 2>&1";
    return run_shell(script);
}

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

/// Installed once for the suite, then moved: an installation must not know where it was made.
class Installed : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        const fs::path first = *folder_ / "first";
        install_ =
            run("cmake --install " + quoted(RISORIUS_BINARY_DIR) + " --prefix " + quoted(first));
        fs::create_directories(prefix().parent_path());
        if (install_.code == 0) fs::rename(first, prefix());
    }
    static void TearDownTestSuite() { folder_.reset(); }
    void SetUp() override { ASSERT_EQ(install_.code, 0) << install_.output; }

    static fs::path prefix() { return *folder_ / "opt/risorius"; }
    static fs::path scratch(const std::string& name) { return *folder_ / name; }
    /// The samples against the installation, built when first asked for.
    static const ShellResult& samples() {
        static const ShellResult said =
            run("cmake -S " + quoted(kSamples) + " -B " + quoted(scratch("samples")) +
                " -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=" + quoted(prefix()) +
                " && cmake --build " + quoted(scratch("samples")));
        return said;
    }

  private:
    static std::unique_ptr<TemporaryFolder> folder_;
    static ShellResult install_;
};
std::unique_ptr<TemporaryFolder> Installed::folder_;
ShellResult Installed::install_;

TEST_F(Installed, ProgramFindsItsDataFromAnyFolder) {
    const ShellResult said =
        run("cd / && " + quoted(prefix() / "bin/risorius") +
            " head --identity imani --mesh-only --quiet -o " + quoted(scratch("imani")));
    EXPECT_EQ(said.code, 0) << said.output;
    EXPECT_TRUE(fs::exists(scratch("imani") / "head.obj"));
    const ShellResult still =
        run("cd / && " + quoted(prefix() / "bin/risorius") + " render " +
            quoted(prefix() / "share/risorius/samples/smile/script.json") +
            " --still 0.1 --draft --size 64x64 --quiet -o " + quoted(scratch("still.png")));
    EXPECT_EQ(still.code, 0) << still.output;
    EXPECT_GT(fs::file_size(scratch("still.png")), 500u);
}

TEST_F(Installed, SamplesBuildWithoutTheSources) {
    EXPECT_EQ(samples().code, 0) << samples().output;
    EXPECT_EQ(samples().output.find("warning"), std::string::npos) << samples().output;
}

TEST_F(Installed, FaceToPictureMovesTheCornerOfTheMouthAndDrawsIt) {
    ASSERT_EQ(samples().code, 0);
    const ShellResult said =
        run(quoted(scratch("samples/face_to_picture")) + " " + quoted(scratch("smile.png")));
    EXPECT_EQ(said.code, 0) << said.output;
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(
        std::sscanf(said.output.c_str(), "left corner of the mouth: %lf %lf %lf mm", &x, &y, &z), 3)
        << said.output;
    EXPECT_GT(x, 25);  // at rest it is 23 mm from the middle
    EXPECT_GT(fs::file_size(scratch("smile.png")), 20'000u);
}

TEST_F(Installed, FaceNumbersFollowTheSmile) {
    ASSERT_EQ(samples().code, 0);
    const ShellResult said =
        run(quoted(scratch("samples/face_numbers")) + " " + quoted(scratch("numbers.obj")));
    EXPECT_EQ(said.code, 0) << said.output;
    std::istringstream lines(said.output);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "t_s\tcorner_y_mm\tlength_mm\tforce_n\tstress_kpa\tenergy_mj");
    int rows = 0;
    double y[2]{}, length[2]{}, force = 0, stress = 0;
    for (; std::getline(lines, line); ++rows) {
        double time = 0, corner = 0, now = 0, energy = 0;
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf %lf %lf %lf %lf %lf", &time, &corner, &now, &force,
                              &stress, &energy),
                  6)
            << line;
        y[rows > 0] = corner;
        length[rows > 0] = now;
    }
    EXPECT_EQ(rows, 60);
    EXPECT_GT(y[1], y[0] + 5);            // the corner of the mouth rises
    EXPECT_LT(length[1], length[0] - 3);  // the muscle shortens
    EXPECT_GT(force, 0.5);
    EXPECT_GT(stress, 20);
    EXPECT_GT(fs::file_size(scratch("numbers.obj")), 100'000u);
}

TEST_F(Installed, SoftBodyKeepsItsVolume) {
    ASSERT_EQ(samples().code, 0);
    const ShellResult said = run(quoted(scratch("samples/soft_body")));
    EXPECT_EQ(said.code, 0) << said.output;
    std::istringstream lines(said.output);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "time_s\tlowest_mm\tvolume_percent");
    int rows = 0;
    double first = 0, last = 0;
    while (std::getline(lines, line)) {
        double time = 0, lowest = 0, volume = 0;
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf %lf %lf", &time, &lowest, &volume), 3) << line;
        EXPECT_NEAR(volume, 100, 8) << line;
        (rows++ == 0 ? first : last) = lowest;
    }
    EXPECT_EQ(rows, 11);
    EXPECT_LT(last, first - 5);  // it hangs down by more than 5 mm
}

TEST_F(Installed, BakeShapesWritesAGlb) {
    ASSERT_EQ(samples().code, 0);
    const ShellResult said =
        run(quoted(scratch("samples/bake_shapes")) + " " + quoted(scratch("shapes")));
    EXPECT_EQ(said.code, 0) << said.output;
    EXPECT_GT(fs::file_size(scratch("shapes") / "shapes.glb"), 100'000u);
}

TEST_F(Installed, ComponentThatWasNotAskedForIsNamed) {
    const fs::path project = scratch("components");
    fs::create_directories(project);
    std::ofstream(project / "main.cpp") << "int main() {}\n";
    const auto configured = [&](const std::string& components, const std::string& linked) {
        std::ofstream(project / "CMakeLists.txt")
            << "cmake_minimum_required(VERSION 3.25)\nproject(components CXX)\n"
            << "find_package(risorius CONFIG REQUIRED COMPONENTS " << components << ")\n"
            << "add_executable(it main.cpp)\ntarget_link_libraries(it PRIVATE risorius::" << linked
            << ")\n";
        return run("cd " + quoted(project) +
                   " && cmake -S . -B build --fresh -DCMAKE_PREFIX_PATH=" + quoted(prefix()));
    };
    const ShellResult too_few = configured("face io", "scene");
    EXPECT_EQ(too_few.code, 1);
    EXPECT_NE(too_few.output.find("risorius::add_scene_to_the_COMPONENTS_of_find_package"),
              std::string::npos)
        << too_few.output;
    for (const char* alone : {"scene", "io", "solve", "core"}) {
        const ShellResult enough = configured(alone, alone);
        EXPECT_EQ(enough.code, 0) << enough.output;
    }
}

TEST_F(Installed, PkgConfigLinksAProgram) {
    const ShellResult said = run(
        "export PKG_CONFIG_PATH=$(dirname \"$(find " + quoted(prefix()) +
        " -name risorius.pc)\"); " + "c++ " + quoted(kSamples / "soft_body.cpp") + " -o " +
        quoted(scratch("soft_body")) +
        " $(pkg-config --cflags --libs risorius) && " +  // shared libraries lie there
        "LD_LIBRARY_PATH=$(pkg-config --variable=libdir risorius) " + quoted(scratch("soft_body")));
    EXPECT_EQ(said.code, 0) << said.output;
    EXPECT_TRUE(said.output.starts_with("time_s\t")) << said.output;
}

// A program that would see other layouts than the library does is refused when it is compiled, not when it crashes.
TEST_F(Installed, OtherFlagsThanTheLibrarysAreRefused) {
    const std::string compile = "c++ -std=c++20 -fsyntax-only -I/usr/include/eigen3 -I" +
                                quoted(prefix() / "include") + " ";
    const ShellResult bare = run(compile + quoted(kSamples / "soft_body.cpp"));
    EXPECT_NE(bare.code, 0);
    EXPECT_NE(bare.output.find("Compile with the flags of the library"), std::string::npos)
        << bare.output;
}

TEST_F(Installed, ManPagesAndCompletionsKnowEveryCommand) {
    const ShellResult completed =
        run("source " + quoted(prefix() / "share/bash-completion/completions/risorius") +
            " && COMP_WORDS=(risorius ba) COMP_CWORD=1 && _risorius && echo \"${COMPREPLY[@]}\" "
            "&& COMP_WORDS=(risorius render --cam) COMP_CWORD=2 && _risorius && echo "
            "\"${COMPREPLY[@]}\"");
    EXPECT_EQ(completed.output, "batch\n--camera\n");
    for (const char* page : {"risorius.1.gz", "risorius-render.1.gz", "risorius-batch.1.gz"})
        EXPECT_TRUE(fs::exists(prefix() / "share/man/man1" / page)) << page;
}

}  // namespace
}  // namespace risorius
