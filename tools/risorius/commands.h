// SPDX-License-Identifier: MIT
/// \file
/// The commands of the program. Each adds its options to the command line, and runs if it is the requested one.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <exception>
#include <string>

#include "tools/risorius/terminal.h"

namespace risorius::cli {

void add_render(CLI::App& app);
void add_speak(CLI::App& app);
void add_align(CLI::App& app);
void add_compare(CLI::App& app);
void add_sheet(CLI::App& app);
void add_fit(CLI::App& app);
void add_landmarks(CLI::App& app);
void add_head(CLI::App& app);
void add_check(CLI::App& app);
void add_info(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_bench(CLI::App& app);
void add_figure(CLI::App& app);
void add_shapes(CLI::App& app);
void add_solve(CLI::App& app);
void add_import(CLI::App& app);
void add_export(CLI::App& app);
void add_batch(CLI::App& app);
void add_reverse(CLI::App& app);
void add_studio(CLI::App& app);
void add_study(CLI::App& app);

/// Begin and end in seconds from the value of an option, as "0-0.5". Throws Error.
std::array<double, 2> read_span(const std::string& option, const std::string& text);

/// Thrown for wrong input after the message has been printed.
class SaidAlready : public std::exception {};

}  // namespace risorius::cli
