// SPDX-License-Identifier: MIT
#include "risorius/report/run_program.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "risorius/core/error.h"

namespace risorius::report {

ProgramResult run_program(const std::vector<std::string>& command) {
    std::array<int, 2> pipe_ends{};
    if (pipe(pipe_ends.data()) != 0) throw RunError(command[0] + ": cannot be started");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    posix_spawn_file_actions_addclose(&actions, pipe_ends[0]);
    posix_spawn_file_actions_addclose(&actions, pipe_ends[1]);
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_t pid = 0;
    const int failed = posix_spawnp(&pid, words[0], &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    ProgramResult result;
    if (failed == 0) {
        std::array<char, 4096> some;
        for (;;) {
            const ssize_t got = read(pipe_ends[0], some.data(), some.size());
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) break;
            result.output.append(some.data(), static_cast<std::size_t>(got));
        }
    }
    close(pipe_ends[0]);
    if (failed != 0) {
        if (failed != ENOENT) throw RunError(command[0] + ": cannot be started");
        result.exit_code = 127;
        return result;
    }
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

}  // namespace risorius::report
