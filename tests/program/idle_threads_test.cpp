// SPDX-License-Identifier: MIT
#include "tools/risorius/idle_threads.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace risorius::cli {
namespace {

/// A thread that sleeps for ever, and blocks signals as Mesa's do. Returns its number in the system.
int start_thread(int nice) {
    static std::atomic<int> number;
    number = 0;
    std::thread([nice] {
        ::sigset_t all_but_one;
        ::sigfillset(&all_but_one);
        ::sigdelset(&all_but_one, SIGSYS);
        ::pthread_sigmask(SIG_BLOCK, &all_but_one, nullptr);
        const int own = static_cast<int>(::syscall(SYS_gettid));
        if (nice != 0) ::setpriority(PRIO_PROCESS, static_cast<id_t>(own), nice);
        number = own;
        for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    }).detach();
    while (number == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return number;
}

bool exists(int thread) {
    return ::access(("/proc/self/task/" + std::to_string(thread)).c_str(), F_OK) == 0;
}

/// Exit code 0: threads of a lower priority have ended, and the others have not.
[[noreturn]] void end_some_of_four() {
    const int usual = start_thread(0), low = start_thread(19), lower = start_thread(7);
    end_idle_threads();
    ::_exit((exists(usual) ? 0 : 1) + (exists(low) ? 2 : 0) + (exists(lower) ? 4 : 0));
}

TEST(IdleThreads, EndAndOthersStay) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_EXIT(end_some_of_four(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace risorius::cli
