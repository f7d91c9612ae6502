// SPDX-License-Identifier: MIT
/// \file
/// Reduces correctives to few: the fields of the drivers are fitted to simulated frames and compressed to low rank. Each corrective is sparse
/// and belongs to one side of the face.
///
///   fit       D = D0 + R (K K' + p I)^-1 K      D, D0  3V x T   fields of the drivers, fitted and as found one by one
///                                             K      F x T    drivers in the frames
///                                             R      3V x F   residual of D0 in the frames
///             least squares over the frames with the weight p on every change (ridge regression)
///   compress  D ~ B A by the singular values of  root(area) D root(use): B the correctives, A their factors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

/// The field of a driver: the error where this driver is 1 and all others are 0.
struct DriverField {
    Driver driver;
    Points field;    ///< V x 3, m
    double use = 0;  ///< its mean square in frames of any kind
};

/// A frame with weights as they occur in use.
struct PlayedFrame {
    Eigen::VectorXd weights;  ///< of the shapes
    Points left;              ///< V x 3, m: error of the plain sum of shapes in this frame
};

struct Compression {
    double price = 0.5;  ///< p above
    Fade fade = {};      ///< fade of each corrective, at the largest weight that it has in use
    double half_width_m =
        0.015;                ///< half the width of the strip in which the sides of the face merge
    int most_of_a_side = 32;  ///< largest number of correctives per side
    long bytes_of_a_vertex = 15;  ///< size of one vertex of a corrective in a file
    long budget_bytes = 800'000;  ///< of all correctives
};

struct LowRank {
    std::vector<Driver> drivers;
    std::vector<Corrective> correctives;  ///< of_drivers: one number per driver
    long bytes = 0;
};

/// `rest` V x 3, m; `area` of each vertex, m2. Vertices without area are compressed like others but do not count.
LowRank low_rank(std::vector<DriverField> fields, const std::vector<PlayedFrame>& frames,
                 const Points& rest, const Eigen::VectorXd& area, const Compression& how = {});

}  // namespace risorius::blendshapes
