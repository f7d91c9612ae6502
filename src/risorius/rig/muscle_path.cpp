// SPDX-License-Identifier: MIT
#include "risorius/rig/muscle_path.h"

namespace risorius::rig {

Vec3 place_on(const Head& head, const PathPoint& point, const std::string& muscle) {
    Vec3 place = head.size * point.offset;
    for (const auto& [id, weight] : point.landmarks) {
        const auto found = head.landmarks.find(id);
        if (found == head.landmarks.end())
            throw Error("muscle " + muscle, "landmarks of the atlas in its paths",
                        "\"" + id + "\"");
        place += weight * found->second;
    }
    return place;
}

}  // namespace risorius::rig
