// SPDX-License-Identifier: MIT
/// \file
/// A session for a page that has no server: scripts, rigs and meshes are files of the page's own, and voices, videos and fits are not
/// there.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "risorius/view/session.h"

namespace risorius::view {

/// Reads the script, its rig and its mesh, and builds the face. Scripts that say a text are refused, because a voice is a program.
/// Throws Error.
std::unique_ptr<Session> open_page_session(const std::filesystem::path& script,
                                           const std::string& quality = "preview");

}  // namespace risorius::view
