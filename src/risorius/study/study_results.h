// SPDX-License-Identifier: MIT
/// \file
/// What a study has found: how landmarks move on every face of the sample, how far they spread, and which parameters that comes from.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/sensitivity/sobol_indices.h"
#include "risorius/study/sampled_rigs.h"
#include "risorius/study/study_description.h"

namespace risorius::study {

/// Lengths of the displacement of a landmark over the sample, mm. u: displacement; u0: that of the rig as it is.
struct Spread {
    double rig = 0;        ///< |u0|
    double mean = 0;       ///< mean |u|
    double low = 0;        ///< 5 % of |u|
    double high = 0;       ///< 95 % of |u|
    double deviation = 0;  ///< sqrt(mean |u - mean u|^2), in space
    double away = 0;       ///< 95 % of |u - u0|
};

/// A landmark in a pose, or all landmarks of a pose together (landmark -1; no spread).
struct Output {
    int pose = 0, landmark = -1;
    Spread spread;
    std::vector<sensitivity::SobolIndices> indices;  ///< for each parameter; empty without indices
};

struct StudyResults {
    Eigen::MatrixXd moved_mm;  ///< runs x (poses x landmarks x 3)
    Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> in_equilibrium;  ///< runs x poses
    std::vector<Output> landmarks;                                       ///< poses x landmarks
    std::vector<Output> poses;  ///< all landmarks of a pose together

    /// Poses that did not come to rest within the limit of iterations.
    long unsettled() const { return in_equilibrium.size() - in_equilibrium.count(); }
};

/// Computes spread and indices from `moved_mm` and the runs.
void analyse(const StudyDescription& study, const std::vector<Run>& runs, StudyResults& results);

Json results_json(const StudyDescription& study, const StudyResults& results);

}  // namespace risorius::study
