// SPDX-License-Identifier: MIT
// Every seed and every input that has once done harm goes through its reader again. So does each seed that is cut short, or has
// a byte changed.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "fuzz/targets.h"
#include "paths.h"

namespace risorius::fuzz {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void run_on(const Target& target, const std::string& bytes) {
    run(target, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// The seeds of a target, in the order of their names, and the hostile files with its endings.
std::set<fs::path> inputs_of(const Target& target) {
    const fs::path tests = fs::path(RISORIUS_SOURCE_DIR) / "tests";
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(tests / "fuzz/seeds" / target.name))
        files.insert(entry.path());
    for (const char* folder : {"inputs/hostile", "inputs/public_cases"})
        for (const auto& entry : fs::directory_iterator(tests / folder)) {
            const std::string ending = entry.path().extension().string();
            if (ending == "." + target.name || (ending == ".glb" && target.name == "shapes"))
                files.insert(entry.path());
        }
    return files;
}

TEST(FuzzReplay, ReadersAcceptOrRefuseEverySeed) {
    for (const Target& target : targets()) {
        const std::set<fs::path> files = inputs_of(target);
        EXPECT_FALSE(files.empty()) << target.name;
        for (const fs::path& file : files) {
            SCOPED_TRACE(file.string());
            EXPECT_NO_THROW(run_on(target, bytes_of(file)));
        }
    }
}

TEST(FuzzReplay, ReadersAcceptOrRefuseDamagedSeeds) {
    for (const Target& target : targets())
        for (const fs::path& file : inputs_of(target)) {
            SCOPED_TRACE(file.string());
            const std::string bytes = bytes_of(file);
            const std::size_t step = bytes.size() / 40 + 1;
            for (std::size_t at = 0; at < bytes.size(); at += step) {
                EXPECT_NO_THROW(run_on(target, bytes.substr(0, at))) << "cut at " << at;
                for (const char put : {'\0', '\x7f', '\xff', '"', '-'}) {
                    std::string changed = bytes;
                    changed[at] = put;
                    EXPECT_NO_THROW(run_on(target, changed)) << "byte " << at;
                }
            }
        }
}

}  // namespace
}  // namespace risorius::fuzz
