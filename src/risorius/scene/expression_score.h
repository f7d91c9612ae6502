// SPDX-License-Identifier: MIT
/// \file
/// Scores how similar a simulated displacement field of the skin is to a measured one.
///
///   u, g   simulated, measured displacement, V x 3, m     w   skin area of each vertex, m^2
///   cosine   <u, g>_w / (|u|_w |g|_w)         relative   |u - g|_w / |g|_w (1 when the simulated skin does not move)
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/face/face.h"

namespace risorius::scene {

/// The scores of one expression.
struct ExpressionScore {
    double cosine = 0;
    double relative = 1;
    double rms_m = 0;  ///< RMS of u - g over the simulated skin
    /// The same over the skin that moves by more than 0.5 mm in either field
    double rms_moved_m = 0;
    double max_m = 0;             ///< maximum of |u - g|
    double landmark_m = 0;        ///< mean |u - g| at the landmarks of brows, eyes, nose and mouth
    double peak_m = 0;            ///< maximum of |g|
    double simulated_peak_m = 0;  ///< maximum of |u|

    Json json() const;  ///< lengths in mm
};

/// Returns the area of each vertex, m^2: a third of the area of each of its triangles.
Eigen::VectorXd vertex_areas(const Triangles& triangles, const Points& rest);

/// Returns the area of each vertex of the face's mesh, m^2. Vertices of eyes, teeth and tongue get a fifth of the mean over the
/// skin.
Eigen::VectorXd seen_areas(const face::Face& face);

/// Scores two fields of displacements. `area`: weight of each vertex. `landmark_vertices`: for landmark_m.
ExpressionScore score(const Points& simulated, const Points& measured, const Eigen::VectorXd& area,
                      const std::vector<int>& landmark_vertices);

}  // namespace risorius::scene
