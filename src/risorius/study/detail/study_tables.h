// SPDX-License-Identifier: MIT
/// \file
/// The tables of a study: values separated by tabs, "n/a" where there is none, with a description of the columns beside each, as BIDS has
/// it.
#pragma once

#include <string>
#include <vector>

#include "risorius/study/study_results.h"

namespace risorius::study {

struct StudyTable {
    std::string name;  ///< of its files, NAME.tsv and NAME.json
    std::string text;
    std::string columns;  ///< JSON: column -> {"Description", "Units"}
};

std::vector<StudyTable> study_tables(const StudyDescription& study, const SampledRigs& rigs,
                                     const StudyResults& results);

}  // namespace risorius::study
