// Options that several commands share: how a picture is seen and how a video is coded.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "risorius/animate/animate.h"

namespace risorius::cli {

/// "1024x1024". Throws Error.
animate::PictureSize size_from(const std::string& text);

void add_coding(CLI::App& command, animate::AnimateOptions& options);
/// --size, --camera, --quality, --threads.
void add_view(CLI::App& command, animate::AnimateOptions& options, std::string& size);
/// After parsing: checks the number of threads and takes over the size.
void settle_view(animate::AnimateOptions& options, const std::string& size);

}  // namespace risorius::cli
