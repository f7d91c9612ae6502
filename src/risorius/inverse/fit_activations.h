// Searches the activations that bring a face nearest to a measured expression: bounded, with a price on every muscle used.
//
//   minimise  1/2 |u(a) - g|_w^2 / |g|_w^2 + price sum |a_i| + ridge/2 sum a_i^2 + keep/2 sum (a_i - near_i)^2,
//             0 <= a_i <= 1 (or the muscle's range)
//
// by Gauss-Newton over settled poses. Left and right are tied where the measured shape has both.
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
    double price = 2e-3;  ///< an activation of 1 has to earn .4 % of |g|^2
    double ridge = 2e-3;
    double longest_step = 0.4;  ///< of an unknown in one round, at first
    double least_gain = 1e-3;   ///< of a round, ratio of what is minimised, or it is the last
    double size = 0;            ///< in place of |g|_w^2, m^4; 0: that itself
    double keep = 0;            ///< what being off `near` costs: keep/2 sum (a_i - near_i)^2
    Eigen::VectorXd near = {};  ///< as many as unknowns, needed with keep
    face::StaticOptions rest = {.iterations =
                                    face::kRestIterations};  ///< of every pose that is tried
};

/// Unknowns of the search: what moves together, and how far it goes.
struct ActivationUnknown {
    std::string name;
    std::vector<int> columns;                ///< of the excitation
    std::vector<track::Kinematic> channels;  ///< or these
    double least = 0, most = 1;
    double scale = 1;  ///< value of the channel / unknown
};

double value_of(const ActivationUnknown& unknown, const track::Drive& drive);
void set_value(const ActivationUnknown& unknown, double value, track::Drive& drive);

/// Muscles that move skin, lids, and jaw; mouth pressure only where `begin` has some. `sided`: left and right apart.
std::vector<ActivationUnknown> activation_unknowns(const rig::RigDescription& rig,
                                                   const track::Drive& begin, bool sided);

/// The drive found; `face` is left settled in it. `measured` is a displacement, V x 3, m; `area` its weights.
track::Drive fit_activations(face::Face& face, const std::vector<ActivationUnknown>& unknowns,
                             const Points& measured, const Eigen::VectorXd& area,
                             const track::Drive& begin, const ActivationFitOptions& options = {});

}  // namespace risorius::inverse
