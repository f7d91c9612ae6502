// SPDX-License-Identifier: MIT
/// \file
/// Finds the activations with which a face best reproduces a measured expression, by bounded least squares with L1 and L2
/// penalties.
///
///   minimise  1/2 |u(a) - g|_w^2 / |g|_w^2 + l1 sum |a_i| + l2/2 sum a_i^2 + keep/2 sum (a_i - near_i)^2,
///             0 <= a_i <= 1 (or the muscle's range)
///
/// a: the unknown activations, u(a): displacement of the face in equilibrium, g: the measured displacement, w: area of each
/// vertex. The problem is solved by Gauss-Newton steps between equilibria. Left and right have the same activation when the
/// measured shape has both sides.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/face.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::inverse {

/// Options of fit_activations().
struct ActivationFitOptions {
    int rounds = 12;
    /// Weight of sum |a_i|: an activation of 1 costs as much as an error of 0.4 % of |g|^2
    double l1_weight = 2e-3;
    double l2_weight = 2e-3;
    double longest_step = 0.4;  ///< largest change of an unknown in the first round
    /// The search stops when a round reduces the objective by less than this fraction
    double min_gain = 1e-3;
    /// Value that replaces |g|_w^2 in the denominator, m^4; 0: |g|_w^2 is used
    double size = 0;
    double keep = 0;            ///< weight of the distance from `near`: keep/2 sum (a_i - near_i)^2
    Eigen::VectorXd near = {};  ///< one value per unknown; needed when keep > 0
    /// Solver options for each trial pose
    face::StaticOptions rest = {.iterations = face::kRestIterations};
};

/// An unknown of the search: the columns or channels that it sets together, and its range.
struct ActivationUnknown {
    std::string name;
    /// Columns of the excitation; empty for an unknown of channels
    std::vector<int> columns;
    /// Kinematic channels; empty for an unknown of muscles
    std::vector<track::Kinematic> channels;
    double min = 0, max = 1;
    double scale = 1;  ///< value of the channel per unit of the unknown
};

double value_of(const ActivationUnknown& unknown, const track::Drive& drive);
void set_value(const ActivationUnknown& unknown, double value, track::Drive& drive);

/// Unknowns for muscles of skin, lids and jaw, and for mouth pressure if `begin` has some. `sided`: left and right are separate
/// unknowns.
std::vector<ActivationUnknown> activation_unknowns(const rig::RigDescription& rig,
                                                   const track::Drive& begin, bool sided);

/// Searches from the drive `begin` and returns the best drive. It leaves `face` in equilibrium under that drive. `measured`: g, V
/// x 3, m. `area`: w, the weight of each vertex, m^2.
track::Drive fit_activations(face::Face& face, const std::vector<ActivationUnknown>& unknowns,
                             const Points& measured, const Eigen::VectorXd& area,
                             const track::Drive& begin, const ActivationFitOptions& options = {});

}  // namespace risorius::inverse
