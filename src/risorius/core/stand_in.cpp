// SPDX-License-Identifier: MIT
#include "risorius/core/stand_in.h"

#include <map>
#include <mutex>

namespace risorius {

namespace fs = std::filesystem;

namespace {

struct StandIns {
    std::mutex mutex;
    std::map<fs::path, fs::path> files;
};

StandIns& stand_ins() {
    static StandIns one;
    return one;
}

fs::path full_name(const fs::path& name) {
    std::error_code failed;
    const fs::path full = fs::absolute(name, failed);
    return failed ? name : full.lexically_normal();
}

}  // namespace

StandIn::StandIn(const fs::path& name, const fs::path& file) : name_(full_name(name)) {
    const std::lock_guard lock(stand_ins().mutex);
    stand_ins().files[name_] = fs::absolute(file);
}

StandIn::~StandIn() {
    const std::lock_guard lock(stand_ins().mutex);
    stand_ins().files.erase(name_);
}

fs::path file_to_read(const fs::path& name) {
    const std::lock_guard lock(stand_ins().mutex);
    if (stand_ins().files.empty()) return name;
    const auto found = stand_ins().files.find(full_name(name));
    return found == stand_ins().files.end() ? name : found->second;
}

}  // namespace risorius
