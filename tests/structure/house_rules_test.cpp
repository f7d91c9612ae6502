// SPDX-License-Identifier: MIT
// What the house style asks of every file, where a machine can tell.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <regex>

#include "shell.h"
#include "structure/source_tree.h"

namespace risorius::structure {
namespace {

using Names = std::set<std::string>;

const Names kSources = {".h", ".cpp"};
const Names kText = {".h",     ".cpp",  ".txt", ".sh",   ".json", ".md",
                     ".cmake", ".glsl", ".js",  ".html", ".tsv",  ".csv"};

constexpr const char* kEspeakFolder = "tools/voices/espeak";

/// Runs a command and catches standard error too.
ShellResult run(const std::string& command) { return run_shell(command + " 2>&1"); }

TEST(HouseRules, TopLevelHoldsOnlyWhatTheReadmeNames) {
    const Names allowed = {"CMakeLists.txt",
                           "CMakePresets.json",
                           "src",
                           "rigs",
                           "models",
                           "tools",
                           "tests",
                           "samples",
                           "docs",
                           "README.md",
                           "CONTRIBUTING.md",
                           "CHANGELOG.md",
                           "CITATION.cff",
                           "LICENSE",
                           "out"};
    const Names required = {"CMakeLists.txt", "CMakePresets.json", "src", "tools", "tests",
                            "LICENSE"};
    Names found;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir())) {
        const std::string name = entry.path().filename().string();
        found.insert(name);
        if (name.starts_with(".") || name.starts_with("build"))
            continue;  // settings; ignored by git
        EXPECT_TRUE(allowed.contains(name)) << name << " has no place at the top level";
    }
    for (const std::string& name : required)
        EXPECT_TRUE(found.contains(name)) << name << " is missing";
}

TEST(HouseRules, NoFileNamesAMachine) {
    // Split so that this file does not find itself.
    const std::regex machine_path(
        "(^|[^A-Za-z0-9_.])/(wo"
        "rk|ro"
        "ot|ho"
        "me|tm"
        "p|Us"
        "ers)/");
    int files = 0;
    for (const char* folder : {"src", "tools", "tests", "rigs", "samples", "docs", ".ci"})
        for (const auto& file : files_below(folder, kText)) {
            if (std::filesystem::file_size(file) > 2'000'000) continue;  // data, not prose
            ++files;
            int number = 0;
            for (const std::string& line : lines_of(text_of(file))) {
                ++number;
                EXPECT_FALSE(std::regex_search(line, machine_path))
                    << shown(file) << ":" << number << ": " << line;
            }
        }
    EXPECT_GT(files, 20);
}

TEST(HouseRules, EverySourceNamesItsLicenceAndSaysWhatItIsFor) {
    const std::string licence = "// SPDX-License-Identifier: MIT\n";
    const auto files = files_below("src", kSources);
    ASSERT_FALSE(files.empty());
    for (const auto& file : files) {
        std::string text = text_of(file);
        ASSERT_TRUE(text.starts_with(licence)) << shown(file) << " does not name its licence";
        text = text.substr(licence.size());
        if (file.extension() == ".h") {
            EXPECT_TRUE(text.starts_with("/// \\file\n/// "))
                << shown(file) << " does not say in its first lines what it is for";
            EXPECT_NE(text.find("#pragma once"), std::string::npos) << shown(file);
            continue;
        }
        // A source may leave the telling to the header it starts with.
        const std::string own =
            "#include \"" +
            file.lexically_relative(source_dir() / "src").replace_extension(".h").string() + "\"";
        EXPECT_TRUE(text.starts_with("// ") || text.starts_with(own))
            << shown(file)
            << " starts neither with a comment that says what it is for nor with its own header";
    }
    for (const char* folder : {"tools", "tests", "samples"})
        for (const auto& file : files_below(folder, kSources))
            EXPECT_TRUE(
                text_of(file).starts_with(shown(file).starts_with(kEspeakFolder)
                                              ? "// SPDX-License-Identifier: GPL-3.0-or-later\n"
                                              : licence))
                << shown(file) << " does not name its licence";
}

// What links libespeak-ng is under the GPL: one program, in a folder of its own with the text of the licence.
TEST(HouseRules, OnlyTheVoiceByEspeakUsesEspeak) {
    const std::regex uses(R"(#\s*include\s*[<"]espeak|PkgConfig::ESPEAK|\bespeak_[A-Z])");
    int files = 0;
    for (const char* folder : {"src", "tools", "tests", "samples"})
        for (const auto& file : files_below(folder, {".h", ".cpp", ".txt", ".cmake"})) {
            if (shown(file) == "tests/structure/house_rules_test.cpp") continue;
            const bool found = std::regex_search(text_of(file), uses);
            EXPECT_TRUE(!found || shown(file).starts_with(kEspeakFolder))
                << shown(file) << " uses espeak-ng, which only " << kEspeakFolder << " may";
            files += found;
        }
    EXPECT_EQ(files, 2);  // its source and its CMakeLists.txt
    EXPECT_NE(text_of(source_dir() / kEspeakFolder / "LICENSE").find("GNU GENERAL PUBLIC LICENSE"),
              std::string::npos);
    const std::string link = text_of(source_dir() / "src/CMakeLists.txt");
    EXPECT_EQ(link.find("espeak"), std::string::npos);
}

TEST(HouseRules, EveryTestFileExpectsSomething) {
    int files = 0;
    for (const auto& file : files_below("tests", {".cpp"})) {
        if (!file.filename().string().ends_with("_test.cpp")) continue;
        ++files;
        EXPECT_TRUE(std::regex_search(text_of(file), std::regex("(EXPECT|ASSERT)_[A-Z]+")))
            << shown(file);
    }
    EXPECT_GT(files, 3);
}

TEST(HouseRules, NoMarksOfUnfinishedWorkAreLeft) {
    const std::regex mark(
        "\\b(TO"
        "DO|FIX"
        "ME|XX"
        "X)\\b");
    int files = 0;
    for (const char* folder : {"src", "tools", "tests"})
        for (const auto& file : files_below(folder, kText)) {
            ++files;
            EXPECT_FALSE(std::regex_search(text_of(file), mark)) << shown(file);
        }
    EXPECT_GT(files, 20);
}

TEST(HouseRules, NoFileIsNamedForNothing) {
    for (const auto& file : files_below("src", kSources)) {
        const std::string name = file.stem().string();
        for (const char* vague :
             {"utils", "util", "helpers", "helper", "common", "misc", "manager"})
            EXPECT_NE(name, vague) << shown(file);
    }
    EXPECT_TRUE(std::filesystem::exists(source_dir() / "src/risorius/core"));
}

// Libraries name fields; the program translates between them and the flags of its command line.
TEST(HouseRules, LibrariesNameNoCommandLineFlags) {
    const std::regex flag("\"--[a-z]");
    int files = 0;
    for (const auto& file : files_below("src", kSources)) {
        ++files;
        int number = 0;
        for (const std::string& line : lines_of(text_of(file))) {
            ++number;
            EXPECT_FALSE(std::regex_search(line, flag))
                << shown(file) << ":" << number << ": " << line;
        }
    }
    EXPECT_GT(files, 100);
}

TEST(HouseRules, NoSourcePathIsCompiledIn) {
    for (const char* list : {"CMakeLists.txt", "src/CMakeLists.txt", "tools/CMakeLists.txt"})
        for (const std::string& line : lines_of(text_of(source_dir() / list)))
            EXPECT_FALSE(line.find("DEFINITIONS") != std::string::npos &&
                         line.find("_DIR}") != std::string::npos)
                << list << ": " << line;
}

TEST(HouseRules, NoFunctionIsLongerThanAHundredLines) {
    const auto [status, version] = run("ctags --version");
    if (status != 0 || version.find("Universal Ctags") == std::string::npos)
        GTEST_SKIP() << "Universal Ctags is not installed";
    constexpr int kMaxLines = 100;
    const auto [listed, tags] = run("cd '" + source_dir().string() +
                                    "' && ctags -R -f - --languages=C++ --kinds-C++=f --fields=+ne "
                                    "--output-format=json src tools");
    ASSERT_EQ(listed, 0) << tags.substr(0, 1000);
    int functions = 0;
    for (const std::string& line : lines_of(tags)) {
        const auto tag = nlohmann::json::parse(line, nullptr, false);
        if (!tag.is_object() || !tag.contains("end")) continue;
        ++functions;
        const int first = tag["line"], length = tag["end"].get<int>() - first + 1;
        EXPECT_LE(length, kMaxLines)
            << tag["path"].get<std::string>() << ":" << first << ": "
            << tag["name"].get<std::string>() << " has " << length << " lines";
    }
    EXPECT_GT(functions, 1000);
}

// core/output_set.h says why.
TEST(HouseRules, OnlyCoreWritesFiles) {
    const std::regex writes("std::ofstream|\\brename\\(|O_CREAT");
    for (const char* folder : {"src/risorius", "tools/risorius"})
        for (const auto& file : files_below(folder, kSources)) {
            if (shown(file).starts_with("src/risorius/core/")) continue;
            for (const std::string& line : lines_of(text_of(file)))
                EXPECT_FALSE(std::regex_search(line, writes)) << shown(file) << ": " << line;
        }
}

TEST(HouseRules, SourcesAreLaidOutByClangFormat) {
    // Versions differ in details; the layout is that of Debian 12's.
    const auto [status, version] = run("clang-format --version");
    if (status != 0) GTEST_SKIP() << "clang-format is not installed";
    if (version.find("version 14.") == std::string::npos)
        GTEST_SKIP() << "not clang-format 14 but " << version;
    std::string command = "cd '" + source_dir().string() + "' && clang-format --dry-run -Werror";
    for (const char* folder : {"src", "tools", "tests"})
        for (const auto& file : files_below(folder, kSources)) command += " '" + shown(file) + "'";
    const auto [formatted, complaints] = run(command);
    EXPECT_EQ(formatted, 0) << complaints.substr(0, 4000)
                            << "\nTo lay them out: clang-format -i the files named above";
}

}  // namespace
}  // namespace risorius::structure
