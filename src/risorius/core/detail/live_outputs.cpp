// SPDX-License-Identifier: MIT
#include "risorius/core/detail/live_outputs.h"

#include <unistd.h>

#include <atomic>
#include <map>
#include <mutex>

#include "risorius/core/output_set.h"
#include "risorius/core/progress_monitor.h"

namespace risorius {

namespace fs = std::filesystem;

namespace {

struct State {
    std::mutex mutex;
    struct Output {
        fs::path root;
        std::vector<fs::path> made;
    };
    std::map<fs::path, Output> outputs;  ///< of each private folder
    int deciding = 0;                    ///< commits, removals and steps that must not be cut off
    bool abandoned = false;
    std::atomic<bool> decided{false}, any_committed{false};
};

/// Never destroyed, because threads may still write when the program ends.
State& state() {
    static State& one = *new State;
    return one;
}

/// The private folder that the path lies in, as an iterator.
auto private_folder_of(const fs::path& path) {
    State& all = state();
    for (fs::path above = path; above.has_relative_path(); above = above.parent_path())
        if (const auto found = all.outputs.find(above); found != all.outputs.end()) return found;
    return all.outputs.end();
}

}  // namespace

namespace detail {

LiveOutput::LiveOutput(const fs::path& root, const fs::path& private_folder,
                       const std::vector<fs::path>& made)
    : private_folder_(private_folder) {
    const std::lock_guard lock(state().mutex);
    state().outputs[private_folder] = {root, made};
    state().decided = false;
}

LiveOutput::~LiveOutput() {
    const std::lock_guard lock(state().mutex);
    state().outputs.erase(private_folder_);
}

Decision::Decision() {
    const std::lock_guard lock(state().mutex);
    if (state().abandoned) throw Interrupted();
    ++state().deciding;
}

Decision::~Decision() {
    const std::lock_guard lock(state().mutex);
    --state().deciding;
}

Removal::Removal() {
    const std::lock_guard lock(state().mutex);
    ++state().deciding;
}

Removal::~Removal() {
    const std::lock_guard lock(state().mutex);
    --state().deciding;
}

void Decision::succeeded(bool last) const {
    state().any_committed = true;
    if (last) state().decided = true;
}

}  // namespace detail

bool is_private_output(const fs::path& path) {
    const std::lock_guard lock(state().mutex);
    return private_folder_of(path) != state().outputs.end();
}

fs::path shown_output(const fs::path& path) {
    const std::lock_guard lock(state().mutex);
    const auto found = private_folder_of(path);
    if (found == state().outputs.end()) return path;
    const fs::path below = path.lexically_relative(found->first);
    fs::path shown = found->second.root;
    // The first part is "new".
    for (auto part = std::next(below.begin()); part != below.end(); ++part) shown /= *part;
    return shown;
}

bool abandon_outputs() {
    State& all = state();
    const std::lock_guard lock(all.mutex);
    if (all.deciding > 0 || all.decided) return false;
    all.abandoned = true;
    for (const auto& [folder, output] : all.outputs) {
        // Threads may still be making files in it.
        constexpr int kTries = 50;
        std::error_code failure;
        for (int i = 0; i < kTries && fs::exists(folder, failure); ++i)
            fs::remove_all(folder, failure);
    }
    for (const auto& [folder, output] : all.outputs)
        for (auto made = output.made.rbegin(); made != output.made.rend(); ++made)
            ::rmdir(made->c_str());
    return true;
}

bool outputs_are_decided() { return state().decided; }

bool any_output_committed() { return state().any_committed; }

UninterruptedStep::UninterruptedStep() {
    const std::lock_guard lock(state().mutex);
    if (state().abandoned) throw Interrupted();
    ++state().deciding;
}

UninterruptedStep::~UninterruptedStep() {
    const std::lock_guard lock(state().mutex);
    --state().deciding;
}

}  // namespace risorius
