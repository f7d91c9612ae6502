// SPDX-License-Identifier: MIT
/// \file
/// Which toolkit wrote a record: the same three fields in each file that keeps them.
#pragma once

#include "risorius/core/json_cursor.h"

namespace risorius {

/// The object `toolkit` of records: `name`, `version` and `compiler`, of the compiler that this library was built with.
Json toolkit_record();

}  // namespace risorius
