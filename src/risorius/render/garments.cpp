// SPDX-License-Identifier: MIT
#include "risorius/render/garments.h"

namespace risorius::render {

const std::vector<std::string>& garment_names() {
    static const std::vector<std::string> names{"none", "crew_neck", "v_neck"};
    return names;
}

}  // namespace risorius::render
