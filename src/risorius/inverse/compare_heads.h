// SPDX-License-Identifier: MIT
/// \file
/// Compares the expressions of two heads. Each head is driven by its own tables. The displacements of the landmarks are divided
/// by the size of the head and then compared.
///
///   difference  sqrt(sum |u/s - u'/s'|^2 / sum |u'/s'|^2) over the landmarks of brows, eyes, nose and lips
///   u, u'       displacements on the two heads, m;  s, s'  size of the head over that of the atlas head
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::inverse {

/// The difference of one expression.
struct HeadDifference {
    std::string expression;
    double difference = 0;  ///< ratio
    double cosine = 1;  ///< cosine of the angle between the two displacements, over all landmarks
    double length_ratio = 1;  ///< |u/s| / |u'/s'|
    double landmark_mm = 0;   ///< mean |u/s - u'/s'|
    std::string worst;        ///< landmark with the largest difference
};

/// The differences of two rigs.
struct HeadComparison {
    std::string rig, like;
    std::vector<HeadDifference> expressions;
    double mean_difference() const;
    Json json() const;
};

/// Compares the expressions `names` (see expression_drive.h) of two rig files; both rigs must know them. Throws Error,
/// Interrupted.
HeadComparison compare_heads(const std::filesystem::path& rig, const std::filesystem::path& like,
                             const std::vector<std::string>& names, const std::string& quality,
                             const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
