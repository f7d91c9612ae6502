// SPDX-License-Identifier: MIT
#include "risorius/report/atomic_file.h"

#include <unistd.h>

#include <fstream>

#include "risorius/core/error.h"

namespace risorius::report {

namespace fs = std::filesystem;

AtomicFile::AtomicFile(const fs::path& file, const std::string& text)
    : file_(file),
      partial_(fs::absolute(file).parent_path() /
               ("." + file.filename().string() + ".part-" + std::to_string(::getpid()))) {
    std::error_code failure;
    fs::create_directories(partial_.parent_path(), failure);
    std::ofstream stream(partial_, std::ios::binary);
    stream << text;
    stream.close();
    if (stream) return;
    fs::remove(partial_, failure);
    throw RunError(file_.string() + ": cannot be written");
}

AtomicFile::~AtomicFile() {
    if (partial_.empty()) return;
    std::error_code ignored;
    fs::remove(partial_, ignored);
}

void AtomicFile::commit() {
    std::error_code failure;
    fs::rename(partial_, file_, failure);
    if (failure) throw RunError(file_.string() + ": cannot be written: " + failure.message());
    partial_.clear();
}

void write_text(const fs::path& file, const std::string& text) {
    AtomicFile staged(file, text);
    staged.commit();
}

}  // namespace risorius::report
