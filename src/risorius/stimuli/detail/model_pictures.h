// SPDX-License-Identifier: MIT
/// \file
/// Shows the expression of a model: as a video, and as a strip of pictures at equal times with the ends of its interval above and
/// below.
#pragma once

#include <filesystem>
#include <vector>

#include "risorius/animate/render_inputs.h"
#include "risorius/animate/render_session.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/output_set.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::stimuli {

/// An expression as a script, with its name in a strip.
struct NamedScript {
    std::string name;
    Json script;
};

class ModelPictures {
  public:
    /// `outputs`: the files become part of it.
    ModelPictures(OutputSet& outputs, ProgressMonitor monitor)
        : outputs_(outputs), monitor_(std::move(monitor)), inputs_(monitor_.stopped) {}

    /// Writes STEM.mp4 of the script at index `film`, and STEM.png with a row for each script. Throws Error, RunError and Interrupted.
    void write(const std::vector<NamedScript>& scripts, std::size_t film,
               const std::filesystem::path& stem);

  private:
    OutputSet& outputs_;
    ProgressMonitor monitor_;
    animate::RenderInputs inputs_;
    animate::RenderSession session_;
};

}  // namespace risorius::stimuli
