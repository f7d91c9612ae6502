// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/known_landmark.h"

#include <algorithm>

#include "risorius/core/known_names.h"

namespace risorius::rig {

std::string known_landmark(const JsonCursor& named, const std::vector<std::string>& known) {
    const std::string id = named.string();
    if (std::find(known.begin(), known.end(), id) == known.end())
        named.fail("a landmark of the atlas" + did_you_mean(id, known));
    return id;
}

}  // namespace risorius::rig
