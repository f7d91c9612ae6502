// SPDX-License-Identifier: MIT
/// \file
/// What tests need to play the page of an experiment: jsPsych, a browser and Python.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "risorius/report/run_program.h"

namespace risorius::scenario {

/// Where tools/setup.sh has put jsPsych, or nothing.
inline std::filesystem::path jspsych() {
    namespace fs = std::filesystem;
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const fs::path folder = cache ? fs::path(cache) : home ? fs::path(home) / ".cache" : fs::path();
    const fs::path modules = folder / "risorius/jspsych/node_modules";
    return fs::exists(modules / "jspsych/package.json") ? modules : fs::path();
}

/// Makes jsPsych known as "node_modules" in a folder; returns what is missing to play a page below it.
inline std::string missing_for_pages(const std::filesystem::path& folder) {
    const std::filesystem::path modules = jspsych();
    if (modules.empty()) return "no jsPsych here (tools/setup.sh test fetches it by npm)";
    for (const char* program : {"chromium", "python3"})
        if (report::run_program({program, "--version"}).exit_code != 0)
            return "no " + std::string(program) + " here";
    if (!std::filesystem::exists(folder / "node_modules"))
        std::filesystem::create_directory_symlink(modules, folder / "node_modules");
    return {};
}

}  // namespace risorius::scenario
