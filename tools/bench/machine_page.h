// SPDX-License-Identifier: MIT
/// \file
/// One page about a machine: what it does beside known machines, and what to change where it is slower than real time.
///
/// Known machines are the files docs/performance/benchmarks/*.csv; their rows of the benchmark "page" are compared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::bench {

/// One number of the page.
struct PageRow {
    std::string label;  ///< for a person
    /// The columns of a benchmark file
    std::string head, what, quantity, unit;
    int cores = 1;
    double value = 0;
};

/// Returns the numbers that a complete report of bench_machine() has; those of the first rig.
std::vector<PageRow> page_rows(const Json& report);

/// A machine that was measured earlier.
struct KnownMachine {
    std::string name;  ///< of its file
    std::vector<PageRow> rows;
};

/// Reads all files of a folder, in the order of their names; none when there is no such folder. Throws Error for a file that is no
/// benchmark file.
std::vector<KnownMachine> read_known_machines(const std::filesystem::path& folder);

/// The page as text.
std::string machine_page(const Json& report, const std::vector<KnownMachine>& known);

/// The numbers of the page as a benchmark file, which others can compare with. `month`: "2026-11".
std::string benchmark_file(const Json& report, const std::string& month);

}  // namespace risorius::bench
