// SPDX-License-Identifier: MIT
/// \file
/// Keeps the poses of a rig (rig_voice.h) in a file, so that they are simulated once.
#pragma once

#include <functional>
#include <optional>

#include "risorius/scene/rig_files.h"
#include "risorius/talk/detail/rig_voice.h"

namespace risorius::talk {

/// The file beside a rig: "rigs/adult/rig.voice.json" for "rigs/adult/rig.json".
std::filesystem::path voice_file_of(const std::filesystem::path& rig_file);

/// The poses of a rig: from the file beside it, else from the cache of the user (core/result_cache.h), else simulated and
/// put into the cache. A file is used only when it was made of the same rig, mesh and tables; `report` is called while
/// poses are simulated.
RigVoice voice_of_rig(const scene::RigFiles& files,
                      const std::function<void(double fraction)>& report = {});

/// The same, but without a simulation: none when there is no file of this rig.
std::optional<RigVoice> known_voice_of_rig(const scene::RigFiles& files);

/// Simulates the poses and writes the file beside the rig. Returns its path. Throws RunError when it cannot be written.
std::filesystem::path write_voice_of_rig(const scene::RigFiles& files,
                                         const std::function<void(double fraction)>& report);

}  // namespace risorius::talk
