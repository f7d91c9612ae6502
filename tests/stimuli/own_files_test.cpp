// SPDX-License-Identifier: MIT
// What batch takes for its own, and so may remove.
#include "risorius/stimuli/detail/own_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/core/output_set.h"
#include "risorius/core/sha256.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
namespace {

namespace fs = std::filesystem;
using Files = std::set<fs::path>;

/// A set with one clip "a", as batch writes it.
void write_set(const TemporaryFolder& folder) {
    nlohmann::ordered_json record{{"format", "risorius-clip"}, {"stim_id", "a"}};
    for (const char* file : {"code/scripts/a.json", "overview/a.png", "stimuli/stim-a_video.mp4"}) {
        write_file(folder / file, file);
        record["files"][file] = sha256_of_file(folder / file);
    }
    write_file(folder / "stimuli/stim-a_video.json", record.dump());
    write_file(folder / "triggers.tsv", "triggers");
    write_file(folder / "SHA256SUMS", sha256_of_file(folder / "triggers.tsv") + "  triggers.tsv\n");
}

void add_sum(const TemporaryFolder& folder, const std::string& file) {
    std::ofstream(folder / "SHA256SUMS", std::ios::app)
        << sha256_of_file(folder / file) << "  " << file << "\n";
}

const Files kSet{"code/scripts/a.json", "overview/a.png", "stimuli/stim-a_video.json",
                 "stimuli/stim-a_video.mp4", "triggers.tsv"};

TEST(OwnFiles, AreThoseOfClipsAndOfTheSet) {
    const TemporaryFolder folder;
    write_set(folder);
    EXPECT_EQ(own_files(folder.path()), kSet);
    check_own_folder(folder.path(), "any");
}

// A clip of a large set has its files in a folder of its own; those of another folder are not its.
TEST(OwnFiles, AreThoseInFoldersOfClipsToo) {
    const TemporaryFolder folder;
    write_set(folder);
    nlohmann::ordered_json record{{"format", "risorius-clip"}, {"stim_id", "e"}};
    for (const char* file : {"code/scripts/b012/e.json", "overview/b012/e.png",
                             "stimuli/b012/stim-e_video.mp4", "overview/b013/e.png"}) {
        write_file(folder / file, file);
        record["files"][file] = sha256_of_file(folder / file);
    }
    write_file(folder / "stimuli/b012/stim-e_video.json", record.dump());
    write_file(folder / "stimuli/mine/stim-e_video.json", record.dump());
    for (const char* page : {"overview/b012/index.html", "overview/mine/index.html"}) {
        write_file(folder / page, "page");
        add_sum(folder, page);
    }
    Files expected = kSet;
    expected.merge(Files{"code/scripts/b012/e.json", "overview/b012/e.png",
                         "stimuli/b012/stim-e_video.mp4", "stimuli/b012/stim-e_video.json",
                         "overview/b012/index.html"});
    EXPECT_EQ(own_files(folder.path()), expected);
}

TEST(OwnFiles, AreNotThoseThatTheUserListsOrNamesAlike) {
    const TemporaryFolder folder;
    write_set(folder);
    for (const char* file : {"notes.txt", "stimuli/stim-mine_video.mp4", "takes/a.mkv",
                             "takes/thesis.txt", "overview/b.png", "code/analysis.R"}) {
        write_file(folder / file, "mine");
        add_sum(folder, file);
    }
    // A sidecar that was copied, and one that names more than a clip has
    fs::copy_file(folder / "stimuli/stim-a_video.json", folder / "stimuli/stim-c_video.json");
    nlohmann::ordered_json record{{"format", "risorius-clip"}, {"stim_id", "d"}};
    for (const char* file : {"notes.txt", "../outside", "stimuli/stim-d_/../../notes.txt"})
        record["files"][file] = sha256_of_file(folder / "notes.txt");
    write_file(folder / "stimuli/stim-d_video.json", record.dump());
    Files expected = kSet;
    expected.insert("stimuli/stim-d_video.json");
    EXPECT_EQ(own_files(folder.path()), expected);
}

TEST(OwnFiles, AreNotThoseThatWereChanged) {
    const TemporaryFolder folder;
    write_set(folder);
    write_file(folder / "overview/a.png", "retouched");
    write_file(folder / "triggers.tsv", "my own codes");
    Files expected = kSet;
    expected.erase("overview/a.png");
    expected.erase("triggers.tsv");
    EXPECT_EQ(own_files(folder.path()), expected);
}

TEST(OwnFiles, AreNotFoundThroughLinks) {
    const TemporaryFolder folder;
    write_set(folder);
    for (const char* below : {"stimuli", "overview"}) {
        fs::rename(folder / below, folder / (std::string("elsewhere ") + below));
        fs::create_directory_symlink(folder / (std::string("elsewhere ") + below), folder / below);
    }
    EXPECT_EQ(own_files(folder.path()), Files{"triggers.tsv"});
}

TEST(OwnFiles, ThatSidecarsNameAreNotFoundThroughLinks) {
    for (const fs::path below : {"overview", "code", "code/scripts"}) {
        const TemporaryFolder folder;
        write_set(folder);
        fs::rename(folder.path() / below, folder / "elsewhere");
        fs::create_directory_symlink(folder / "elsewhere", folder.path() / below);
        const Files own = own_files(folder.path());
        EXPECT_EQ(own.count("overview/a.png"), below == "overview" ? 0U : 1U);
        EXPECT_EQ(own.count("code/scripts/a.json"), below == "overview" ? 1U : 0U);
    }
}

TEST(OwnFiles, FoldersOfOthersAreRefused) {
    const TemporaryFolder folder;
    check_own_folder(folder / "new", "any");
    fs::create_directories(folder / "x/stimuli");
    check_own_folder(folder / "x", "any");
    write_file(folder / "x/code/analysis.R", "mine");
    write_file(folder / "x/dataset_description.json", R"({"Name": "a data set of mine"})");
    EXPECT_NE(message_of([&] { check_own_folder(folder / "x", ""); })
                  .find("expected an empty folder, or one that `batch` has begun, found a folder "
                        "with other files"),
              std::string::npos);
}

// The clips of one design would be removed by the other, also when only some of them are there.
TEST(OwnFiles, FoldersOfOtherDesignsAreRefused) {
    const TemporaryFolder folder;
    const auto message = [&](const char* name) {
        return message_of([&] { check_own_folder(folder.path(), name); });
    };
    write_file(folder / "stimuli/stim-a_video.json",
               R"({"format": "risorius-clip", "stim_id": "a", "design": "First"})");
    const std::string expected = folder.path().string() +
                                 ": expected a set of the design \"Second\", unless replace is "
                                 "given, found one of \"First\"";
    EXPECT_EQ(message("First"), "no error");
    EXPECT_EQ(message(""), "no error");
    EXPECT_EQ(message("Second"), expected);
    write_file(folder / "dataset_description.json",
               R"({"Name": "Second", "GeneratedBy": [{"Name": "Risorius"}]})");
    EXPECT_EQ(message("Second"), "no error");
    EXPECT_EQ(message("Third"), folder.path().string() +
                                    ": expected a set of the design \"Third\", unless replace "
                                    "is given, found one of \"Second\"");
    fs::remove(folder / "dataset_description.json");
    fs::remove(folder / "stimuli/stim-a_video.json");
    write_file(folder / "intermediate/a.json", R"({"film_sha256": "1", "design": "First"})");
    EXPECT_EQ(message("Second"), expected);
}

}  // namespace
}  // namespace risorius::stimuli
