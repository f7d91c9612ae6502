// SPDX-License-Identifier: MIT
/// \file
/// Pictures of an evaluation: every expression as simulated and as measured, the difference as colour on the face, and contact
/// sheets.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/inverse/evaluate.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::inverse {

/// Cameras of the pictures, in order.
const std::vector<std::string>& evaluation_cameras();

/// Upper end of the colour scale of errors, mm; the same for all heads and runs.
inline constexpr double kErrorScale_mm = 6;

/// Picture files of an evaluation.
struct EvaluationPictures {
    static constexpr int kWidth_px = 396, kHeight_px = 440;  ///< of a single picture
    /// A map from the content of a picture to its file. The contents are "neutral", "table", "fitted", "measured", "table_error",
    /// "fitted_error".
    using Kinds = std::map<std::string, std::string>;
    /// One map per expression, from the name of a camera to its files
    std::vector<std::map<std::string, Kinds>> expressions;
    std::map<std::string, std::string> sheets;  ///< camera -> file

    std::vector<std::string> files() const;
};

/// Draws the pictures and writes them below `folder`; file names are relative to it. `area`: of each vertex, m^2; 0 where nothing
/// is compared. Throws Interrupted.
EvaluationPictures draw_evaluation(const Evaluation& evaluation, const rig::RigDescription& rig,
                                   const geom::PolygonMesh& mesh, const rig::Head& head,
                                   const Eigen::VectorXd& area, const std::filesystem::path& folder,
                                   const ProgressMonitor& monitor);

}  // namespace risorius::inverse
