// Options that several commands share: how a picture is seen and how a video is coded.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/animate.h"

namespace risorius::cli {

/// "1024x1024". Throws Error.
app::PictureSize size_from(const std::string& text);

void add_coding(CLI::App& command, app::AnimateOptions& options);
/// --size, --camera, --quality, --threads.
void add_view(CLI::App& command, app::AnimateOptions& options, std::string& size);
/// After parsing: checks the number of threads and takes over the size.
void settle_view(app::AnimateOptions& options, const std::string& size);

}  // namespace risorius::cli
