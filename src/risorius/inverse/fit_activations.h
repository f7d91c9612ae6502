// SPDX-License-Identifier: MIT
/// \file
/// Finds the activations that bring a face nearest to a measured expression: bounded least squares with an L1 and an L2 penalty.
///
///   minimise  1/2 |u(a) - g|_w^2 / |g|_w^2 + l1 sum |a_i| + l2/2 sum a_i^2 + keep/2 sum (a_i - near_i)^2,
///             0 <= a_i <= 1 (or the muscle's range)
///
/// Gauss-Newton over poses in equilibrium. Left and right have the same activation where the measured shape has both sides.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/face.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::inverse {

struct ActivationFitOptions {
    int rounds = 12;
    double l1_weight =
        2e-3;  ///< weight of sum |a_i|: an activation of 1 costs as much as .4 % of |g|^2
    double l2_weight = 2e-3;
    double longest_step = 0.4;  ///< largest change of an unknown in the first round
    double min_gain =
        1e-3;         ///< stops when a round reduces the objective by less than this fraction
    double size = 0;  ///< replaces |g|_w^2, m^4; 0: |g|_w^2 itself
    double keep = 0;  ///< weight of the distance from `near`: keep/2 sum (a_i - near_i)^2
    Eigen::VectorXd near = {};  ///< one value per unknown; needed when keep > 0
    face::StaticOptions rest = {.iterations =
                                    face::kRestIterations};  ///< of every pose that is tried
};

/// An unknown of the search: the columns or channels that it moves together, and its range.
struct ActivationUnknown {
    std::string name;
    std::vector<int> columns;                ///< columns of the excitation
    std::vector<track::Kinematic> channels;  ///< or kinematic channels
    double min = 0, max = 1;
    double scale = 1;  ///< value of the channel / unknown
};

double value_of(const ActivationUnknown& unknown, const track::Drive& drive);
void set_value(const ActivationUnknown& unknown, double value, track::Drive& drive);

/// Unknowns for muscles that move skin, lids and jaw, and for mouth pressure if `begin` has some. `sided`: left and right separately.
std::vector<ActivationUnknown> activation_unknowns(const rig::RigDescription& rig,
                                                   const track::Drive& begin, bool sided);

/// Returns the drive; `face` is left in equilibrium with it. `measured`: displacement, V x 3, m; `area`: weight of each vertex.
track::Drive fit_activations(face::Face& face, const std::vector<ActivationUnknown>& unknowns,
                             const Points& measured, const Eigen::VectorXd& area,
                             const track::Drive& begin, const ActivationFitOptions& options = {});

}  // namespace risorius::inverse
