// How near a simulated displacement field of the skin is to a measured one.
//
//   u, g   simulated, measured displacement, V x 3, m     w   skin area each vertex stands for, m^2
//   cosine   <u, g>_w / (|u|_w |g|_w)         relative   |u - g|_w / |g|_w (1 without any motion)
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/face/face.h"

namespace risorius::scene {

struct ExpressionScore {
    double cosine = 0;
    double relative = 1;
    double rms_m = 0;        ///< of u - g over the simulated skin
    double rms_moved_m = 0;  ///< the same where either moves by more than 0.5 mm
    double greatest_m = 0;   ///< |u - g|
    double landmark_m = 0;   ///< mean |u - g| at the landmarks of brows, eyes, nose and mouth
    double peak_m = 0;       ///< greatest |g|
    double simulated_peak_m = 0;

    Json json() const;  ///< lengths in mm
};

/// Skin area per vertex, m^2: a third of each triangle's.
Eigen::VectorXd vertex_areas(const Triangles& triangles, const Points& rest);

/// The same where the skin is simulated, and a fifth of its mean for every vertex of eyes, teeth and tongue.
Eigen::VectorXd seen_areas(const face::Face& face);

ExpressionScore score(const Points& simulated, const Points& measured, const Eigen::VectorXd& area,
                      const std::vector<int>& landmark_vertices);

}  // namespace risorius::scene
