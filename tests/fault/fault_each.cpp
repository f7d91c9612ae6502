// SPDX-License-Identifier: MIT
#include "fault_each.h"

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <string>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace risorius::fault {

namespace {

constexpr int kPatience_s = 60;
bool copied = false;

std::string setting(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

[[noreturn]] void give_up(const char* what) {
    std::perror(what);
    ::_exit(99);
}

/// What is written below the folder from now on, this process and its children see alone.
void see_a_copy(const std::string& folder, const std::string& changes) {
    if (::unshare(CLONE_NEWNS) != 0) give_up("unshare");
    if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
        give_up("private mounts");
    const std::string upper = changes + "/upper", work = changes + "/work";
    for (const std::string& one : {changes, upper, work}) ::mkdir(one.c_str(), 0700);
    const std::string options =
        "lowerdir=" + folder + ",upperdir=" + upper + ",workdir=" + work + ",redirect_dir=on";
    if (::mount("overlay", folder.c_str(), "overlay", 0, options.c_str()) != 0) give_up("overlay");
}

/// Opens again in the copy of the folder what is open in the folder, with its locks.
void open_in_copy(const std::string& folder) {
    std::vector<int> open;
    DIR* all = ::opendir("/proc/self/fd");
    while (const dirent* one = ::readdir(all)) open.push_back(std::atoi(one->d_name));
    ::closedir(all);
    for (const int file : open) {
        char path[PATH_MAX] = "";
        const std::string link = "/proc/self/fd/" + std::to_string(file);
        if (file <= STDERR_FILENO || ::readlink(link.c_str(), path, sizeof path - 1) < 0) continue;
        if (std::strncmp(path, folder.c_str(), folder.size()) != 0) continue;
        const int flags = ::fcntl(file, F_GETFL) & ~(O_CREAT | O_EXCL | O_TRUNC);
        const int again = ::open(path, flags | O_CLOEXEC);
        if (again < 0) continue;  // one that was removed
        const off_t at = ::lseek(file, 0, SEEK_CUR);
        struct stat status {};
        const bool is_folder = ::fstat(file, &status) == 0 && S_ISDIR(status.st_mode);
        if (!is_folder && at > 0) ::lseek(again, at, SEEK_SET);
        if (is_folder || std::string(path).ends_with("/owner")) ::flock(again, LOCK_EX | LOCK_NB);
        ::dup3(again, file, O_CLOEXEC);
        ::close(again);
    }
}

/// At the end of a copy, before anything that waits for threads that it does not have
void end_at_once(int code, void*) {
    std::fflush(nullptr);
    ::_exit(code);
}

/// The exit code, or minus the signal; 1000 for one that does not end.
int wait_for(pid_t child) {
    for (int i = 0; i < 1000 * kPatience_s; ++i) {
        int status = 0;
        if (::waitpid(child, &status, WNOHANG) == child)
            return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
        ::usleep(1000);
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    return 1000;
}

/// Says how a copy has ended, and waits until somebody has looked at it.
void have_it_judged(int number, int fault, int ended, const std::string& mounts) {
    static const int asked =
        ::open((setting("FAULT_EACH") + "/asked").c_str(), O_WRONLY | O_CLOEXEC);
    static const int answered =
        ::open((setting("FAULT_EACH") + "/answered").c_str(), O_RDONLY | O_CLOEXEC);
    const std::string line = std::to_string(number) + " " + std::to_string(fault) + " " +
                             std::to_string(ended) + " " + mounts + "\n";
    char answer = 0;
    if (::write(asked, line.data(), line.size()) < 0 || ::read(answered, &answer, 1) != 1)
        give_up("judge");
}

/// Makes a copy of the process, in which it returns true. The process itself has its end judged, and returns false.
bool continue_in_copy(int number, int fault) {
    if (fault == -SIGKILL) {
        have_it_judged(number, fault, fault, "-");
        return false;
    }
    const std::string changes =
        setting("FAULT_EACH") + "/" + std::to_string(number) + "_" + std::to_string(fault);
    int seen[2], go[2];
    char byte = 0;
    if (::pipe2(seen, O_CLOEXEC) != 0 || ::pipe2(go, O_CLOEXEC) != 0) give_up("pipe");
    const pid_t copy = ::fork();
    if (copy < 0) give_up("fork");
    if (copy == 0) {
        see_a_copy(setting("FAULT_BELOW"), changes);
        if (::write(seen[1], "s", 1) != 1 || ::read(go[0], &byte, 1) != 1) give_up("pipe");
        for (const int file : {seen[0], seen[1], go[0], go[1]}) ::close(file);
        open_in_copy(setting("FAULT_BELOW"));
        const int errors =
            ::open((changes + "/errors").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
        ::dup2(errors, STDERR_FILENO);
        ::close(errors);
        ::on_exit(end_at_once, nullptr);
        copied = true;
        return true;
    }
    if (::read(seen[0], &byte, 1) != 1) give_up("copy");
    const int mounts =
        ::open(("/proc/" + std::to_string(copy) + "/ns/mnt").c_str(), O_RDONLY | O_CLOEXEC);
    if (::write(go[1], "g", 1) != 1) give_up("pipe");
    for (const int file : {seen[0], seen[1], go[0], go[1]}) ::close(file);
    const int ended = wait_for(copy);
    have_it_judged(number, fault, ended,
                   "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(mounts));
    ::close(mounts);
    return false;
}

}  // namespace

bool tries_each() { return !copied && std::getenv("FAULT_EACH"); }

bool is_copy() { return copied; }

int try_each(int number) {
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    if (::gettid() != ::getpid()) {
        std::ofstream(setting("FAULT_EACH") + "/of_threads", std::ios::app) << number << "\n";
        return 0;
    }
    if (number < std::atoi(setting("FAULT_FROM").c_str())) return 0;
    int part = 1, of = 1;
    if (std::sscanf(setting("FAULT_PART").c_str(), "%d/%d", &part, &of) == 2 &&
        (number - part) % of != 0)
        return 0;
    std::vector<int> faults;
    const std::string list = setting("FAULT_LIST") + ",";
    for (std::size_t at = 0; at < list.size(); at = list.find(',', at) + 1)
        faults.push_back(std::atoi(list.c_str() + at));
    const std::string turn = setting("FAULT_TURN");
    if (!turn.empty())
        faults = {faults[static_cast<std::size_t>(number + std::stoi(turn)) % faults.size()]};
    for (const int fault : faults) {
        if (!continue_in_copy(number, fault)) continue;
        if (fault > 0) return fault;
        ::kill(::getpid(), -fault);
        return 0;
    }
    return 0;
}

}  // namespace risorius::fault

/// A copy gives no memory back: that would cost more than all else that it does at its end, as each page would be copied first.
extern "C" void __libc_free(void* memory);
extern "C" void free(void* memory) {
    if (!risorius::fault::is_copy()) __libc_free(memory);
}

/// Codecs work with one thread where processes are copied: a copy would wait for the others.
extern "C" int avcodec_open2(AVCodecContext* context, const AVCodec* codec,
                             AVDictionary** options) {
    static const auto next =
        reinterpret_cast<decltype(&avcodec_open2)>(::dlsym(RTLD_NEXT, "avcodec_open2"));
    if (std::getenv("FAULT_ONE_THREAD")) context->thread_count = 1;
    return next(context, codec, options);
}
