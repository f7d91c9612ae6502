// SPDX-License-Identifier: MIT
#include "risorius/core/version.h"

namespace risorius {

const char* const kVersion = RISORIUS_VERSION;

}  // namespace risorius
