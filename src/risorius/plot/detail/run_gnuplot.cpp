// SPDX-License-Identifier: MIT
#include "risorius/plot/detail/run_gnuplot.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "risorius/core/error.h"

extern char** environ;

namespace risorius::plot {
namespace {

/// A pipe that closes its ends itself and that no other child inherits.
class Pipe {
  public:
    Pipe() {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
            throw RunError(std::string("gnuplot: cannot be started: ") + std::strerror(errno));
    }
    ~Pipe() {
        close_writing();
        ::close(ends_[0]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int writing() const { return ends_[1]; }
    void close_writing() {
        if (ends_[1] >= 0) ::close(ends_[1]);
        ends_[1] = -1;
    }
    std::string read_to_end() const {
        std::string text;
        std::array<char, 4096> block;
        for (;;) {
            const ssize_t got = ::read(ends_[0], block.data(), block.size());
            if (got > 0) text.append(block.data(), static_cast<std::size_t>(got));
            if (got == 0 || (got < 0 && errno != EINTR)) return text;
        }
    }

  private:
    std::array<int, 2> ends_{-1, -1};
};

class SpawnSettings {
  public:
    SpawnSettings(const std::filesystem::path& folder, int errors) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
        // A process group of its own, so that Ctrl-C reaches only this program, which then ends in order.
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    posix_spawn_file_actions_t* actions() { return &actions_; }
    posix_spawnattr_t* attributes() { return &attributes_; }

  private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
};

// The caller's environment without what changes gnuplot's output: language, number formats, gnuplot's own variables.
std::vector<std::string> environment() {
    std::vector<std::string> settings;
    for (char** entry = environ; *entry; ++entry) {
        const std::string_view text = *entry;
        if (text.starts_with("LC_") || text.starts_with("LANG") || text.starts_with("GNUPLOT") ||
            text.starts_with("GNUTERM"))
            continue;
        settings.emplace_back(text);
    }
    settings.emplace_back("LC_ALL=C.UTF-8");
    return settings;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

std::string without_blank_ends(std::string text) {
    const auto blank = [](char c) { return c == '\n' || c == ' ' || c == '\r'; };
    while (!text.empty() && blank(text.back())) text.pop_back();
    std::size_t begin = 0;
    while (begin < text.size() && blank(text[begin])) ++begin;
    return text.substr(begin);
}

}  // namespace

void run_gnuplot(const std::string& program, const std::string& script,
                 const std::filesystem::path& folder) {
    std::vector<std::string> arguments{program, "-d", script};
    std::vector<std::string> settings = environment();
    const std::vector<char*> argv = pointers_to(arguments), envp = pointers_to(settings);
    Pipe errors;
    SpawnSettings spawn(folder, errors.writing());
    pid_t child = 0;
    const int failure = ::posix_spawnp(&child, program.c_str(), spawn.actions(), spawn.attributes(),
                                       argv.data(), envp.data());
    if (failure == ENOENT && std::filesystem::is_directory(folder))
        throw RunError(program +
                       ": not found; charts are drawn by it (Debian package gnuplot-nox)");
    if (failure != 0)
        throw RunError(program + ": cannot be started in " + folder.string() + ": " +
                       std::strerror(failure));
    errors.close_writing();
    const std::string said = errors.read_to_end();
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status))
        throw RunError(program + " " + script + ": ended by signal " +
                       std::to_string(WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0)
        throw RunError(program + " " + script + ": exit code " +
                       std::to_string(WEXITSTATUS(status)) + ": " + without_blank_ends(said));
}

}  // namespace risorius::plot
