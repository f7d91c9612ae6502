// SPDX-License-Identifier: MIT
/// \file
/// The adult with its muscles as bundles alone, which settles quickly.
#pragma once

#include "paths.h"
#include "risorius/scene/rig_files.h"

namespace risorius::scene {

inline const RigFiles& adult_of_bundles() {
    static const RigFiles files = [] {
        RigFiles out = read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs" /
                                      "adult" / "rig.json");
        out.rig.solids.clear();
        return out;
    }();
    return files;
}

}  // namespace risorius::scene
