// SPDX-License-Identifier: MIT
#include "risorius/io/detail/import_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/io/mesh_message.h"

extern char** environ;

namespace risorius::io::detail {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kVariable = "RISORIUS_IMPORT_MESH";
constexpr auto kAskEvery = std::chrono::milliseconds(100);
// Time that passes, over processor time: other programs may run too.
constexpr int kPatience = 10;

bool can_run(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

fs::path import_program(const std::string& mesh) {
    if (const char* named = std::getenv(kVariable); named && *named) {
        if (!can_run(named)) throw Error(kVariable, "a program", in_quotes(named));
        return named;
    }
    std::vector<fs::path> folders;
    if (const fs::path own = code_folder(); !own.empty())
        for (const char* beside : {"", "..", "../libexec/risorius", "../../libexec/risorius"})
            folders.push_back((own / beside).lexically_normal());
    try {
        folders.push_back((data_folder() / "../../libexec/risorius").lexically_normal());
    } catch (const Error&) {
        // Nor is there an installation.
    }
    std::string listed;
    for (const fs::path& folder : folders) {
        if (can_run(folder / kImportProgram)) return folder / kImportProgram;
        listed += (listed.empty() ? "" : ", ") + folder.string();
    }
    throw Error(
        mesh,
        std::string("the program ") + kImportProgram +
            ", which reads files of this kind, in the place that the environment variable " +
            kVariable + " names, or in one of " + listed,
        "none");
}

/// The program while it runs. It ends with this object at the latest.
class Importer {
  public:
    Importer(const fs::path& program, const fs::path& file) {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("a pipe");
        output_ = ends[0];
        posix_spawn_file_actions_t actions;
        posix_spawnattr_t attributes;
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawnattr_init(&attributes);
        ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        // What this process does with signals is not handed on.
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        sigdelset(&all, SIGKILL);
        sigdelset(&all, SIGSTOP);
        ::posix_spawnattr_setsigmask(&attributes, &none);
        ::posix_spawnattr_setsigdefault(&attributes, &all);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        std::string name = program.string(), mesh = file.string();
        char* arguments[] = {name.data(), mesh.data(), nullptr};
        const int problem =
            ::posix_spawn(&process_, name.c_str(), &actions, &attributes, arguments, environ);
        ::posix_spawn_file_actions_destroy(&actions);
        ::posix_spawnattr_destroy(&attributes);
        ::close(ends[1]);
        if (problem != 0) {
            process_ = -1;
            ::close(output_);
            errno = problem;
            fail("the program " + name);
        }
    }
    ~Importer() {
        kill();
        ::close(output_);
    }
    Importer(const Importer&) = delete;
    Importer& operator=(const Importer&) = delete;

    /// Reads exactly `size` bytes of its output. Returns false when it ends early, or at the deadline.
    bool read(void* data, std::size_t size, Clock::time_point deadline,
              const std::function<bool()>& stopped) {
        auto* to = static_cast<char*>(data);
        while (size > 0) {
            if (stopped && stopped()) throw Interrupted();
            if (Clock::now() > deadline) {
                too_late_ = true;
                return false;
            }
            pollfd ready{output_, POLLIN, 0};
            if (::poll(&ready, 1, static_cast<int>(kAskEvery.count())) <= 0) continue;
            const ssize_t got = ::read(output_, to, size);
            if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
            if (got <= 0) return false;
            to += got;
            size -= static_cast<std::size_t>(got);
        }
        return true;
    }

    bool too_late() const { return too_late_; }

    /// Waits for its end. Nothing when somebody else has waited for it.
    std::optional<int> status() {
        int status = 0;
        pid_t done = 0;
        do done = ::waitpid(process_, &status, 0);
        while (done < 0 && errno == EINTR);
        const bool known = done == process_;
        process_ = -1;
        return known ? std::optional<int>(status) : std::nullopt;
    }

    void kill() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        status();
    }

  private:
    [[noreturn]] static void fail(const std::string& what) {
        throw RunError(what + " for reading a mesh: " + std::strerror(errno));
    }

    pid_t process_ = -1;
    int output_ = -1;
    bool too_late_ = false;
};

/// Why the program gave no mesh.
std::string reason(std::optional<int> status, const ImportLimits& limits) {
    const std::string time = "it took more than " + std::to_string(limits.processor_s) + " s";
    if (!status) return "it stopped early";
    if (WIFSIGNALED(*status)) {
        const int signal = WTERMSIG(*status);
        if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) throw Interrupted();
        if (signal == SIGXCPU) return time;
        return signal == SIGKILL ? "it was killed" : "it crashed";
    }
    if (WEXITSTATUS(*status) == kOutOfMemory)
        return "it took more than " + std::to_string(limits.memory_bytes / kMegabyte) +
               " MB of memory";
    return "it stopped early";
}

}  // namespace

geom::PolygonMesh import_mesh(const fs::path& file, const std::function<bool()>& stopped) {
    const std::string name = file.string();
    const fs::path program = import_program(name);
    const ImportLimits limits = import_limits(fs::file_size(file));
    const auto deadline = Clock::now() + std::chrono::seconds(kPatience * limits.processor_s);
    Importer importer(program, file);
    MeshProblem problem;
    std::optional<geom::PolygonMesh> mesh = read_mesh_message(
        [&](void* data, std::size_t size) { return importer.read(data, size, deadline, stopped); },
        problem);
    if (!problem.expected.empty() && mesh)
        throw Error(problem.place, problem.expected, problem.found);
    if (mesh) return std::move(*mesh);
    std::string why = "it took too long";
    if (!importer.too_late()) {
        why = reason(importer.status(), limits);
    }
    throw Error(name, "a mesh", "one that the mesh importer could not read: " + why);
}

}  // namespace risorius::io::detail
