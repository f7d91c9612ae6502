// SPDX-License-Identifier: MIT
// Files are opened, and JSON is read and written, in one place each. Only so do their guarantees hold for every reader: limits,
// read errors, depth, and text that can be printed.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "structure/source_tree.h"

namespace risorius::structure {
namespace {

/// Files that may match a pattern, and the reason.
using Allowed = std::map<std::string, std::string>;

/// Expects that no line of src and tools matches, except in files whose path begins with one that is allowed.
void expect_none(const std::string& pattern, const Allowed& allowed, const std::string& instead) {
    const std::regex wrong(pattern);
    int files = 0;
    for (const char* folder : {"src", "tools"})
        for (const auto& file : files_below(folder, {".h", ".cpp"})) {
            ++files;
            const std::string name = shown(file);
            const bool may = std::any_of(allowed.begin(), allowed.end(), [&](const auto& one) {
                return name.starts_with(one.first);
            });
            int number = 0;
            for (const std::string& line : lines_of(text_of(file))) {
                ++number;
                EXPECT_TRUE(may || !std::regex_search(line, wrong))
                    << name << ":" << number << ": " << line << "\n  " << instead;
            }
        }
    EXPECT_GT(files, 200);
}

TEST(Reading, OnlyCoreOpensFilesToRead) {
    expect_none(
        R"(ifstream|filebuf|\bfopen\b|rdbuf|O_RDONLY|O_RDWR)",
        {{"src/risorius/core/file_reader.cpp", "opens every file"},
         {"src/risorius/core/detail/", "opens what this program has written itself"},
         {"src/risorius/io/detail/import_process.cpp", "gives /dev/null to a program"},
         {"tools/import_mesh/", "reads under limits of the operating system"},
         {"tools/voices/", "programs that do not use the library, under other licences"},
         {"src/risorius/plot/detail/run_gnuplot.cpp", "gives /dev/null to a program"}},
        "read_file(), read_text() or FileReader of core has the limits and sees read errors");
}

TEST(Reading, OnlyCoreParsesJson) {
    expect_none(R"(\b[Jj]son::(parse|from_\w+|accept)\()",
                {{"src/risorius/core/json_cursor.cpp", "parses all JSON"},
                 {"tools/voices/", "programs that do not use the library"},
                 {"tools/bench/", "scripts that the program makes itself"}},
                "parse_json_text() or json_or_null() of core limits the depth");
}

TEST(Reading, OnlyCoreWritesJsonAsText) {
    expect_none(R"(\.dump\()", {{"src/risorius/core/json_cursor.cpp", "json_text()"}},
                "json_text() of core takes names of files that are not UTF-8");
}

}  // namespace
}  // namespace risorius::structure
