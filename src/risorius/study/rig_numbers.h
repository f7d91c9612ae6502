// SPDX-License-Identifier: MIT
/// \file
/// Finds numbers in the JSON of a rig by a path: keys from the top, separated by "/".
///
///   tissue/deep_shear_pa                  a key
///   anatomy/strength/*                    all entries of an object or a list
///   anatomy/thickness/points/prn/thickness_mm    an entry of a list, by its "id" or "landmark" or its index from 0
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::study {

/// Returns the JSON pointers of the numbers that a path means, in the order of the rig. Throws Error at `place` when there is none, with
/// the key that is nearest.
std::vector<std::string> rig_numbers(const Json& rig, const std::string& path,
                                     const std::string& place);

}  // namespace risorius::study
