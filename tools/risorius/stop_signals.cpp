// SPDX-License-Identifier: MIT
#include "tools/risorius/stop_signals.h"

#include <semaphore.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <mutex>
#include <system_error>
#include <thread>

#include "risorius/core/output_set.h"
#include "tools/risorius/failure.h"

namespace risorius::cli {

namespace {

constexpr int kInterrupted = 130;
constexpr long kPatience_ns = 100'000'000;
constexpr auto kBetweenTries = std::chrono::milliseconds(10);

std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free);
::sem_t signals;  // counts them; never destroyed

/// Held by who ends the program: main or the thread below.
std::mutex& ending() {
    static std::mutex& one = *new std::mutex;
    return one;
}

// Only what a signal handler may do
void note_stop(int) {
    const int before = errno;
    stop_asked = true;
    ::sem_post(&signals);
    errno = before;
}

void wait_for_signal() {
    while (::sem_wait(&signals) != 0) {
    }
}

/// Returns after the time, or when another signal comes.
void wait_for_patience() {
    ::timespec until{};
    ::clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += kPatience_ns;
    until.tv_sec += until.tv_nsec / 1'000'000'000;
    until.tv_nsec %= 1'000'000'000;
    while (::sem_timedwait(&signals, &until) != 0 && errno == EINTR) {
    }
}

void write_text(int file, const std::string& text) {
    // Where it cannot be written, nothing is left to be done.
    [[maybe_unused]] const ::ssize_t written = ::write(file, text.data(), text.size());
}

/// Ends the program when the run does not.
void watch(bool json) {
    wait_for_signal();
    wait_for_patience();
    for (;; std::this_thread::sleep_for(kBetweenTries)) {
        const std::lock_guard lock(ending());
        if (!abandon_outputs()) continue;  // decided, or about to be
        if (json) write_text(STDOUT_FILENO, failure_line(kInterrupted, stop_message()));
        write_text(STDERR_FILENO, "risorius: " + stop_message() + "\n");
        ::_exit(kInterrupted);
    }
}

constexpr std::array kStops{SIGHUP, SIGINT, SIGTERM};

}  // namespace

// Only what may be called before the libraries are initialised
void note_stops() {
    ::sem_init(&signals, 0, 0);
    for (const int signal : kStops) {
        struct ::sigaction now {};
        ::sigaction(signal, nullptr, &now);
        if (now.sa_handler == SIG_IGN) continue;
        struct ::sigaction then {};
        then.sa_handler = note_stop;
        // Files are read and written as without signals; the thread above ends what waits for long.
        then.sa_flags = SA_RESTART;
        ::sigemptyset(&then.sa_mask);
        ::sigaction(signal, &then, nullptr);
    }
}

void catch_stop_signals(bool json) {
    ending();
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
    try {
        std::thread(watch, json).detach();
    } catch (const std::system_error&) {
        // No thread to be had: signals end the program, and the next run removes what it left.
        for (const int signal : kStops) {
            struct ::sigaction now {};
            ::sigaction(signal, nullptr, &now);
            if (now.sa_handler == note_stop) std::signal(signal, SIG_DFL);
        }
    }
}

bool stop_is_asked() { return stop_asked && !outputs_are_decided(); }

std::string stop_message() {
    return any_output_committed() ? "interrupted, what was complete before is kept"
                                  : "interrupted, nothing was written";
}

void end_of_run() {
    static std::once_flag ended;
    std::call_once(ended, [] { ending().lock(); });
}

}  // namespace risorius::cli
