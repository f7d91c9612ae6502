// SPDX-License-Identifier: MIT
/// \file
/// Makes a small number of correctives from many drivers. The fields of the drivers are fitted to simulated frames and compressed
/// to low rank. Each corrective is sparse, belongs to one side of the face, and has weights in [0, 1]: where a weight would change
/// its sign, there is a second corrective for the other sign.
///
///   fit       D = D0 + R (K K' + p I)^-1 K      D, D0  3V x T   fields of the T drivers: fitted, and as given
///                                             K      F x T    values of the drivers in the F frames
///                                             R      3V x F   what D0 lacks in the frames
///             least squares over the frames; the squared change of D has the weight p (ridge regression)
///   compress  D ~ B A by the largest singular values of root(area) D root(use): B the correctives, A their factors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

/// A driver and its field: the displacement that is missing from the sum of the shapes where this driver is 1 and all others are
/// 0.
struct DriverField {
    Driver driver;
    Points field;    ///< V x 3, m
    double use = 0;  ///< mean of the square of the driver over frames as they occur in use
};

/// A frame with weights as they occur in use.
struct PlayedFrame {
    Eigen::VectorXd weights;  ///< of the shapes
    /// V x 3, m: displacement that is missing from the sum of the shapes in this frame
    Points left;
};

/// Options of low_rank().
struct Compression {
    /// P, the weight of the squared changes of the fields in the ridge regression
    double ridge_weight = 0.5;
    /// Thresholds for fading out each corrective; they apply to its displacements at its largest weight in use
    Fade fade = {};
    /// Half the width of the strip in which the sides of the face merge
    double half_width_m = 0.015;
    /// Maximum number of directions per side; each may have a second corrective for the other sign
    int most_of_a_side = 32;
    /// Maximum number of correctives of both sides together; those that move the least are dropped
    int most = 64;
    long bytes_of_a_vertex = 15;  ///< bytes per vertex of a corrective in a file
    long budget_bytes = 800'000;  ///< limit for all correctives together
};

struct LowRank {
    std::vector<Driver> drivers;
    std::vector<Corrective> correctives;  ///< their of_drivers have one factor per driver
    long bytes = 0;
};

/// Fits and compresses the fields. `rest`: V x 3, m. `area`: of each vertex, m^2. Vertices without area are compressed too, but
/// have no influence on the others.
LowRank low_rank(std::vector<DriverField> fields, const std::vector<PlayedFrame>& frames,
                 const Points& rest, const Eigen::VectorXd& area, const Compression& how = {});

/// The same without compression: those drivers whose fields matter most, each with a corrective of its own that has its name
/// (Driver::target_name()) and its value as weight. At most Compression::most.
LowRank one_of_each(std::vector<DriverField> fields, const std::vector<PlayedFrame>& frames,
                    const Points& rest, const Eigen::VectorXd& area, const Compression& how = {});

}  // namespace risorius::blendshapes
