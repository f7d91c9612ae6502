// SPDX-License-Identifier: MIT
/// \file
/// What a run that did not succeed prints with --json, where its report would be.
#pragma once

#include <string>

namespace risorius::cli {

/// One line of JSON, with its end. Format: risorius-error.
std::string failure_line(int exit_code, const std::string& message);

}  // namespace risorius::cli
