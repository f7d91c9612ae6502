// SPDX-License-Identifier: MIT
/// \file
/// Which files a process has read as input, so that no output takes the place of one. A file is known by its device and inode,
/// so that neither links nor other spellings of its path hide it.
#pragma once

#include <sys/types.h>

namespace risorius {

/// While an object of this class exists, read_file() and check_file() note what they open. A program makes one at its start.
/// Without one, nothing is noted, so that a program that uses the library may write what it has read.
class InputLog {
  public:
    InputLog();
    ~InputLog();
    InputLog(const InputLog&) = delete;
    InputLog& operator=(const InputLog&) = delete;
};

/// While an object of this class exists, what its thread reads is not noted. For the files of an earlier run that the present run
/// replaces, such as its record.
class ReadingFormerOutput {
  public:
    ReadingFormerOutput();
    ~ReadingFormerOutput();
    ReadingFormerOutput(const ReadingFormerOutput&) = delete;
    ReadingFormerOutput& operator=(const ReadingFormerOutput&) = delete;
};

/// Notes a file that was opened for reading.
void note_input(dev_t device, ino_t inode);

/// Whether the file was noted.
bool is_input(dev_t device, ino_t inode);

}  // namespace risorius
