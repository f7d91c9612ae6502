// SPDX-License-Identifier: MIT
/// \file
/// The charts of a study: for each pose, the indices of all landmarks together, and the displacements of those that move most.
#pragma once

#include <vector>

#include "risorius/plot/chart.h"
#include "risorius/study/study_results.h"

namespace risorius::study {

/// Landmarks of a pose, those that move most on the rig as it is first; at most `most`, of the left side and the midline if the study
/// has both sides.
std::vector<const Output*> shown_landmarks(const StudyDescription& study,
                                           const StudyResults& results, int pose, std::size_t most);

std::vector<plot::Chart> study_charts(const StudyDescription& study, const StudyResults& results);

}  // namespace risorius::study
