// SPDX-License-Identifier: MIT
#include "risorius/animate/render_inputs.h"

#include "risorius/animate/detail/read_checksums.h"
#include "risorius/core/json_text.h"
#include "risorius/core/sha256.h"

namespace risorius::animate {

namespace fs = std::filesystem;

std::string sha256_of_text(const std::string& text) {
    Sha256 hash;
    hash.add(text.data(), text.size());
    return hash.finish();
}

std::shared_ptr<const ScriptInput> RenderInputs::script(const fs::path& file) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const ScriptInput>& known = scripts_[file];
    if (!known) {
        const std::string text = read_json_text(file);
        known = std::make_shared<const ScriptInput>(
            ScriptInput{parse_json_text(text, file), sha256_of_text(text)});
    }
    return known;
}

std::shared_ptr<const RigInput> RenderInputs::rig(const fs::path& file) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const RigInput>& known = rigs_[file];
    if (!known) {
        auto read = std::make_shared<RigInput>();
        ReadChecksums sums;
        read->files = scene::read_rig_files(file, monitor_.stopped);
        read->rig = sums.of(read->files.file);
        read->mesh = sums.of(read->files.rig.mesh_file);
        for (const fs::path& table : read->files.rig.table_files)
            read->tables.push_back(sums.of(table));
        known = std::move(read);
    }
    return known;
}

talk::MouthPoses RenderInputs::mouth_poses() const {
    return {.report =
                [this](double fraction) {
                    monitor_.report(fraction, "simulating mouths of this rig, once");
                },
            .may_simulate = poses_ == Poses::kSimulated};
}

}  // namespace risorius::animate
