// SPDX-License-Identifier: MIT
/// \file
/// The page of a study.
#pragma once

#include <string>

#include "risorius/study/study_results.h"

namespace risorius::study {

std::string study_page(const StudyDescription& study, const StudyResults& results);

}  // namespace risorius::study
