// SPDX-License-Identifier: MIT
// Other programs: what they say, how they are stopped, and that none is left behind.
#include "risorius/report/run_program.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace risorius::report {
namespace {

using Lines = std::vector<std::string>;

TEST(RunProgram, GivesOutputCodeAndLines) {
    Lines lines;
    const ProgramResult result =
        run_program({"sh", "-c", "echo one; printf 'two\\nthr' >&2; printf 'ee\\nrest'; exit 3"},
                    {.line = [&](const std::string& line) { lines.push_back(line); }});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(result.output, "one\ntwo\nthree\nrest");
    EXPECT_EQ(lines, (Lines{"one", "two", "three"}));
    EXPECT_EQ(run_program({"no-such-program-anywhere"}).exit_code, 127);
    EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}).exit_code, 128 + SIGKILL);
    EXPECT_ANY_THROW(run_program({"/"}));  // no program
}

TEST(RunProgram, AddsVariablesAndKeepsTheOthers) {
    ::setenv("RISORIUS_TEST_KEPT", "kept", 1);
    ::setenv("RISORIUS_TEST_OTHER", "before", 1);
    const ProgramWatch watch{.environment = {"RISORIUS_TEST_OTHER=now"}};
    EXPECT_EQ(
        run_program({"sh", "-c", "echo $RISORIUS_TEST_KEPT $RISORIUS_TEST_OTHER"}, watch).output,
        "kept now\n");
}

TEST(RunProgram, StopsAProgramThatCleansUp) {
    std::atomic<bool> began = false;
    const auto begin = std::chrono::steady_clock::now();
    const ProgramResult result = run_program(
        {"sh", "-c", "trap 'echo cleaned; exit 9' TERM; echo began; while :; do sleep 0.05; done"},
        {.line = [&](const std::string&) { began = true; },
         .stopped = [&] { return began.load(); }});
    EXPECT_EQ(result.exit_code, 9);
    EXPECT_EQ(result.output, "began\ncleaned\n");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(4));
}

// A process that runs a program is killed, which it cannot notice itself: the program must not live on.
TEST(RunProgram, TheProgramEndsWithThisProcess) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    const pid_t middle = fork();
    if (middle == 0) {
        close(ends[0]);
        // The pipe stays open in the program until it ends.
        dup2(ends[1], 9);
        run_program({"sh", "-c", "echo began >&9; exec sleep 60"});
        _exit(0);
    }
    close(ends[1]);
    char some[16];
    ASSERT_EQ(read(ends[0], some, sizeof some), 6);
    kill(middle, SIGKILL);
    waitpid(middle, nullptr, 0);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(read(ends[0], some, sizeof some), 0);  // its end
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    close(ends[0]);
}

}  // namespace
}  // namespace risorius::report
