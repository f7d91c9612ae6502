// SPDX-License-Identifier: MIT
/// \file
/// Fibres of a volume muscle with their tendons. A chain is a sequence of nodes: fibres in series with a tendon. It has one
/// tension along its whole length.
///
///   L    length of a chain, all segments     lT   tendon part of it; lTs when just slack     S = L - lT   fibre part of it
///   r    l/l0 in the rest pose      alpha   pennation at l0      S0   S in the rest pose, when the tendon is just slack
///   lam = sqrt( (S/S0)^2 (r^2 - sin^2 alpha) + sin^2 alpha )        fibre length / optimal length, for constant thickness
///   E(L) = min over lT of  F0 l0 [ a Ifl(lam) + Ifp(lam) ] + F0 lTs IfT((lT - lTs) / lTs),   l0 = S0 / sqrt(r^2 - sin^2 alpha)
///
/// F0 is the maximum isometric force of a chain, N, and a is its activation. l is the fibre length and l0 the optimal fibre
/// length, m. Ifl, Ifp and IfT are the integrals of the active force-length curve, the passive force-length curve and the
/// tendon curve (muscle_curves.h). Fibres and tendon are in equilibrium, so dE/dL is the tension of both, N. E depends only on
/// the length of the whole chain. So segments in series cannot diverge in length, and a stiff tendon does not make any segment
/// stiff. A short tendon may be rigid: then lT = lTs.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/muscle/muscle_curves.h"
#include "risorius/solve/hessian_builder.h"

namespace risorius::solve {
enum class Curvature;
}

namespace risorius::muscle {

/// Properties that all chains of a muscle have in common.
struct ChainProperties {
    double f0_n = 0;           ///< F0 of one chain                                [0, inf)
    double rest_stretch = 1;   ///< r                                              (sin alpha, inf)
    double pennation_rad = 0;  ///< alpha                                          [0, pi/2)
    double tendon_fraction = 0;  ///< lTs / rest length of a chain                     [0, 1)
    bool rigid_tendon = true;
};

/// All chains of one muscle.
class ChainSet {
  public:
    /// Each chain is a list of two or more rows of `rest`. Throws std::invalid_argument for a segment of zero length.
    ChainSet(std::vector<std::vector<int>> chains, const Points& rest, ChainProperties properties,
             MuscleCurves curves);

    void set_f0(double f0_n) { properties_.f0_n = f0_n; }
    const ChainProperties& properties() const { return properties_; }
    int size() const { return static_cast<int>(chains_.size()); }  ///< number of chains

    /// Returns E, J, and adds dE/dx to `gradient`, n x 3, N. `activation` is a.
    double add_energy(const Points& x, double activation, Points& gradient) const;

    /// Adds an approximation of the second derivative without negative part, N/m. The stiffness of a chain is distributed to
    /// its segments, which are springs in series. Node i is row `row[i]` of the builder.
    void add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                       solve::HessianBuilder& hessian) const;

    /// Adds the exact second derivative of E, N/m. The stiffness of a chain couples all its nodes. kPositive: without the
    /// negative part. Node i is row `row[i]` of the builder.
    void add_hessian(const Points& x, double activation, solve::Curvature curvature,
                     const std::vector<int>& row, solve::HessianBuilder& hessian) const;

    /// The state of a chain at an activation, with its fibres and tendon in equilibrium.
    struct State {
        double length_m = 0;  ///< L
        double stretch = 1;   ///< lam
        double force_n = 0;   ///< dE/dL, the tension along the chain
    };
    std::vector<State> states(const Points& x, double activation) const;  ///< one per chain

    /// Mean of lam / r over the chains.
    double mean_stretch(const Points& x, double activation) const;

  private:
    struct Chain {
        std::vector<int> node;
        double fibre_m = 0;   ///< S0
        double tendon_m = 0;  ///< lTs
    };
    struct Pull {
        double tension = 0, slope = 0, energy = 0;
        double stretch = 1;  ///< lam
    };
    double length(const Chain& chain, const Points& x) const;
    Pull fibre_pull(const Chain& chain, double fibre_m, double activation) const;
    Pull pull(const Chain& chain, double length_m, double activation) const;

    std::vector<Chain> chains_;
    ChainProperties properties_;
    MuscleCurves curves_;
};

}  // namespace risorius::muscle
