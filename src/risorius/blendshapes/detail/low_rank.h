// SPDX-License-Identifier: MIT
/// \file
/// Reduces the number of correctives. The fields of the drivers are fitted to simulated frames and compressed to low rank. Each
/// corrective is sparse and belongs to one side of the face.
///
///   fit       D = D0 + R (K K' + p I)^-1 K      D, D0  3V x T   fields of the drivers: fitted, and as given
///                                             K      F x T    drivers in the frames
///                                             R      3V x F   residual of D0 in the frames
///             least squares over the frames with the weight p on every change (ridge regression)
///   compress  D ~ B A by the singular values of  root(area) D root(use): B the correctives, A their factors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

/// A driver and its field: the error of the sum of shapes where this driver is 1 and all others are 0.
struct DriverField {
    Driver driver;
    Points field;    ///< V x 3, m
    double use = 0;  ///< mean square of the driver in use
};

/// A frame with weights as they occur in use.
struct PlayedFrame {
    Eigen::VectorXd weights;  ///< of the shapes
    Points left;              ///< V x 3, m: error of the sum of the shapes in this frame
};

/// Options of low_rank().
struct Compression {
    double ridge_weight = 0.5;  ///< weight p of the ridge regression
    Fade fade = {};             ///< fade of each corrective, at its largest weight in use
    /// Half the width of the strip in which the sides of the face merge
    double half_width_m = 0.015;
    int most_of_a_side = 32;      ///< maximum number of correctives per side
    long bytes_of_a_vertex = 15;  ///< bytes per vertex of a corrective in a file
    long budget_bytes = 800'000;  ///< limit for all correctives together
};

struct LowRank {
    std::vector<Driver> drivers;
    std::vector<Corrective> correctives;  ///< their of_drivers have one factor per driver
    long bytes = 0;
};

/// Fits and compresses the fields. `rest`: V x 3, m. `area` of each vertex, m2; vertices without area are compressed too but do
/// not influence the result.
LowRank low_rank(std::vector<DriverField> fields, const std::vector<PlayedFrame>& frames,
                 const Points& rest, const Eigen::VectorXd& area, const Compression& how = {});

}  // namespace risorius::blendshapes
