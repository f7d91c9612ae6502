// SPDX-License-Identifier: MIT
/// \file
/// Options that several commands share: view and encoding.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "risorius/animate/render_request.h"

namespace risorius::cli {

/// Reads "1024x1024". Throws Error.
animate::PictureSize size_from(const std::string& text);

/// Adds --crf, --preset, --pixels, --keyframe-interval, --lossless, --bits, --audio and --audio-offset.
void add_coding(CLI::App& command, animate::RenderRequest& options);
/// Adds --size, --camera, --quality, --antialiasing, --draft, --gl and --threads.
void add_view(CLI::App& command, animate::RenderRequest& options, std::string& size);
/// After parsing: checks the number of threads and sets the size.
void finish_view(animate::RenderRequest& options, const std::string& size);

}  // namespace risorius::cli
