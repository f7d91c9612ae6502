// SPDX-License-Identifier: MIT
#include "risorius/core/output_set.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <memory>
#include <thread>

#include "message_of.h"
#include "risorius/core/detail/private_folder.h"
#include "risorius/core/input_log.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/core/read_file.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
constexpr FileKind kText{"a text", kMegabyte};

ino_t inode_of(const fs::path& file) {
    struct ::stat status {};
    EXPECT_EQ(::lstat(file.c_str(), &status), 0) << file;
    return status.st_ino;
}

/// Runs `work` in a child process, which is then killed as by `kill -9`.
void in_killed_process(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
}

TEST(OutputSet, ShowsNothingBeforeTheCommitAndAllAfterIt) {
    const TemporaryFolder folder;
    {
        OutputSet set(folder / "new/deep");
        write_file(set.file(folder / "new/deep/a.txt"), "a");
        write_file(set.file(folder / "new/deep/below/b.txt"), "b");
        write_file(set.folder(folder / "new/deep/c") / "d/e.txt", "e");
        EXPECT_FALSE(fs::exists(folder / "new/deep/a.txt"));
        set.commit();
    }
    EXPECT_EQ(folder.listing(),
              (Names{"new", "new/deep", "new/deep/a.txt", "new/deep/below", "new/deep/below/b.txt",
                     "new/deep/c", "new/deep/c/d", "new/deep/c/d/e.txt"}));
    EXPECT_EQ(bytes_of(folder / "new/deep/c/d/e.txt"), "e");
}

TEST(OutputSet, LeavesNothingWithoutACommit) {
    const TemporaryFolder folder;
    {
        OutputSet set(folder / "new/deep");
        write_file(set.file(folder / "new/deep/a.txt"), "a");
        write_file(set.scratch_file("b"), "b");
    }
    EXPECT_EQ(folder.listing(), Names{});
}

TEST(OutputSet, ReplacesFilesAndFolders) {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    write_file(folder / "f/old", "old");
    {
        OutputSet set(folder.path());
        write_file(set.file(folder / "a"), "new");
        write_file(set.folder(folder / "f") / "new", "new");
        set.commit();
    }
    EXPECT_EQ(folder.listing(), (Names{"a", "f", "f/new"}));
    EXPECT_EQ(bytes_of(folder / "a"), "new");
}

TEST(OutputSet, RemovesAndGivesBack) {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    write_file(folder / "f/b", "old");
    {
        OutputSet set(folder.path());
        set.removal(folder / "f/b");
        set.removal(folder / "missing");
        const fs::path below = set.file(folder / "a/c");
        write_file(below, "new");
        EXPECT_THROW(set.commit(), RunError);  // because "a" is no folder
    }
    EXPECT_EQ(folder.listing(), (Names{"a", "f", "f/b"}));
    OutputSet set(folder.path());
    set.removal(folder / "f/b");
    write_file(set.file(folder / "new"), "new");
    set.commit();
    EXPECT_FALSE(fs::exists(folder / "f/b"));
    EXPECT_TRUE(fs::exists(folder / "new"));
}

TEST(OutputSet, WritesInAPrivateFolderWithAnUnpredictableName) {
    const TemporaryFolder folder;
    OutputSet one(folder.path()), two(folder.path());
    const fs::path a = one.file(folder / "a").parent_path().parent_path(),
                   b = two.file(folder / "b").parent_path().parent_path();
    EXPECT_NE(a, b);
    EXPECT_EQ(fs::status(a).permissions(), fs::perms::owner_all);
    // What lies under the name already is never written through.
    fs::create_symlink(folder / "victim", a / "new/c");
    write_file(a / "new/c", "text");
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(a / "new/c")));
    EXPECT_FALSE(fs::exists(folder / "victim"));
    EXPECT_EQ(shown_output(a / "new/c"), fs::canonical(folder.path()) / "c");
}

TEST(OutputSet, RefusesASecondSetWithTheSameTarget) {
    const TemporaryFolder folder;
    OutputSet one(folder.path()), two(folder.path());
    one.file(folder / "a");
    const std::string message = message_of([&] { two.file(folder / "a"); });
    EXPECT_NE(message.find("a: expected an output that no other run is writing, found process " +
                           std::to_string(::getpid()) + " on "),
              std::string::npos)
        << message;
    two.file(folder / "b");
}

TEST(OutputSet, RemovesWhatAKilledRunLeft) {
    const TemporaryFolder folder;
    in_killed_process([&] {
        OutputSet& set = *new OutputSet(folder.path());  // never destroyed
        write_file(set.file(folder / "a"), "half");
        write_file(set.folder(folder / "f") / "x", "half");
    });
    EXPECT_FALSE(folder.listing().empty());
    OutputSet(folder.path()).file(folder / "a");
    EXPECT_EQ(folder.listing(), Names{});
}

TEST(OutputSet, LeavesTheFilesOfARunThatGoesOn) {
    const TemporaryFolder folder;
    OutputSet one(folder.path());
    write_file(one.file(folder / "a"), "a");
    { OutputSet(folder.path()).file(folder / "b"); }
    one.commit();
    EXPECT_EQ(bytes_of(folder / "a"), "a");
}

/// A process that was killed after `moved` of the three moves of its journal.
void leave_after(int moved, const TemporaryFolder& folder, bool exchanges) {
    write_file(folder / "a", "old");
    write_file(folder / "f/x", "old");
    in_killed_process([&] {
        const detail::Places places = (new detail::PrivateFolder(folder.path()))->places();
        detail::write_new_file(places.fresh("a"), "new", false, "a");
        detail::write_new_file(places.fresh("b"), "new", false, "b");
        fs::create_directory(places.fresh("f"));
        detail::write_new_file(places.fresh("f") / "y", "new", false, "y");
        std::vector<detail::Move> moves;
        for (const char* name : {"a", "f", "b"})
            moves.push_back({name, inode_of(places.fresh(name))});
        detail::write_new_file(places.private_folder / "journal", detail::journal_text(moves),
                               false, "journal");
        for (int i = 0; i < moved; ++i)
            if (exchanges) {
                detail::move_to_place(places, moves[static_cast<std::size_t>(i)]);
            } else {
                // As where the file system cannot exchange: killed between the two renames.
                const std::string& name = moves[static_cast<std::size_t>(i)].target;
                if (fs::exists(places.root / name))
                    fs::rename(places.root / name, places.former(name));
            }
    });
}

TEST(OutputSet, FinishesWhatAKilledRunHadDecided) {
    for (const bool exchanges : {true, false})
        for (int moved = 0; moved <= 3; ++moved) {
            const TemporaryFolder folder;
            leave_after(moved, folder, exchanges);
            { const OutputSet next(folder.path()); }
            EXPECT_EQ(folder.listing(), (Names{"a", "b", "f", "f/y"})) << moved;
            EXPECT_EQ(bytes_of(folder / "a"), "new");
        }
}

TEST(OutputSet, BelievesOnlyACompleteJournalThatStaysBelow) {
    const std::vector<detail::Move> moves{{"a b\nc%", 5}, {"d/e", 6}};
    const std::string text = detail::journal_text(moves);
    const auto read = detail::moves_of(text);
    ASSERT_TRUE(read);
    EXPECT_EQ((*read)[0].target, "a b\nc%");
    EXPECT_EQ((*read)[1].inode, 6u);
    for (std::size_t size = 0; size + 1 < text.size(); ++size)
        EXPECT_FALSE(detail::moves_of(text.substr(0, size))) << size;
    for (const char* target : {"../a", "/etc/x", "a/../../b", ""})
        EXPECT_FALSE(detail::moves_of(detail::journal_text({{target, 5}}))) << target;
}

TEST(OutputSet, GivesBackWhatWasThereWhenAMoveFails) {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    {
        OutputSet set(folder.path());
        write_file(set.file(folder / "a"), "new");
        const fs::path below = set.file(folder / "sub/b");
        write_file(below, "new");
        write_file(folder / "sub", "a file where a folder is needed");
        EXPECT_THROW(set.commit(), RunError);
    }
    EXPECT_EQ(folder.listing(), (Names{"a", "sub"}));
    EXPECT_EQ(bytes_of(folder / "a"), "old");
}

TEST(OutputSet, RefusesLinksAndPipesAsTargets) {
    const TemporaryFolder folder;
    write_file(folder / "real", "mine");
    fs::create_symlink(folder / "real", folder / "link");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    fs::create_directory(folder / "folder");
    OutputSet set(folder.path());
    const auto found = [&](const char* name) {
        const std::string message = message_of([&] { set.file(folder / name); });
        return message.substr(message.rfind("expected"));
    };
    EXPECT_EQ(found("link"), "expected a regular file, or nothing yet, found a symbolic link");
    EXPECT_EQ(found("pipe"), "expected a regular file, or nothing yet, found a pipe");
    EXPECT_EQ(found("folder"), "expected a regular file, or nothing yet, found a folder");
    EXPECT_THROW(set.folder(folder / "real"), Error);
    EXPECT_THROW(set.file(folder / "../elsewhere"), Error);
}

TEST(OutputSet, RefusesAnOutputThatIsAnInput) {
    const TemporaryFolder folder;
    write_file(folder / "a", "mine");
    write_file(folder / "f/b", "mine");
    fs::create_hard_link(folder / "a", folder / "other name");
    const InputLog log;
    {
        const ReadingFormerOutput former;
        read_file(folder / "a", kText);
    }
    OutputSet set(folder.path());
    write_file(set.file(folder / "a"), "new");
    read_file(folder / "a", kText);
    read_file(folder / "f/b", kText);
    const char* expected = "expected an output that is not an input";
    EXPECT_NE(message_of([&] { set.file(folder / "other name"); }).find(expected),
              std::string::npos);
    EXPECT_NE(message_of([&] { set.folder(folder / "f"); }).find(expected), std::string::npos);
    // Read after it was named as a target
    EXPECT_NE(message_of([&] { set.commit(); }).find(expected), std::string::npos);
    EXPECT_EQ(bytes_of(folder / "a"), "mine");
}

TEST(OutputSet, ReplacesAnInputWhenAPersonLetsIt) {
    const TemporaryFolder folder;
    write_file(folder / "a", "mine");
    const InputLog log;
    read_file(folder / "a", kText);
    {
        OutputSet given_up(folder.path());
        write_file(given_up.replacement(folder / "a"), "lost");
    }
    EXPECT_EQ(bytes_of(folder / "a"), "mine");
    OutputSet set(folder.path());
    write_file(set.replacement(folder / "a"), "new");
    set.commit();
    EXPECT_EQ(bytes_of(folder / "a"), "new");
}

TEST(OutputSet, IsGoneWhenItIsAbandonedAndNoLongerCommits) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        OutputSet set(folder / "made");
        write_file(set.file(folder / "made/a"), "a");
        {
            const UninterruptedStep step;
            if (abandon_outputs()) ::_exit(1);
        }
        if (!abandon_outputs()) ::_exit(2);
        if (!folder.listing().empty()) ::_exit(3);
        try {
            set.commit();
        } catch (const Interrupted&) {
            ::_exit(0);
        } catch (const RunError&) {
            ::_exit(0);
        }
        ::_exit(4);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(OutputSet, IsNotCutOffWhileItRemovesWhatItWrote) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        auto set = std::make_unique<OutputSet>(folder / "made");
        const fs::path written = set->folder(folder / "made/a");
        for (int i = 0; i < 3000; ++i) write_file(written / std::to_string(i), "a");
        std::thread removing([&] { set.reset(); });
        while (is_private_output(written)) {
        }
        // As who ends the program does: as soon as there is nothing that it would cut off.
        while (!abandon_outputs()) {
        }
        ::_exit(folder.listing().empty() ? 0 : 3);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(OutputSet, IsNoLongerAbandonedAfterTheLastCommit) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        write_file(folder / "part", "a");
        if (outputs_are_decided()) ::_exit(1);
        OutputSet set(folder.path());
        write_file(set.file(folder / "a"), "a");
        set.commit();
        ::_exit(outputs_are_decided() && !abandon_outputs() && any_output_committed() ? 0 : 2);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace risorius
