// SPDX-License-Identifier: MIT
// Recordings as files: what is read, and what is rejected with file, line and column.

#include "risorius/signal/recording.h"

#include <gtest/gtest.h>

#include <fstream>

#include "message_of.h"
#include "own_folder_test.h"

namespace risorius::signal {
namespace {

namespace fs = std::filesystem;

class RecordingFile : public OwnFolderTest {};

Recording recorded(const std::string& text) {
    const fs::path file = "recording_test.csv";
    std::ofstream(file, std::ios::binary) << text;
    return Recording::read_file(file);
}

TEST_F(RecordingFile, TabsSemicolonsAndCommasSeparate) {
    for (const char* text :
         {"a,b\n1,2\n-3e-2,4\n", "# made by hand\r\n\"a\";\"b\"\r\n 1; 2\r\n-0.03;4\r\n",
          "\xEF\xBB\xBF"
          "a\tb\n1\t2\n\n-0.03\t4"}) {
        const Recording r = recorded(text);
        ASSERT_EQ(r.columns(), (std::vector<std::string>{"a", "b"})) << text;
        EXPECT_EQ(r.samples(0), (std::vector<double>{1, -0.03}));
        EXPECT_EQ(r.samples(1), (std::vector<double>{2, 4}));
    }
    EXPECT_EQ(recorded("one\n5\n").samples(0), std::vector<double>{5});
}

TEST_F(RecordingFile, WhatIsNoNumberIsNamedByLineAndColumn) {
    for (const auto& [cell, found] : {std::pair{"nan", "\"nan\""}, std::pair{"", "nothing"},
                                      std::pair{"1.2.3", "\"1.2.3\""}, std::pair{"inf", "\"inf\""}})
        EXPECT_EQ(message_of([text = std::string("a,b\n1,2\n3,") + cell + "\n"] {
                      recorded(text).samples(1);
                  }),
                  std::string("recording_test.csv:3:b: expected a number, found ") + found);
}

TEST_F(RecordingFile, TablesThatAreNoneAreRefused) {
    EXPECT_EQ(message_of([] { recorded("a,b\n1,2\n1,2,3\n"); }),
              "recording_test.csv:3: expected 2 cells, found 3");
    EXPECT_EQ(message_of([] { recorded("a,b\n1\n"); }),
              "recording_test.csv:2: expected 2 cells, found 1");
    EXPECT_EQ(message_of([] { recorded("a,b,a\n"); }),
              "recording_test.csv:1: expected every column once, found \"a\" again");
    std::string many = "a";
    for (int i = 0; i < 5000; ++i) many += ",b" + std::to_string(i);
    EXPECT_EQ(message_of([&] { recorded(many + "\n"); }),
              "recording_test.csv:1: expected at most 5000 columns, found more");
    EXPECT_EQ(message_of([] { recorded("a,,b\n"); }),
              "recording_test.csv:1: expected a name for every column, found an empty one");
    EXPECT_EQ(message_of([] { recorded("\n# nothing\n"); }),
              "recording_test.csv: expected a line with the names of the columns, found none");
    EXPECT_EQ(message_of([] { Recording::read_file("no_such.csv"); }),
              "no_such.csv: expected a recording, found no such file");
}

TEST_F(RecordingFile, LinesEndAsAnySystemEndsThemAndQuotedCellsHoldSeparators) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const Recording r = recorded("\"a;b\";c" + end + "1;\"2\"" + end + "+3;+4.5e+00" + end);
        ASSERT_EQ(r.columns(), (std::vector<std::string>{"a;b", "c"}));
        EXPECT_EQ(r.samples(0), (std::vector<double>{1, 3}));
        EXPECT_EQ(r.samples(1), (std::vector<double>{2, 4.5}));
    }
    EXPECT_EQ(recorded("a,b\n\"x\"\"y\",1\n").sample_count(), 1u);
    EXPECT_EQ(message_of([] { recorded("a\n\"1\n"); }),
              "recording_test.csv:2: expected a closing quote, found the end of the line");
    EXPECT_EQ(message_of([] { recorded(std::string("\xFF\xFE\x61\0", 4)); }),
              "recording_test.csv: expected text in UTF-8, found text in UTF-16");
}

TEST_F(RecordingFile, DecimalCommasAreNamed) {
    EXPECT_EQ(message_of([] { recorded("a;b\n1;2,5\n").samples(1); }),
              "recording_test.csv:2:b: expected a number with a decimal point, found \"2,5\"");
    EXPECT_EQ(message_of([] { recorded("a,b\n0,1,2,5\n"); }),
              "recording_test.csv:2: expected 2 cells, found 4; a comma separates cells, so that "
              "numbers need a decimal point");
}

TEST_F(RecordingFile, ReadErrorsAreNotTheEndOfTheFile) {
    EXPECT_EQ(message_of([] { Recording::read_file("/proc/self/mem"); }),
              "/proc/self/mem: expected a recording, found one that cannot be read (Input/output "
              "error)");
    EXPECT_EQ(message_of([] { Recording::read_file("/dev/zero"); }),
              "/dev/zero: expected a recording, found a device or socket");
}

TEST_F(RecordingFile, ShortGapsAreBridgedAndLongOnesNamed) {
    const Recording r = recorded("t,a\n0,n/a\n0.01,1\n0.02,NaN\n0.03,\n0.04,4\n0.05,NA\n");
    const Recording::Bridged bridged = r.bridged_samples(1, r.samples(0));
    ASSERT_EQ(bridged.samples.size(), 6u);
    for (const auto& [i, expected] :
         {std::pair{0, 1.0}, {1, 1.0}, {2, 2.0}, {3, 3.0}, {4, 4.0}, {5, 4.0}})
        EXPECT_NEAR(bridged.samples[static_cast<std::size_t>(i)], expected, 1e-12) << i;
    EXPECT_EQ(bridged.notes,
              std::vector<std::string>{
                  "recording_test.csv: 4 values of \"a\" are missing and bridged, at "
                  "most 0.02 s in a row"});
    const Recording lost = recorded("t,a\n0,1\n0.1,n/a\n0.2,n/a\n0.3,1\n");
    EXPECT_EQ(message_of([&] { lost.bridged_samples(1, lost.samples(0)); }),
              "recording_test.csv:3:a: expected gaps of at most 0.1 s, found one of 0.2 s, 2 rows");
    const Recording none = recorded("t,a\n0,n/a\n0.01,n/a\n");
    EXPECT_EQ(message_of([&] { none.bridged_samples(1, none.samples(0)); }),
              "recording_test.csv:2:a: expected a number in some row, found none");
    EXPECT_TRUE(recorded("t,a\n0,1\n1,2\n").bridged_samples(1, {0, 1}).notes.empty());
}

TEST_F(RecordingFile, RateComesFromTimesAndGapsAreNamed) {
    EXPECT_NEAR(recorded("t,a\n0.5,1\n0.502,1\n0.504,1\n0.506,1\n").rate_hz(0), 500, 1e-9);
    EXPECT_EQ(message_of([] { recorded("t\n0\n0.002\n0.004\n0.010\n0.012\n").rate_hz(0); }),
              "recording_test.csv:5:t: expected a time 0.002 s after the one before, found 0.006 s "
              "after it");
    EXPECT_EQ(message_of([] { recorded("t\n0\n0.5\n0.25\n0.75\n1.25\n").rate_hz(0); }),
              "recording_test.csv:4:t: expected a time 0.5 s after the one before, found -0.25 s "
              "after it");
    EXPECT_EQ(message_of([] { recorded("t\n1\n1\n1\n1\n").rate_hz(0); }),
              "recording_test.csv:3:t: expected times that grow, found 0 s after it");
    EXPECT_EQ(message_of([] { recorded("t\n1\n2\n").rate_hz(0); }),
              "recording_test.csv: expected three samples or more, found 2");
}

}  // namespace
}  // namespace risorius::signal
