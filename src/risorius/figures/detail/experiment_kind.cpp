// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {

void allow_experiment_keys(const JsonCursor& experiment, std::vector<std::string_view> own) {
    own.insert(own.begin(),
               {"format", "version", "figure", "kind", "title", "checks", "claims", "watched"});
    experiment.allow_keys(own);
}

}  // namespace risorius::figures
