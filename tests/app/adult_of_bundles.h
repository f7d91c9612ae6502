// The adult with its muscles as bundles alone, which settles quickly.
#pragma once

#include "app/rig_files.h"
#include "paths.h"

namespace risorius::app {

inline const RigFiles& adult_of_bundles() {
    static const RigFiles files = [] {
        RigFiles out = read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs" /
                                      "adult" / "rig.json");
        out.rig.solids.clear();
        return out;
    }();
    return files;
}

}  // namespace risorius::app
