// SPDX-License-Identifier: MIT
// What read_file() refuses, and what text readers take from a file.
#include "risorius/core/read_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "message_of.h"
#include "risorius/core/error.h"
#include "risorius/core/read_observer.h"
#include "risorius/core/readable_text.h"
#include "risorius/core/text_lines.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

using namespace std::string_literals;
namespace fs = std::filesystem;

constexpr FileKind kNote{"a note", 2 * kMegabyte};

void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

TEST(ReadFile, GivesEveryByte) {
    const TemporaryFolder any;
    const std::string text = "a\0b\r\n\xff"s;
    write(any.path() / "note", text);
    EXPECT_EQ(read_file(any.path() / "note", kNote), text);
    EXPECT_EQ(read_bytes(any.path() / "note", kNote).size(), text.size());
    write(any.path() / "empty", "");
    EXPECT_EQ(read_file(any.path() / "empty", kNote), "");
}

TEST(ReadFile, ShowsToAnObserverWhatItsThreadHasRead) {
    const TemporaryFolder any;
    write(any / "a", "one");
    write(any / "b", "");
    std::vector<std::string> seen;
    const auto note = [&](const fs::path& file, const void* bytes, std::size_t size) {
        seen.push_back(file.filename().string() + "=" +
                       std::string(static_cast<const char*>(bytes), size));
    };
    read_file(any / "a", kNote);
    {
        const ReadObserver outer([](const auto&...) { FAIL() << "the latest one is asked"; });
        const ReadObserver inner(note);
        read_file(any / "a", kNote);
        read_bytes(any / "b", kNote);
        EXPECT_EQ(message_of([&] { read_file(any / "c", kNote); }),
                  (any / "c").string() + ": expected a note, found no such file");
        std::thread([&] { read_file(any / "a", kNote); }).join();
    }
    read_file(any / "a", kNote);
    EXPECT_EQ(seen, (std::vector<std::string>{"a=one", "b="}));
}

TEST(ReadFile, RefusesWhatIsNoFile) {
    EXPECT_EQ(message_of([] { read_file("no/such", kNote); }),
              "no/such: expected a note, found no such file");
    EXPECT_EQ(message_of([] { read_file("/dev/zero", kNote); }),
              "/dev/zero: expected a note, found a device or socket");
    EXPECT_EQ(message_of([] { read_file("/", kNote); }), "/: expected a note, found a folder");
    EXPECT_EQ(
        message_of([] { read_file("/proc/self/mem", kNote); }),
        "/proc/self/mem: expected a note, found one that cannot be read (Input/output error)");
}

TEST(ReadFile, RefusesFilesAboveTheLimitBeforeReading) {
    const TemporaryFolder any;
    const fs::path file = any.path() / "large";
    write(file, "x");
    fs::resize_file(file, 100'000'000'000);  // without bytes on the disk
    const std::string message =
        file.string() + ": expected a note of at most 2 MB, found 100000000000 bytes";
    EXPECT_EQ(message_of([&] { read_file(file, kNote); }), message);
    EXPECT_EQ(message_of([&] { check_file(file, kNote); }), message);
}

/// A pipe into which a thread writes `text` over and over, at most `times` times.
class WrittenPipe {
  public:
    WrittenPipe(const fs::path& file, const std::string& text, int times) {
        ::mkfifo(file.c_str(), 0600);
        writer_ = std::thread([=] {
            std::ofstream out(file, std::ios::binary);
            for (int i = 0; i < times && out; ++i) out << text << std::flush;
        });
    }
    ~WrittenPipe() { writer_.join(); }

  private:
    std::thread writer_;
};

TEST(ReadFile, ReadsPipes) {
    const TemporaryFolder any;
    const fs::path file = any.path() / "pipe";
    const WrittenPipe pipe(file, std::string(1000, 'x'), 300);
    EXPECT_EQ(read_file(file, kNote), std::string(300'000, 'x'));
}

TEST(ReadFile, WaitsForAWriterButNotForEver) {
    const TemporaryFolder any;
    const fs::path file = any.path() / "pipe";
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    EXPECT_EQ(
        message_of([&] { read_file(file, kNote); }),
        file.string() + ": expected a note, found a pipe into which nobody has written for 10 s");
    // A writer that says nothing for a while is waited for, and one that says nothing at all is an empty file.
    std::thread late([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        std::ofstream out(file, std::ios::binary);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        out << "late";
    });
    EXPECT_EQ(read_file(file, kNote), "late");
    late.join();
    std::thread silent([&] { std::ofstream out(file, std::ios::binary); });
    EXPECT_EQ(read_file(file, kNote), "");
    silent.join();
}

TEST(ReadFile, LeavesAPipeWithoutEndAtTheLimit) {
    const TemporaryFolder any;
    const fs::path file = any.path() / "pipe";
    ::signal(SIGPIPE, SIG_IGN);
    const WrittenPipe pipe(file, std::string(1000, 'x'), 100'000'000);
    EXPECT_EQ(message_of([&] { read_file(file, kNote); }),
              file.string() + ": expected a note of at most 2 MB, found more than that");
}

TEST(TextLines, EndAtEveryKindOfBreak) {
    const std::string text = "a\nb\r\nc\rd\n\ne";
    std::string seen;
    for (TextLines lines(text); lines.next();) {
        seen += std::to_string(lines.number()) + std::string(lines.line()) + " ";
        EXPECT_EQ(text.substr(lines.begin(), lines.line().size()), lines.line());
    }
    EXPECT_EQ(seen, "1a 2b 3c 4d 5 6e ");
}

TEST(TextLines, LeaveOutTheByteOrderMarkAndNameOtherEncodings) {
    EXPECT_EQ(text_of_bytes("\xEF\xBB\xBFx", "note"), "x");
    EXPECT_EQ(message_of([] { text_of_bytes("\xFF\xFEx\0"s, "note"); }),
              "note: expected text in UTF-8, found text in UTF-16");
    EXPECT_EQ(message_of([] { text_of_bytes("\xFF\xFE\0\0"s, "note"); }),
              "note: expected text in UTF-8, found text in UTF-32");
}

TEST(ReadableText, ShowsControlCharactersAndBytesThatAreNoText) {
    EXPECT_EQ(readable_text("\x1b[2J\xff\xc3 \n\t\x7f\xc2\x9b"s),
              "\\x1b[2J\\xff\\xc3 \\n\\x09\\x7f\\xc2\\x9b");
    EXPECT_EQ(readable_text("Mäkinen 顔 😀"), "Mäkinen 顔 😀");
    EXPECT_EQ(
        readable_text("\xed\xa0\x80 \xc0\xaf \xf5\x80\x80\x80"),  // surrogate, overlong, too large
        "\\xed\\xa0\\x80 \\xc0\\xaf \\xf5\\x80\\x80\\x80");
}

TEST(ReadableText, IsCutBetweenCharacters) {
    EXPECT_EQ(shortened_text("äää", 5), "ää...");
    EXPECT_EQ(shortened_text("äää", 6), "äää");
    EXPECT_EQ(shortened_text("abc\x1b", 6), "abc...");
}

TEST(Error, IsOneReadableLine) {
    EXPECT_STREQ(Error("a\nb", "\x1b[31m", "\xff").what(),
                 "a\\nb: expected \\x1b[31m, found \\xff");
    EXPECT_STREQ(RunError("a\x07").what(), "a\\x07");
}

}  // namespace
}  // namespace risorius
