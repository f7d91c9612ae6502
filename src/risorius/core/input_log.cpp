// SPDX-License-Identifier: MIT
#include "risorius/core/input_log.h"

#include <mutex>
#include <set>
#include <utility>

namespace risorius {

namespace {

struct Noted {
    std::mutex mutex;
    int logs = 0;
    std::set<std::pair<dev_t, ino_t>> files;
};

Noted& noted() {
    static Noted one;
    return one;
}

thread_local int reading_former_output = 0;

}  // namespace

InputLog::InputLog() {
    const std::lock_guard lock(noted().mutex);
    ++noted().logs;
}

InputLog::~InputLog() {
    const std::lock_guard lock(noted().mutex);
    if (--noted().logs == 0) noted().files.clear();
}

ReadingFormerOutput::ReadingFormerOutput() { ++reading_former_output; }
ReadingFormerOutput::~ReadingFormerOutput() { --reading_former_output; }

void note_input(dev_t device, ino_t inode) {
    if (reading_former_output > 0) return;
    const std::lock_guard lock(noted().mutex);
    if (noted().logs > 0) noted().files.emplace(device, inode);
}

bool is_input(dev_t device, ino_t inode) {
    const std::lock_guard lock(noted().mutex);
    return noted().files.contains({device, inode});
}

}  // namespace risorius
