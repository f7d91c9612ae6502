// SPDX-License-Identifier: MIT
#include "risorius/report/atomic_folder.h"

#include <gtest/gtest.h>

#include "risorius/core/error.h"
#include "temporary_folder.h"

namespace risorius::report {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

void stage(const fs::path& folder, const std::string& name) {
    AtomicFolder staged(folder);
    write(staged.partial() / name, name);
    write(staged.partial() / "results.json", "{\"files\": [\"" + name + "\", \"results.json\"]}");
    staged.commit();
}

std::string refusal(const fs::path& folder) {
    try {
        const AtomicFolder staged(folder);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

constexpr const char* kExpected =
    ": expected a new folder, an empty one, or one with nothing but results of an earlier run, "
    "found ";

TEST(AtomicFolder, AppearsWhole) {
    const TemporaryFolder folder;
    {
        AtomicFolder staged(folder / "a/b/out/");
        write(staged.partial() / "x", "x");
        EXPECT_FALSE(fs::exists(folder / "a/b/out"));
        staged.commit();
    }
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"a", "a/b", "a/b/out", "a/b/out/x"}));
}

TEST(AtomicFolder, LeavesNothingWhenItIsGivenUp) {
    const TemporaryFolder folder;
    {
        const AtomicFolder staged(folder / "a/b/out");
        write(staged.partial() / "x", "x");
    }
    EXPECT_EQ(folder.listing(), std::set<std::string>{});
}

TEST(AtomicFolder, ReplacesFormerResults) {
    const TemporaryFolder folder;
    stage(folder / "out", "first");
    stage(folder / "out", "second");
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"out", "out/second", "out/results.json"}));
    fs::create_directory(folder / "empty");
    stage(folder / "empty", "third");
    EXPECT_TRUE(fs::exists(folder / "empty/third"));
}

TEST(AtomicFolder, KeepsFormerResultsWhenItIsGivenUp) {
    const TemporaryFolder folder;
    stage(folder / "out", "first");
    { const AtomicFolder staged(folder / "out"); }
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"out", "out/first", "out/results.json"}));
}

TEST(AtomicFolder, NeverTouchesSomebodysOwnFiles) {
    const TemporaryFolder folder;
    stage(folder / "out", "first");
    write(folder / "out/notes.txt", "mine");
    EXPECT_EQ(refusal(folder / "out"),
              (folder / "out").string() + kExpected + "\"notes.txt\" in it");
    fs::create_directory(folder / "other");
    write(folder / "other/results.json", "{\"mine\": 1}");
    EXPECT_EQ(refusal(folder / "other"),
              (folder / "other").string() + kExpected + "\"results.json\" in it");
    write(folder / "file", "");
    EXPECT_EQ(refusal(folder / "file"), (folder / "file").string() + kExpected + "a file");
    EXPECT_EQ(bytes_of(folder / "out/notes.txt"), "mine");
}

TEST(AtomicFolder, AFileThatCameMeanwhileIsKeptToo) {
    const TemporaryFolder folder;
    AtomicFolder staged(folder / "out");
    fs::create_directory(folder / "out");
    write(folder / "out/new.txt", "mine");
    EXPECT_THROW(staged.commit(), Error);
    EXPECT_EQ(bytes_of(folder / "out/new.txt"), "mine");
}

TEST(AtomicFolder, APlaceThatCannotBeIsNamed) {
    const TemporaryFolder folder;
    write(folder / "file", "");
    EXPECT_EQ(refusal(folder / "file/out"),
              (folder / "file").string() + ": expected a folder, found a file");
}

TEST(AtomicFolder, TwoStagedAtOnceForDifferentPlacesDoNotMeet) {
    const TemporaryFolder folder;
    AtomicFolder a(folder / "a"), b(folder / "b");
    write(a.partial() / "x", "a");
    write(b.partial() / "x", "b");
    a.commit();
    b.commit();
    EXPECT_EQ(bytes_of(folder / "a/x") + bytes_of(folder / "b/x"), "ab");
}

}  // namespace
}  // namespace risorius::report
