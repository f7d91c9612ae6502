// A shot played from its first frame to its last: simulated, drawn, measured, marked.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "risorius/animate/animate.h"
#include "risorius/animate/detail/pass_writer.h"
#include "risorius/animate/shot.h"
#include "risorius/animate/studio.h"
#include "risorius/core/image.h"

namespace risorius::animate {

/// What the monitor is told while frames are drawn.
inline constexpr const char* kRendering = "rendering";

/// Gets the pictures in order, on a thread of its own when there are several.
using UsePicture = std::function<void(Image)>;

/// What else a film leaves.
struct FilmExtras {
    std::filesystem::path passes_folder;  ///< where the passes go, when there are any
    std::optional<PassWriter> passes;     ///< written, not yet committed
    std::string table;                    ///< frame_table.h
};

/// Throws Error for input, Interrupted when asked to stop. In a studio that has been used before, the same film is made sooner.
RunRecord film(const AnimateOptions& options, const Shot& shot, const UsePicture& use,
               FilmExtras& extras, const ProgressMonitor& monitor, Studio& studio);
RunRecord film(const AnimateOptions& options, const Shot& shot, const UsePicture& use,
               FilmExtras& extras, const ProgressMonitor& monitor);

}  // namespace risorius::animate
