// SPDX-License-Identifier: MIT
#include "tools/risorius/idle_threads.h"

#include <dirent.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace risorius::cli {

namespace {

// Mesa's threads block all signals but this one.
constexpr int kSignal = SIGSYS;
constexpr int kTries = 100;
constexpr ::timespec kBetweenTries{0, 2'000'000};
constexpr std::size_t kMost = 64;

/// Ends the thread alone. Only the system is told, since nothing of the process is used any more.
void end_this_thread(int) { ::syscall(SYS_exit, 0); }

bool is_idle(int thread, int nice_of_caller) {
    const int policy = ::sched_getscheduler(thread);
    if (policy == SCHED_IDLE || policy == SCHED_BATCH) return true;
    errno = 0;
    const int nice = ::getpriority(PRIO_PROCESS, static_cast<id_t>(thread));
    return errno == 0 && nice > nice_of_caller;
}

bool exists(int thread) {
    std::array<char, 64> path{};
    std::snprintf(path.data(), path.size(), "/proc/self/task/%d", thread);
    return ::access(path.data(), F_OK) == 0;
}

}  // namespace

void end_idle_threads() {
    DIR* const tasks = ::opendir("/proc/self/task");
    if (!tasks) return;
    const int own = static_cast<int>(::syscall(SYS_gettid)),
              nice = ::getpriority(PRIO_PROCESS, static_cast<id_t>(own));
    std::array<int, kMost> idle{};
    std::size_t count = 0;
    while (const ::dirent* entry = ::readdir(tasks)) {
        const int thread = std::atoi(entry->d_name);
        if (thread > 0 && thread != own && count < kMost && is_idle(thread, nice))
            idle[count++] = thread;
    }
    ::closedir(tasks);
    struct ::sigaction ends {};
    ends.sa_handler = end_this_thread;
    ::sigemptyset(&ends.sa_mask);
    if (count == 0 || ::sigaction(kSignal, &ends, nullptr) != 0) return;
    for (std::size_t i = 0; i < count; ++i) ::syscall(SYS_tgkill, ::getpid(), idle[i], kSignal);
    for (std::size_t i = 0, tries = 0; i < count && tries < kTries; ++tries)
        if (exists(idle[i]))
            ::nanosleep(&kBetweenTries, nullptr);
        else
            ++i;
}

}  // namespace risorius::cli
