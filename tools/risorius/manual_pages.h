// SPDX-License-Identifier: MIT
/// \file
/// Documentation of the command line from the same description as --help: a page of the manual, man pages, and completions for
/// shells.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace risorius::cli {

/// docs/cli.md: each command with its options and examples, as Markdown.
std::string markdown_pages(const CLI::App& app);

/// The man page of a command in troff, or of the whole program when `command` is null.
std::string man_page(const CLI::App& app, const CLI::App* command);

/// Completion scripts for commands, options and their values.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string fish_completion(const CLI::App& app);

/// Writes cli.md, man1/*.1, bash/risorius, zsh/_risorius and fish/risorius.fish below a folder, and returns their paths.
std::vector<std::filesystem::path> write_manual_pages(const CLI::App& app,
                                                      const std::filesystem::path& folder);

}  // namespace risorius::cli
