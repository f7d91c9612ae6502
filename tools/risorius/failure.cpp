// SPDX-License-Identifier: MIT
#include "tools/risorius/failure.h"

#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"

namespace risorius::cli {

std::string failure_line(int exit_code, const std::string& message) {
    return json_text(json_object({{"format", "risorius-error"},
                                  {"version", 1},
                                  {"exit_code", exit_code},
                                  {"error", message}})) +
           "\n";
}

}  // namespace risorius::cli
