// SPDX-License-Identifier: MIT
/// \file
/// The files that renders read. Each is read from disk once, however many jobs use it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "risorius/animate/detail/run_record.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"
#include "risorius/talk/say_event.h"

namespace risorius::animate {

/// A script that has been parsed, but not yet checked against a rig.
struct ScriptInput {
    JsonCursor json;
    std::string sha256;  ///< of the bytes of the file
};

/// A rig with its mesh and tables, and the checksums of their files.
struct RigInput {
    scene::RigFiles files;
    InputFile rig, mesh;
    std::vector<InputFile> tables;  ///< other files that the rig names
};

/// Reads files and keeps them. Several threads may use the same object.
class RenderInputs {
  public:
    /// `stopped`: returns true when reading should stop; then Interrupted is thrown.
    explicit RenderInputs(std::function<bool()> stopped = {}) {
        monitor_.stopped = std::move(stopped);
    }
    /// Reports progress to `monitor`, too. `poses`: whether the mouths of a rig that speaks may be simulated, which takes minutes.
    enum class Poses { kSimulated, kOnlyKnown };
    explicit RenderInputs(ProgressMonitor monitor, Poses poses = Poses::kSimulated)
        : monitor_(std::move(monitor)), poses_(poses) {}

    /// Throws Error when the file cannot be read or is not JSON.
    std::shared_ptr<const ScriptInput> script(const std::filesystem::path& file);
    /// Throws Error when the rig or its mesh cannot be used.
    std::shared_ptr<const RigInput> rig(const std::filesystem::path& file);

    /// How to get the mouths of a rig. It refers to this object.
    talk::MouthPoses mouth_poses() const;

  private:
    ProgressMonitor monitor_;
    Poses poses_ = Poses::kSimulated;
    std::mutex mutex_;
    std::map<std::filesystem::path, std::shared_ptr<const ScriptInput>> scripts_;
    std::map<std::filesystem::path, std::shared_ptr<const RigInput>> rigs_;
};

/// Returns the SHA-256 of text or other bytes, as hexadecimal digits.
std::string sha256_of_text(const std::string& text);

}  // namespace risorius::animate
