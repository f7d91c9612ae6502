// SPDX-License-Identifier: MIT
#include "risorius/core/toolkit_record.h"

#include "risorius/core/json_object.h"
#include "risorius/core/version.h"

namespace risorius {

Json toolkit_record() {
    return json_object({{"name", "Risorius"}, {"version", kVersion}, {"compiler", __VERSION__}});
}

}  // namespace risorius
