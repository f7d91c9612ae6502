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
    EXPECT_EQ(message_of([] { recorded("a,,b\n"); }),
              "recording_test.csv:1: expected a name for every column, found an empty one");
    EXPECT_EQ(message_of([] { recorded("\n# nothing\n"); }),
              "recording_test.csv: expected a line with the names of the columns, found none");
    EXPECT_EQ(message_of([] { Recording::read_file("no_such.csv"); }),
              "no_such.csv: expected a readable file, found none");
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
