// SPDX-License-Identifier: MIT
#include "risorius/report/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>

#include "risorius/core/error.h"

namespace risorius::report {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kAskEvery_ms = 100;
constexpr auto kPatience = std::chrono::seconds(5);

struct Pipe {
    std::array<int, 2> ends{-1, -1};
    explicit Pipe(const std::string& program) {
        if (pipe2(ends.data(), O_CLOEXEC) != 0) throw RunError(program + ": cannot be started");
    }
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close_end(std::size_t i) {
        if (ends[i] >= 0) close(ends[i]);
        ends[i] = -1;
    }
};

std::vector<char*> words_of(const std::vector<std::string>& texts) {
    std::vector<char*> words;
    for (const std::string& text : texts) words.push_back(const_cast<char*>(text.c_str()));
    words.push_back(nullptr);
    return words;
}

std::vector<std::string> environment_with(const std::vector<std::string>& added) {
    std::vector<std::string> out = added;
    for (char** entry = environ; *entry; ++entry) {
        const std::string one = *entry, name = one.substr(0, one.find('=') + 1);
        bool replaced = false;
        for (const std::string& other : added) replaced = replaced || other.starts_with(name);
        if (!replaced) out.push_back(one);
    }
    return out;
}

/// What the child does before it is the program: only calls that are allowed between fork and exec.
[[noreturn]] void become(const std::vector<char*>& words, const std::vector<char*>& environment,
                         int out, int failure, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);  // it has ended meanwhile
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvpe(words[0], words.data(), environment.data());
    const int error = errno;
    if (write(failure, &error, sizeof error) < 0) _exit(1);
    _exit(1);
}

/// Gives whole lines on, and keeps what is not complete yet.
class Lines {
  public:
    explicit Lines(const ProgramWatch& watch) : watch_(watch) {}
    void take(const char* text, std::size_t size) {
        if (!watch_.line) return;
        rest_.append(text, size);
        for (std::size_t end; (end = rest_.find('\n')) != std::string::npos;
             rest_.erase(0, end + 1))
            watch_.line(rest_.substr(0, end));
    }

  private:
    const ProgramWatch& watch_;
    std::string rest_;
};

/// Reads what the program writes until it ends, and stops it when that is asked for.
std::string read_output(int from, pid_t pid, const ProgramWatch& watch) {
    std::string output;
    Lines lines(watch);
    Clock::time_point asked{};
    bool killed = false;
    for (;;) {
        pollfd waiting{from, POLLIN, 0};
        const int ready = poll(&waiting, 1, watch.stopped ? kAskEvery_ms : -1);
        if (watch.stopped && watch.stopped()) {
            if (asked == Clock::time_point{}) {
                asked = Clock::now();
                kill(pid, SIGTERM);
            } else if (!killed && Clock::now() - asked > kPatience) {
                killed = true;
                kill(pid, SIGKILL);
            }
        }
        if (ready <= 0) continue;
        std::array<char, 4096> some;
        const ssize_t got = read(from, some.data(), some.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return output;
        output.append(some.data(), static_cast<std::size_t>(got));
        lines.take(some.data(), static_cast<std::size_t>(got));
    }
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& command, const ProgramWatch& watch) {
    Pipe output(command[0]), failure(command[0]);
    const std::vector<std::string> variables = environment_with(watch.environment);
    const std::vector<char*> words = words_of(command), environment = words_of(variables);
    const pid_t parent = getpid(), pid = fork();
    if (pid < 0) throw RunError(command[0] + ": cannot be started");
    if (pid == 0) become(words, environment, output.ends[1], failure.ends[1], parent);
    output.close_end(1);
    failure.close_end(1);
    int error = 0;
    while (read(failure.ends[0], &error, sizeof error) < 0 && errno == EINTR) {
    }
    ProgramResult result;
    if (error == 0) result.output = read_output(output.ends[0], pid, watch);
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (error != 0 && error != ENOENT) throw RunError(command[0] + ": cannot be started");
    result.exit_code = error == ENOENT     ? 127
                       : WIFEXITED(status) ? WEXITSTATUS(status)
                                           : 128 + WTERMSIG(status);
    return result;
}

}  // namespace risorius::report
