// SPDX-License-Identifier: MIT
#include "tools/risorius/terminal.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/result_cache.h"
#include "tools/risorius/stop_signals.h"

namespace risorius::cli {

namespace {

constexpr double kQuiet_s = 2, kBarEvery_s = 0.1, kLineEvery_s = 30;

/// A program that starts this one may want lines of progress more often, and from the start.
std::optional<double> asked_line_every_s() {
    const char* asked = std::getenv("RISORIUS_PROGRESS_S");
    if (!asked || !*asked) return std::nullopt;
    const double seconds = std::atof(asked);
    if (seconds > 0) return seconds;
    return std::nullopt;
}

std::string minutes_text(double seconds) {
    const int whole = static_cast<int>(seconds + 0.5);
    char text[32];
    std::snprintf(text, sizeof text, "%d:%02d", whole / 60, whole % 60);
    return text;
}

}  // namespace

ProgressBar::ProgressBar(const Common& common)
    : wanted_(!common.quiet),
      on_terminal_(::isatty(STDERR_FILENO) == 1),
      quiet_s_(kQuiet_s),
      every_s_(on_terminal_ ? kBarEvery_s : kLineEvery_s) {
    if (const auto asked = asked_line_every_s(); asked && !on_terminal_)
        quiet_s_ = every_s_ = *asked;
}

ProgressBar::~ProgressBar() {
    if (shown_ && on_terminal_) std::fprintf(stderr, "\r\033[K");
}

ProgressMonitor ProgressBar::monitor() {
    return {.progress = [this](double fraction, const std::string& what) { show(fraction, what); },
            .stopped = stop_is_asked};
}

void ProgressBar::show(double fraction, const std::string& what) {
    if (!wanted_) return;
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    const auto since = [&](Clock::time_point then) {
        return std::chrono::duration<double>(now - then).count();
    };
    if (since(begin_) < quiet_s_ || since(last_) < every_s_) return;
    last_ = now;
    shown_ = true;
    constexpr int kWidth = 30;
    const int full = std::clamp(static_cast<int>(fraction * kWidth), 0, kWidth);
    const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                            std::string(static_cast<std::size_t>(kWidth - full), '.');
    const std::string left =
        fraction > 0.01 ? minutes_text(since(begin_) * (1 - fraction) / fraction) + " left" : "";
    const int percent = static_cast<int>(100 * fraction);
    if (on_terminal_)
        std::fprintf(stderr, "\r\033[K[%s] %3d %%  %s  %s", bar.c_str(), percent, left.c_str(),
                     what.c_str());
    else
        std::fprintf(stderr, "%3d %%  %s  %s\n", percent, left.c_str(), what.c_str());
    std::fflush(stderr);
}

void add_common(CLI::App& command, Common& common) {
    command.add_flag("--quiet", common.quiet, "Print errors only");
    command.add_flag("--json", common.json, "Print the report as JSON on standard output");
    command.add_flag_callback(
        "--no-cache", [] { use_result_cache(false); },
        "Compute everything again: do not use or store cached results (see RISORIUS_CACHE in the "
        "manual)");
}

void add_threads(CLI::App& command, int& threads, const std::string& what) {
    command
        .add_option("--threads", threads,
                    "Number of threads; 0: one for each core. " + what + " the same for any number")
        ->type_name("INT");
}

void check_threads(int threads) {
    if (threads < 0 || threads > 256)
        throw Error("--threads", "an integer in [0, 256]", std::to_string(threads));
}

}  // namespace risorius::cli
